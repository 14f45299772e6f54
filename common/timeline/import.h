#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/timeline/timeline.h"

namespace swath {

// What to_csv() wrote, back: the same frames with the earliest span at 0, without machines that had neither
// spans nor counts. Nothing in the text is trusted. Errors name the source, the line and the field.
Result<std::vector<FrameTimeline>> parse_timeline(std::string_view csv, std::string_view source);
Result<std::vector<FrameTimeline>> read_timeline(const std::filesystem::path& file);

}  // namespace swath
