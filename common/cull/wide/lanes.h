#pragma once
// Sixteen numbers at once, in the instruction set that the kernel including this is compiled for: Floats and
// Words (32 bits, unsigned), and masks with a bit per lane, lane 0 lowest. Only for kernels (see swath_kernel
// in cmake/compile_options.cmake): everything is in an unnamed namespace, so that no other object file can
// get these copies.
//
//   Floats: load, all, add, multiply, fused (a x + t, rounded once), lower_of, higher_of (of numbers that are
//           not NaN), lowest, highest (over the lanes), below_zero, at_least_zero (NaN is neither)
//   Words:  load, store, all, add, both (and), shift_left, shift_right, set_bits_where, non_zero, to_floats
//   packed: writes the lanes of a mask side by side and returns the place after them. It may scribble over
//           the whole of the next 16 places.
#include <cstdint>

#if defined(SWATH_KERNEL_avx512)
#include "common/cull/wide/lanes_avx512.h"
#elif defined(SWATH_KERNEL_avx2)
#include "common/cull/wide/lanes_avx2.h"
#else
#include "common/cull/wide/lanes_portable.h"
#endif
