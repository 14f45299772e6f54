#pragma once
// Sixteen numbers at once, in the instruction set that the including kernel is compiled for: Floats, Words
// (32 bits, unsigned) and masks, which have one bit per lane, lane 0 lowest. Only kernels may include this
// (swath_kernel in cmake/compile_options.cmake). All of it is in an unnamed namespace, so that the linker
// never gives another object file code that its processor may not have.
//
//   Floats  load, store, all, add, subtract, multiply, divide, fused (a x + t, rounded once), absolute,
//           lower_of, higher_of (the second number, unless the first is lower or higher), lowest, highest
//           (over the lanes, of numbers that are not NaN), where;
//           as masks below_zero, at_least_zero, less, at_most, equal (none holds for NaN)
//   Words   load, load_shorts (16 bits, signed), store, all, add, subtract, product (its low 32 bits),
//           magnitude, lower_of, higher_of (signed), both (and), either (or), exclusive (xor), shift_left,
//           shift_right, shift_right_signed, set_bits_where, where, to_floats (signed), rounded (of Floats,
//           to the nearest, of two to the even one), look_up (for each lane's i, element i of a table),
//           look_up64 (of a table of 64); as masks non_zero, less
//   halves  of a word, two signed numbers of 16 bits: add_halves, subtract_halves, lower_halves,
//           higher_halves, shift_left_halves, shift_right_halves, swap_halves, dot_halves (the sum of both
//           products, of 32 bits)
//   Truths  a truth for each lane, in the form that a set likes best: negative (of Words), is_less (signed),
//           is_equal, both, either, without, any, bits (as a mask)
//   rows    load_rows, store_rows_where: lanes 0 to 7 at one place, lanes 8 to 15 at another
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
