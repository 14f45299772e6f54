#pragma once

namespace swath {

// Keeps glibc from returning large blocks to the system between frames, which costs llvmpipe a quarter of its
// time. Call it once at the start of main, before threads and contexts exist.
void tune_allocator();

}  // namespace swath
