#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "client/live/live_view.h"

// A message of a page: either an error of one line, or a wish whose frames can be drawn.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace swath;
    LiveView::Settings settings;
    settings.bounds = {{-1, -1, -1}, {1, 1, 1}};
    settings.limits = {3, 2000, 1000};
    settings.start.camera = {0, 0, 9, 0, 0, 0, 0, 1, 0, 30};
    LiveView live(settings);
    live.on_viewers(1);
    const auto status = live.on_wish({reinterpret_cast<const char*>(data), size}, 1);
    if (!status && status.error().message.empty()) std::abort();
    for (const auto& [field, why] : live.refused())
        if (why.empty()) std::abort();
    if (const auto setup = live.wanted_setup()) live.on_setup(*setup);
    for (int i = 0; i < 3 && live.wants_frame(); ++i) {
        const FrameOrder order = live.next();
        if (order.width < 1 || order.width > 2000 || order.height < 1 || order.height > 1000) std::abort();
        if (order.servers < 1 || order.servers > 3 || order.stream > 1) std::abort();
    }
    return 0;
}
