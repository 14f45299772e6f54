#include "common/published/resource/histograms.h"

#include "common/base/parts.h"

namespace swath {
namespace {

// The fewest counters that are worth a member when positions are made.
constexpr std::size_t kCountersPerPart = 1 << 15;

}  // namespace

void Histograms::resize(std::size_t parts, std::size_t cells) {
    parts_ = parts;
    cells_ = cells;
    stride_ = (cells + 15) / 16 * 16;  // whole cache lines
    counts_.room(parts * stride_);
}

std::uint32_t Histograms::sum(std::size_t begin, std::size_t end) {
    std::uint32_t total = 0;
    for (std::size_t part = 0; part < parts_; ++part) {
        const std::uint32_t* counts = row(part);
        for (std::size_t cell = begin; cell < end; ++cell) total += counts[cell];
    }
    return total;
}

void Histograms::accumulate(std::size_t begin, std::size_t end, std::uint32_t position) {
    for (std::size_t cell = begin; cell < end; ++cell) {
        for (std::size_t part = 0; part < parts_; ++part) {
            std::uint32_t& counter = row(part)[cell];
            const std::uint32_t count = counter;
            counter = position;
            position += count;
        }
    }
}

void Histograms::to_positions(ThreadTeam& team) {
    const std::size_t shares = parts_ == 1 ? 1 : parts_for(parts_ * cells_, kCountersPerPart, team);
    if (shares == 1) return accumulate(0, cells_, 0);
    sums_.resize(shares);
    run_parts(team, shares, [&](std::size_t share) {
        const Part range = part_of(cells_, shares, share);
        sums_[share] = sum(range.begin, range.end);
    });
    std::uint32_t position = 0;
    for (std::uint32_t& of_share : sums_) {
        const std::uint32_t count = of_share;
        of_share = position;
        position += count;
    }
    run_parts(team, shares, [&](std::size_t share) {
        const Part range = part_of(cells_, shares, share);
        accumulate(range.begin, range.end, sums_[share]);
    });
}

}  // namespace swath
