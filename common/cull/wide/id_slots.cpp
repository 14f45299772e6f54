#include "common/cull/wide/id_slots.h"

#include <atomic>
#include <cstring>
#include <thread>

#include "common/base/check.h"

namespace swath {
namespace {

// Yields first, because the last part ends soon unless it has lost its core.
void await(const std::atomic<bool>& done) {
    constexpr int kYields = 100;
    for (int i = 0; i < kYields; ++i) {
        if (done.load(std::memory_order_acquire)) return;
        std::this_thread::yield();
    }
    done.wait(false, std::memory_order_acquire);
}

}  // namespace

IdSlots::IdSlots(std::size_t capacity) : capacity_((capacity + 15) / 16 * 16), apart_(capacity_) {}

std::span<const std::uint32_t> IdSlots::share(ThreadTeam& team, std::size_t members,
                                              std::span<const std::size_t> begins,
                                              const std::function<std::size_t(std::size_t)>& work) {
    CHECK(members >= std::size_t{1});
    const std::size_t parts = begins.size();
    if (parts == 0) return {};
    ends_.resize(parts);
    // This is here because nothing below may throw: other members would wait for ever.
    if (together_.size() == 0) together_ = AlignedArray<std::uint32_t>(capacity_);
    std::atomic<std::size_t> next{0};
    std::atomic<std::size_t> left{parts};
    std::atomic<std::size_t> next_copy{0};
    std::atomic<bool> counted{false};
    bool gaps = false;
    const auto count = [&] {
        std::size_t sum = 0;
        for (std::size_t i = 0; i < parts; ++i) {
            gaps |= sum != begins[i] && ends_[i] != 0;
            sum += ends_[i];
            ends_[i] = sum;
        }
        counted.store(true);  // sequentially consistent, see announce() in thread_team.cpp
        counted.notify_all();
    };
    const auto task = [&](std::size_t /*member*/) {
        for (std::size_t i = next++; i < parts; i = next++) {
            ends_[i] = work(i);
            if (left.fetch_sub(1, std::memory_order_acq_rel) == 1) count();
        }
        await(counted);
        if (!gaps) return;
        for (std::size_t i = next_copy++; i < parts; i = next_copy++) {
            const std::size_t to = i == 0 ? 0 : ends_[i - 1];
            if (ends_[i] > to)
                std::memcpy(together_.data() + to, apart_.data() + begins[i],
                            (ends_[i] - to) * sizeof(std::uint32_t));
        }
    };
    team.run(members, task);
    return {gaps ? together_.data() : apart_.data(), ends_.back()};
}

}  // namespace swath
