#pragma once

namespace swath {

// Frames take and give large blocks: this keeps glibc from returning them to the system in between, which
// costs llvmpipe a quarter of its time. Call once at the start of main, before threads and contexts.
void tune_allocator();

}  // namespace swath
