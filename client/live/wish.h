#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/partition/partitioner.h"
#include "client/path/camera_file.h"
#include "common/base/result.h"
#include "common/render/draw_settings.h"

namespace swath {

// The part of a wish that is in effect for all frames until it changes, in a pause between two frames.
struct LiveSetup {
    std::size_t objects = 1500;  // about how many
    DrawSettings draw;
    bool operator==(const LiveSetup&) const = default;
};

// The leader's wish (docs/viewer.md explains the fields). A value.
struct LiveWish {
    std::uint64_t id = 0;  // the page's number
    std::uint32_t by = 0;  // the viewer's
    CameraNumbers camera{0, 0, 1, 0, 0, 0, 0, 1, 0, 30};
    int width = 1280;  // pixels
    int height = 960;
    Algorithm algorithm = Algorithm::kHybrid;
    std::optional<Algorithm> against;
    std::optional<std::size_t> servers;  // none: all
    LiveSetup setup;
    std::string path;  // "orbit", "random"; empty: `camera`
    bool paused = false;
    // Counts: a larger one than before asks for something.
    std::uint64_t step = 0;
    std::uint64_t measure = 0;
    std::uint64_t trace = 0;
    bool operator==(const LiveWish&) const = default;
};

struct WishLimits {
    std::size_t servers = 1;
    int max_width = 2560;
    int max_height = 1600;
};

// The reasons why fields of a wish cannot be had, by field name.
using Refusals = std::map<std::string, std::string>;

// Takes the text's fields into `wish`; fields that are missing, or that it refuses with a reason, stay. An
// error if the text is no JSON object. Trusts nothing in it.
Result<Refusals> apply_wish(std::string_view json, std::uint32_t by, const WishLimits& limits,
                            LiveWish& wish);

}  // namespace swath
