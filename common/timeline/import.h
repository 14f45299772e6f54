#pragma once
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/timeline/timeline.h"

namespace swath {

// Reads what to_csv() wrote: the same frames with the earliest span at 0, without machines that had neither
// spans nor counts. Trusts nothing in the text. Errors name the source, the line and the field.
Result<std::vector<FrameTimeline>> parse_timeline(std::string_view csv, std::string_view source);

}  // namespace swath
