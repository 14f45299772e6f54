#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/live/wish.h"
#include "common/geometry/box.h"
#include "common/geometry/camera.h"

namespace swath {

// One frame to be drawn: its plan is made from this.
struct FrameOrder {
    CameraNumbers numbers{};
    Camera camera;
    int width = 0;
    int height = 0;
    Algorithm algorithm = Algorithm::kHybrid;
    std::size_t servers = 1;   // the first so many take part
    std::uint32_t stream = 0;  // 1: the second algorithm of a comparison
    std::uint64_t wish = 0;
    std::uint32_t by = 0;
    std::size_t measurement = 0;  // the number of the speed-up measurement; 0: none
    bool counts = false;          // whether it counts in that, or only fills the pipeline
};

// Decides what a live run draws next, from the newest wish: a newer one replaces the older, nothing is
// queued. It wants a frame while somebody looks and the wish is new, a path plays, the second of two
// algorithms is due, a single step was asked for or speed-ups are being measured. Sans-I/O, without a clock.
// Not thread-safe.
class LiveView {
  public:
    struct Settings {
        Box bounds;      // the model's, at every pose, not empty
        LiveWish start;  // until somebody wishes; its setup is in effect
        WishLimits limits;
        std::uint64_t seed = 1;  // of the random path
    };
    explicit LiveView(Settings settings);

    // An error if the text is no wish. refused() has the fields that cannot be had.
    Status on_wish(std::string_view json, std::uint32_t by);
    // The number of servers, at least 1.
    void on_servers(std::size_t servers);
    // The number of viewers. A newcomer gets a new frame.
    void on_viewers(std::uint32_t viewers);

    bool wants_frame() const;
    // Only while a frame is wanted.
    FrameOrder next();

    // The setup that is wished for and not in effect: change to it before the next frame.
    std::optional<LiveSetup> wanted_setup() const;
    void on_setup(const LiveSetup& setup);
    // The setup was tried and cannot be had. The one in effect stays, and the same wish is not tried again.
    void on_setup_refused(const LiveSetup& tried, const std::string& why);

    const LiveWish& wish() const { return wish_; }     // as asked for
    std::size_t servers() const;                       // that take part
    const LiveSetup& setup() const { return setup_; }  // in effect
    // The wish's setup; if it cannot be had, the one in effect.
    const LiveSetup& accepted_setup() const { return wish_.setup == refused_setup_ ? setup_ : wish_.setup; }
    Refusals refused() const;
    const LiveWish& start() const { return settings_.start; }
    const CameraNumbers& home() const { return settings_.start.camera; }
    // The wish's camera; while a path plays, that of the newest order.
    const CameraNumbers& camera() const { return path_.empty() ? wish_.camera : shown_; }
    std::uint32_t viewers() const { return viewers_; }
    // Counts speed-up measurements; a new one makes the figures of the last one stale.
    std::size_t measurement() const { return measurement_; }
    bool measuring() const { return measured_servers_ > 0; }
    // True if the wish has asked for a trace since the last call.
    bool take_trace();

  private:
    void start_path();
    Status check_camera() const;
    FrameOrder order_of(const CameraNumbers& numbers, Algorithm algorithm, std::size_t servers) const;

    Settings settings_;
    LiveWish wish_;
    LiveSetup setup_;
    Refusals refused_;
    std::optional<LiveSetup> refused_setup_;
    std::string refused_why_;
    CameraNumbers shown_{};
    std::uint32_t viewers_ = 0;
    bool dirty_ = true;  // nothing has been drawn from the wish
    std::uint64_t steps_ = 0;
    bool trace_ = false;
    std::vector<CameraNumbers> path_;  // one round
    std::size_t path_at_ = 0;
    std::optional<FrameOrder> second_;
    std::size_t measurement_ = 0;
    std::size_t measured_servers_ = 0;  // the number of servers being measured; 0: no measurement
    std::size_t measured_frames_ = 0;
};

// A measurement draws so many frames with each number of servers; the first ones overlap with those of
// another number.
inline constexpr std::size_t kMeasuredFrames = 12;
inline constexpr std::size_t kUncountedFrames = 4;

}  // namespace swath
