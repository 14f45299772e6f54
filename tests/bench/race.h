#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"

namespace swath::bench {

// Races runners that make the same set or do the same work. In every repetition each has a turn of a few
// frames back to back, and its best one counts, so that a disturbance of the machine meets all alike. Ratios
// are taken within a repetition.
class Race {
  public:
    using Ids = std::vector<std::uint32_t>;

    // `title` names the race in errors, `scene` heads its column in a table.
    Race(std::string title, std::string scene) : title_(std::move(title)), scene_(std::move(scene)) {}
    // `frame` is measured. `ids` returns what the last frame found visible; the frame must have written each
    // of these ids somewhere. check() and the table's ratios compare with the first runner.
    void add(std::string name, std::function<void()> frame, std::function<Ids()> ids);
    // For a frame that returns all its ids.
    void add(std::string name, std::function<std::span<const std::uint32_t>()> frame);
    // For work that makes no set; check() leaves it out. `prepare` runs before every frame and is not
    // measured.
    void add_work(std::string name, std::function<void()> prepare, std::function<void()> frame);

    enum class Order { kAny, kSame };
    // Runs one frame of each, unmeasured. An error if a runner's set differs from the first one's; it names
    // both and the difference.
    Status check(Order order = Order::kAny);
    // The frames of a turn that count.
    enum class Frames { kBest, kMean };
    void run(int repetitions, int frames = 3, Frames count = Frames::kBest);

    std::size_t visible() const { return visible_; }
    // `name` must have been added.
    double us(std::string_view name) const;  // median
    // The time of `slow` over that of `fast`, by repetition.
    std::vector<double> ratios(std::string_view slow, std::string_view fast) const;

  private:
    struct Runner {
        std::string name;
        std::function<void()> frame;
        std::function<Ids()> ids;       // empty for work without a set
        std::function<void()> prepare;  // may be empty
        std::vector<double> us;
    };
    const Runner& runner(std::string_view name) const;

    friend std::string table(const std::string& title, std::span<const Race> races);

    std::string title_;
    std::string scene_;
    std::vector<Runner> runners_;
    std::size_t visible_ = 0;
};

// A table of races between the same runners, a column each: microseconds, and how many times as fast as the
// first runner.
std::string table(const std::string& title, std::span<const Race> races);

// The time of one call, in microseconds.
double time_us(const std::function<void()>& work);

}  // namespace swath::bench
