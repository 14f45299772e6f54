#include "client/live/live_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client/path/path.h"
#include "common/base/check.h"

namespace swath {
namespace {

constexpr std::size_t kPathFrames = 240;  // once around

}  // namespace

LiveView::LiveView(Settings settings)
    : settings_(std::move(settings)),
      wish_(settings_.start),
      setup_(settings_.start.setup),
      shown_(settings_.start.camera) {
    start_path();
}

Status LiveView::on_wish(std::string_view json, std::uint32_t by) {
    const LiveWish before = wish_;
    SWATH_TRY(refused_, apply_wish(json, by, settings_.limits, wish_));
    if (const auto status = check_camera(); !status) {
        wish_.camera = before.camera;
        wish_.width = before.width;
        wish_.height = before.height;
        refused_["camera"] = status.error().message;
    }
    const bool view_changed = wish_.camera != before.camera || wish_.width != before.width ||
                              wish_.height != before.height || wish_.algorithm != before.algorithm ||
                              wish_.against != before.against || wish_.servers != before.servers ||
                              wish_.path != before.path;
    if (view_changed) {
        dirty_ = true;
        measured_servers_ = 0;
        if (!wish_.against) second_.reset();
    }
    if (wish_.path != before.path || wish_.width != before.width || wish_.height != before.height)
        start_path();
    // A page that has just loaded counts from 0: a smaller number than before asks for nothing.
    if (wish_.step > before.step) ++steps_;
    if (!wish_.paused) steps_ = 0;
    if (wish_.trace > before.trace) trace_ = true;
    if (wish_.measure > before.measure) {
        if (path_.empty()) shown_ = wish_.camera;
        ++measurement_;
        measured_servers_ = 1;
        measured_frames_ = 0;
    }
    if (refused_setup_ && wish_.setup != *refused_setup_) refused_setup_.reset();
    return {};
}

// A valid camera may still be too far from this model, or too narrow, for single precision.
Status LiveView::check_camera() const {
    const FrameOrder order = order_of(wish_.camera, wish_.algorithm, servers());
    const View view = make_view(order.camera, order.width, order.height);
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k)
            if (!std::isfinite(view.clip_from_model[i][k]))
                return fail("the model cannot be projected from there");
    return {};
}

void LiveView::on_servers(std::size_t servers) {
    settings_.limits.servers = servers;
    dirty_ = true;
    measured_servers_ = 0;
}

std::size_t LiveView::servers() const {
    return std::min(wish_.servers.value_or(settings_.limits.servers), settings_.limits.servers);
}

void LiveView::on_viewers(std::uint32_t viewers) {
    if (viewers > viewers_) dirty_ = true;
    viewers_ = viewers;
    if (viewers == 0) measured_servers_ = 0;
}

void LiveView::start_path() {
    path_.clear();
    if (wish_.path.empty()) return;
    const PathOptions options{kPathFrames, settings_.seed,
                              static_cast<float>(wish_.width) / static_cast<float>(wish_.height)};
    auto cameras = make_path(wish_.path, settings_.bounds, options);
    CHECK(cameras.has_value() == true);
    for (const Camera& camera : *cameras)
        if (camera_of(numbers_of(camera))) path_.push_back(numbers_of(camera));
}

bool LiveView::wants_frame() const {
    if (viewers_ == 0 || wanted_setup()) return false;
    if (second_ || measuring()) return true;
    if (wish_.paused) return steps_ > 0;
    return dirty_ || !path_.empty();
}

FrameOrder LiveView::order_of(const CameraNumbers& numbers, Algorithm algorithm, std::size_t servers) const {
    FrameOrder order;
    order.numbers = numbers;
    // Comes from the numbers even on a path, so that a camera file of them draws the same.
    const auto camera = camera_of(numbers);
    CHECK(camera.has_value() == true);
    order.camera = with_depth_range(*camera, settings_.bounds);
    order.width = wish_.width;
    order.height = wish_.height;
    order.algorithm = algorithm;
    order.servers = servers;
    order.wish = wish_.id;
    order.by = wish_.by;
    return order;
}

FrameOrder LiveView::next() {
    CHECK(wants_frame() == true);
    if (second_) return *std::exchange(second_, std::nullopt);
    if (measuring()) {
        FrameOrder order = order_of(shown_, wish_.algorithm, measured_servers_);
        order.measurement = measurement_;
        order.counts = measured_frames_ >= kUncountedFrames;
        if (++measured_frames_ == kMeasuredFrames) {
            measured_frames_ = 0;
            measured_servers_ = measured_servers_ < settings_.limits.servers ? measured_servers_ + 1 : 0;
            // The picture that stays is the wish's.
            if (measured_servers_ == 0) dirty_ = true;
        }
        return order;
    }
    if (steps_ > 0) --steps_;
    dirty_ = false;
    shown_ = wish_.camera;
    if (!path_.empty()) {
        shown_ = path_[path_at_ % path_.size()];
        ++path_at_;
    }
    FrameOrder order = order_of(shown_, wish_.algorithm, servers());
    if (wish_.against) {
        second_ = order;
        second_->algorithm = *wish_.against;
        second_->stream = 1;
    }
    return order;
}

std::optional<LiveSetup> LiveView::wanted_setup() const {
    if (wish_.setup == setup_ || wish_.setup == refused_setup_) return std::nullopt;
    return wish_.setup;
}

void LiveView::on_setup(const LiveSetup& setup) {
    setup_ = setup;
    dirty_ = true;
    measured_servers_ = 0;
}

void LiveView::on_setup_refused(const LiveSetup& tried, const std::string& why) {
    refused_setup_ = tried;
    refused_why_ = why;
    dirty_ = true;
}

Refusals LiveView::refused() const {
    Refusals all = refused_;
    if (wish_.setup != refused_setup_) return all;
    if (refused_setup_->objects != setup_.objects) all["objects"] = refused_why_;
    if (refused_setup_->draw.renderers != setup_.draw.renderers) all["renderer"] = refused_why_;
    if (refused_setup_->draw.cull != setup_.draw.cull) all["cull"] = refused_why_;
    return all;
}

bool LiveView::take_trace() { return std::exchange(trace_, false); }

}  // namespace swath
