#include "common/plan/gather.h"

#include <algorithm>

#include "common/base/check.h"

namespace swath {

Status Gather::open(FrameNumber number, const std::vector<ServerId>& incoming) {
    if (number < next_frame_) return fail("frame {} is announced after frame {}", number, next_frame_ - 1);
    const auto opened =
        std::count_if(frames_.begin(), frames_.end(), [](const auto& f) { return f.second.open; });
    if (static_cast<std::size_t>(opened) >= frames_in_flight_)
        return fail("frame {}: more than {} frames in flight", number, frames_in_flight_);
    if (!frames_.empty() && !frames_.begin()->second.open && frames_.begin()->first < number)
        return fail("pixels came for frame {}, which was never announced", frames_.begin()->first);
    next_frame_ = number + 1;
    Frame& frame = frames_[number];
    frame.open = true;
    frame.awaited.insert(incoming.begin(), incoming.end());
    for (const ServerId early : frame.waiting)
        if (frame.awaited.erase(early) == 0)
            return fail("server {} sent pixels for frame {}, which awaits none from it", index(early),
                        number);
    return {};
}

std::vector<ServerId> Gather::ready(FrameNumber number) {
    const auto found = frames_.find(number);
    CHECK((found != frames_.end()) == true);
    Frame& frame = found->second;
    CHECK(frame.open == true);
    CHECK(frame.ready == false);
    frame.ready = true;
    std::vector<ServerId> now(frame.waiting.begin(), frame.waiting.end());
    frame.waiting.clear();
    return now;
}

Result<bool> Gather::arrive(FrameNumber number, ServerId from) {
    auto found = frames_.find(number);
    if (found == frames_.end()) {
        if (number < next_frame_) return fail("pixels for frame {}, which is over", number);
        const auto early =
            std::count_if(frames_.begin(), frames_.end(), [](const auto& f) { return !f.second.open; });
        if (static_cast<std::size_t>(early) >= frames_in_flight_)
            return fail("pixels for frame {}, more than {} frames ahead", number, frames_in_flight_);
        found = frames_.emplace(number, Frame{}).first;
    }
    Frame& frame = found->second;
    if (frame.open && frame.awaited.erase(from) == 0)
        return fail("pixels for frame {}, which awaits none", number);
    if (frame.ready) return true;
    if (!frame.waiting.insert(from).second) return fail("pixels for frame {} twice", number);
    return false;
}

bool Gather::complete(FrameNumber number) const {
    const auto found = frames_.find(number);
    return found != frames_.end() && found->second.ready && found->second.awaited.empty();
}

}  // namespace swath
