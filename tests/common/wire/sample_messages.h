#pragma once
#include <vector>

#include "common/wire/messages.h"

namespace swath::test {

// One of each kind of message, filled with random values that a program may send. The same seed gives the
// same messages.
std::vector<Message> sample_messages(std::uint32_t seed);

// A frame's task for server 1 of 3 in which every field has something.
RenderFrame sample_render_frame();

}  // namespace swath::test
