#include "common/base/instruction_set.h"

#include <vector>

#include "common/base/check.h"

namespace swath {

std::span<const InstructionSet> instruction_sets() {
    static const std::vector<InstructionSet> sets = [] {
        std::vector<InstructionSet> found{InstructionSet::kPortable};
#if defined(__x86_64__)
        if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
            __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2")) {
            found.push_back(InstructionSet::kAvx2);
            if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
                found.push_back(InstructionSet::kAvx512);
        }
#endif
        return found;
    }();
    return sets;
}

std::string_view name(InstructionSet set) {
    switch (set) {
        case InstructionSet::kPortable:
            return "portable";
        case InstructionSet::kAvx2:
            return "avx2";
        case InstructionSet::kAvx512:
            return "avx512";
    }
    CHECK(false);
    return {};
}

}  // namespace swath
