// Prints the flow sets of flows.txt, without finish times; always the same. README.md has the format.
#include <cstdint>
#include <cstdio>
#include <random>

namespace {

struct Set {
    const char* name;
    std::uint64_t hosts;
    std::uint64_t flows;
    bool equal_rates;    // if not, each interface has its own rate, 10 to 160 MB/s each way
    std::uint64_t core;  // bytes a second; 0: none
    std::uint64_t latency_ns;
    std::uint64_t starts_ns;  // flows start in [0, starts_ns]
};

constexpr std::uint64_t kRate = 125'000'000;

constexpr Set kSets[] = {
    {"pair", 2, 12, true, 0, 0, 20'000'000},
    {"pair_late", 2, 12, false, 0, 50'000, 20'000'000},
    {"three", 3, 30, false, 0, 0, 50'000'000},
    {"four_together", 4, 40, true, 0, 0, 0},
    {"four_core", 4, 40, false, 150'000'000, 0, 50'000'000},
    {"five_late", 5, 60, false, 0, 200'000, 30'000'000},
    {"eight", 8, 120, true, 0, 0, 60'000'000},
    {"eight_core", 8, 120, true, 400'000'000, 20'000, 60'000'000},
    {"sixteen_together", 16, 240, false, 0, 0, 0},
    {"sixteen", 16, 240, false, 0, 0, 100'000'000},
    {"thirty_two_core", 32, 320, false, 1'000'000'000, 0, 80'000'000},
    {"thirty_two_late", 32, 320, true, 0, 100'000, 80'000'000},
    {"sixty_four", 64, 400, false, 0, 0, 60'000'000},
    {"sixty_four_core", 64, 400, true, 2'500'000'000, 30'000, 60'000'000},
};

}  // namespace

int main() {
    // The standard fixes this generator's numbers, but not those of its distributions.
    std::mt19937_64 random(2000);
    const auto below = [&random](std::uint64_t n) { return random() % n; };
    for (const Set& set : kSets) {
        std::printf("set %s %ju %ju %ju\n", set.name, set.hosts, set.core, set.latency_ns);
        for (std::uint64_t host = 0; host < set.hosts; ++host) {
            const std::uint64_t out = set.equal_rates ? kRate : 10'000'000 + below(150'000'000);
            const std::uint64_t in = set.equal_rates ? kRate : 10'000'000 + below(150'000'000);
            std::printf("host %ju %ju\n", out, in);
        }
        for (std::uint64_t flow = 0; flow < set.flows; ++flow) {
            const std::uint64_t from = below(set.hosts);
            const std::uint64_t to = (from + 1 + below(set.hosts - 1)) % set.hosts;
            const std::uint64_t bytes = 10'000 + below(2'000'000);
            std::printf("flow %ju %ju %ju %ju\n", from, to, bytes, below(set.starts_ns + 1));
        }
    }
}
