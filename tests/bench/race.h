#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"

namespace swath::bench {

// Ways to the same set, or to do the same work, measured against each other: in every repetition each has a
// turn of a few frames back to back, and its best one counts, so that what disturbs the machine disturbs all
// alike. Ratios are taken within a repetition.
class Race {
  public:
    using Ids = std::vector<std::uint32_t>;

    // `title` says in errors what is raced, `scene` heads its column in a table.
    Race(std::string title, std::string scene) : title_(std::move(title)), scene_(std::move(scene)) {}
    // `frame` is what is measured. `ids` says what may be seen by the last frame; a frame must have made
    // these ids, each of them, wherever they lie. The first runner is what the others are checked against,
    // and the table's ratios refer to.
    void add(std::string name, std::function<void()> frame, std::function<Ids()> ids);
    // Of a frame that returns all its ids.
    void add(std::string name, std::function<std::span<const std::uint32_t>()> frame);
    // Of work that makes no set, and that check() leaves out. `prepare` comes before every frame and is not
    // measured.
    void add_work(std::string name, std::function<void()> prepare, std::function<void()> frame);

    enum class Order { kAny, kSame };
    // One frame of each, not measured: an error when one does not leave what the first left, naming both and
    // how they differ.
    Status check(Order order = Order::kAny);
    // What of a turn's frames counts.
    enum class Frames { kBest, kMean };
    void run(int repetitions, int frames = 3, Frames count = Frames::kBest);

    std::size_t visible() const { return visible_; }
    // Of runners by name, which must have been added.
    double us(std::string_view name) const;  // median
    // How many times as long `slow` takes as `fast`, by repetition.
    std::vector<double> ratios(std::string_view slow, std::string_view fast) const;

  private:
    struct Runner {
        std::string name;
        std::function<void()> frame;
        std::function<Ids()> ids;       // none of work without a set
        std::function<void()> prepare;  // may be none
        std::vector<double> us;
    };
    const Runner& runner(std::string_view name) const;

    friend std::string table(const std::string& title, std::span<const Race> races);

    std::string title_;
    std::string scene_;
    std::vector<Runner> runners_;
    std::size_t visible_ = 0;
};

// Of races between the same runners, a column each: microseconds and, behind them, how many times as fast as
// the first runner.
std::string table(const std::string& title, std::span<const Race> races);

// What one call takes, in microseconds.
double time_us(const std::function<void()>& work);

}  // namespace swath::bench
