#include "sim/engine/station.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"

namespace swath::sim {

void Station::submit(Nanoseconds duration, Done done) {
    CHECK(duration.count() >= 0);
    CHECK(static_cast<bool>(done));
    const Nanoseconds begin = std::max(events_.now(), free_at_);
    free_at_ = begin + duration;
    busy_ += duration;
    jobs_.push_back({begin, free_at_, std::move(done)});
    // Jobs end in the order in which they came, even at the same time.
    events_.at(free_at_, [this] {
        const Job job = std::move(jobs_.front());
        jobs_.pop_front();
        job.done(job.begin, job.end);
    });
}

}  // namespace swath::sim
