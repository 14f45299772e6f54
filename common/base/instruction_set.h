#pragma once
#include <span>
#include <string_view>

namespace swath {

// The vector instructions that a kernel is compiled for (swath_kernel in cmake/compile_options.cmake). All
// give the same bits; they differ in speed.
enum class InstructionSet {
    kPortable,  // any processor
    kAvx2,      // AVX2, FMA, BMI2: x86-64 since 2013
    kAvx512,    // F, DQ, BW, VL
};

// The sets that this processor has, slowest first; kPortable is always the first.
std::span<const InstructionSet> instruction_sets();
inline InstructionSet best_instruction_set() { return instruction_sets().back(); }
std::string_view name(InstructionSet set);  // "portable", "avx2", "avx512"

}  // namespace swath
