#pragma once
#include <cstddef>
#include <cstdint>

namespace swath {

// RankBitmap's kernels over words of 64 marks (swath_kernel in cmake/compile_options.cmake):
//
//   merge_bits   adds the marks of `from` to `into` and clears `from`, `count` words each
//   invert_bits  inverts all bits
//   count_bits   counts the bits that are set
//   expand_bits  writes values[i] for every bit i that is set, ascending, and clears the words
//
// `room` is count_bits() of the words, and expand_bits writes no more. If fewer than 64 places are left, it
// reads only values whose bits are set, so `values` may end within the last word.
#define SWATH_BITMAP_KERNEL(set)                                                           \
    namespace set {                                                                        \
    void merge_bits(std::uint64_t* into, std::uint64_t* from, std::size_t count);          \
    void invert_bits(std::uint64_t* words, std::size_t count);                             \
    std::size_t count_bits(const std::uint64_t* words, std::size_t count);                 \
    void expand_bits(std::uint64_t* words, std::size_t count, const std::uint32_t* values, \
                     std::uint32_t* out, std::size_t room);                                \
    }
SWATH_BITMAP_KERNEL(portable)
SWATH_BITMAP_KERNEL(avx2)
SWATH_BITMAP_KERNEL(avx512)
#undef SWATH_BITMAP_KERNEL

}  // namespace swath
