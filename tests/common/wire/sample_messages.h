#pragma once
#include <vector>

#include "common/wire/messages.h"

namespace swath::test {

// One message of each kind, with random values that a program may send. The same seed gives the same
// messages.
std::vector<Message> sample_messages(std::uint32_t seed);

// The task of server 1 of 3 for a frame, with something in every field.
RenderFrame sample_render_frame();

}  // namespace swath::test
