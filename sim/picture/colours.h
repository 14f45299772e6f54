#pragma once
#include "common/base/ids.h"
#include "common/image/picture.h"

namespace swath::sim {

// A server's colour, the same in every picture. Hue and lightness both step by irrational parts of their
// range, so any two of 64 servers differ in one or the other. Those with close numbers, which often own
// neighbouring tiles, differ in both: people who see few hues still see the lightness.
Rgb server_colour(ServerId id);

// `over` laid on `under` with an opacity of 0 to 1, each channel rounded to the nearest value.
Rgb blend(const Rgb& under, const Rgb& over, double opacity);

}  // namespace swath::sim
