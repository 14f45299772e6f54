#pragma once
#include <cstddef>
#include <cstdint>

namespace swath {

// What RankBitmap does with words of 64 marks. A kernel: see swath_kernel in cmake/compile_options.cmake.
//
// merge_bits: adds to `into` the marks of `from` and clears `from`, of `count` words each.
//
// invert_bits: sets what is clear and clears what is set.
//
// count_bits: how many bits are set.
//
// expand_bits: writes values[i] for every bit i that is set, ascending, and clears the words. `room` is
// count_bits() of the words: no more is written. Of a word with fewer than 64 places left to write to, only
// values whose bits are set are read, so `values` may end within the last word.
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
