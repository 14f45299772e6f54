#pragma once
#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "common/base/clock.h"

namespace swath {

using Ids = std::vector<std::uint32_t>;

inline const SteadyClock kClock;

// Random keys below `points`.
inline Ids random_keys(std::size_t objects, std::uint64_t points, unsigned seed) {
    std::mt19937_64 random(seed);
    Ids keys(objects);
    for (std::uint32_t& key : keys) key = static_cast<std::uint32_t>(random() % points);
    return keys;
}

// About `share` of the ids below `objects`, ascending.
inline Ids some_ids(std::size_t objects, double share, unsigned seed) {
    std::mt19937 random(seed);
    std::bernoulli_distribution visible(share);
    Ids ids;
    for (std::size_t id = 0; id < objects; ++id)
        if (visible(random)) ids.push_back(static_cast<std::uint32_t>(id));
    return ids;
}

inline Ids all_ids(std::size_t objects) { return some_ids(objects, 1, 1); }

// Every way to sort must return this.
inline Ids by_key_and_id(std::span<const std::uint32_t> keys, Ids ids) {
    std::ranges::stable_sort(ids, {}, [&](std::uint32_t id) { return keys[id]; });
    return ids;
}

inline Ids copy(std::span<const std::uint32_t> ids) { return {ids.begin(), ids.end()}; }

}  // namespace swath
