#include "client/director/director.h"

#include <algorithm>

namespace swath {

Director::Open* Director::find(FrameNumber frame) {
    const auto found =
        std::find_if(open_.begin(), open_.end(), [&](const Open& o) { return o.frame == frame; });
    return found == open_.end() ? nullptr : &*found;
}

Director::Actions Director::on_start() {
    started_ = true;
    return advance();
}

Director::Actions Director::on_wanted(bool wanted) {
    wanted_ = wanted;
    return advance();
}

Director::Actions Director::on_reconfigure() {
    if (change_ == Change::kNone) change_ = Change::kAwaited;
    return advance();
}

Director::Actions Director::on_reconfigured() {
    change_ = Change::kNone;
    wanted_ = false;
    return advance();
}

void Director::on_issued(FrameNumber frame, std::size_t servers) {
    if (Open* open = find(frame)) open->reports_missing = servers;
}

Result<Director::Actions> Director::on_server_report(FrameNumber frame) {
    if (over_) return Actions{};
    Open* open = find(frame);
    if (open == nullptr || open->reports_missing == 0)
        return fail("a report for frame {}, which awaits none", frame);
    --open->reports_missing;
    return advance();
}

Result<Director::Actions> Director::on_display_report(FrameNumber frame) {
    if (over_) return Actions{};
    Open* open = find(frame);
    if (open == nullptr || open->displayed) return fail("a picture for frame {}, which awaits none", frame);
    open->displayed = true;
    ++complete_;
    return advance();
}

Director::Actions Director::on_lost(const std::string& who, const std::string& why) {
    if (over_) return {};
    over_ = true;
    return {{DirectorAction::Kind::kAbort, 0, who + ": " + why}};
}

bool Director::may_begin() const {
    return change_ == Change::kNone && open_.size() < in_flight_ && (live_ ? wanted_ : next_ < frames_);
}

Director::Actions Director::advance() {
    if (over_ || !started_) return {};
    // A frame is over when it is displayed and every server has reported; then no program remembers it.
    std::erase_if(open_, [](const Open& o) { return o.displayed && o.reports_missing == 0; });
    Actions actions;
    while (may_begin()) {
        wanted_ = false;
        open_.push_back({next_, 0, false});
        actions.push_back({DirectorAction::Kind::kIssue, next_, {}});
        ++next_;
    }
    if (change_ == Change::kAwaited && open_.empty()) {
        change_ = Change::kUnderWay;
        actions.push_back({DirectorAction::Kind::kReconfigure, 0, {}});
    }
    if (!live_ && next_ == frames_ && open_.empty()) {
        over_ = true;
        actions.push_back({DirectorAction::Kind::kFinish, 0, {}});
    }
    return actions;
}

}  // namespace swath
