#pragma once
// Sixteen numbers at once, in the instruction set that the including kernel is compiled for: Floats, Words
// (32 bits, unsigned) and masks, which have one bit per lane, lane 0 lowest. Only kernels may include this
// (swath_kernel in cmake/compile_options.cmake). All of it is in an unnamed namespace, so that the linker
// never gives another object file code that its processor may not have.
//
//   Floats  load, store, all, add, subtract, multiply, divide, fused (a x + t, rounded once), absolute,
//           lower_of, higher_of (of numbers that are not NaN), lowest, highest (over the lanes), where;
//           as masks below_zero, at_least_zero, less, at_most, equal (none holds for NaN)
//   Words   load, store, all, add, both (and), shift_left, shift_right, set_bits_where, where, to_floats;
//           as masks non_zero, less
//   packed  writes the lanes of a mask side by side and returns the place after them; it may scribble
//           over the whole of the next 16 places
#include <cstdint>

#if defined(SWATH_KERNEL_avx512)
#include "common/base/lanes/lanes_avx512.h"
#elif defined(SWATH_KERNEL_avx2)
#include "common/base/lanes/lanes_avx2.h"
#else
#include "common/base/lanes/lanes_portable.h"
#endif
