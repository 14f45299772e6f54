#include "tests/sim/engine/flows.h"

#include <algorithm>
#include <limits>
#include <list>

#include "sim/engine/stream.h"

namespace swath::sim::test {
namespace {

double seconds(Nanoseconds time) { return static_cast<double>(time.count()) * 1e-9; }

}  // namespace

NetworkRates hosts(std::size_t count, NicRates nic) {
    NetworkRates rates;
    rates.hosts.assign(count, nic);
    return rates;
}

NetworkRates random_rates(std::mt19937_64& random, std::size_t hosts, bool equal) {
    std::uniform_real_distribution<double> rate(1e7, 1e9);
    NetworkRates rates;
    for (std::size_t host = 0; host < hosts; ++host)
        rates.hosts.push_back(equal ? NicRates{1e8, 1e8} : NicRates{rate(random), rate(random)});
    return rates;
}

std::vector<TestFlow> random_flows(std::mt19937_64& random, std::size_t hosts, std::size_t flows,
                                   Nanoseconds starts) {
    std::vector<TestFlow> all;
    for (std::size_t i = 0; i < flows; ++i) {
        const std::size_t from = random() % hosts;
        const std::size_t to = (from + 1 + random() % (hosts - 1)) % hosts;
        const auto bytes = static_cast<double>(1 + random() % 100'000);
        const auto start = random() % (static_cast<std::uint64_t>(starts.count()) + 1);
        all.push_back({from, to, bytes, Nanoseconds(start)});
    }
    return all;
}

std::vector<Nanoseconds> arrivals(const NetworkRates& rates, const std::vector<TestFlow>& flows,
                                  Nanoseconds latency) {
    EventQueue events;
    FlowNetwork network(events, rates);
    std::list<Stream> streams;
    std::vector<Nanoseconds> times(flows.size(), Nanoseconds(-1));
    for (std::size_t i = 0; i < flows.size(); ++i) {
        Stream& stream = streams.emplace_back(events, network, latency, flows[i].from, flows[i].to);
        events.at(flows[i].start,
                  [&, i] { stream.send(flows[i].bytes, [&, i] { times[i] = events.now(); }); });
    }
    events.run();
    return times;
}

std::vector<double> filled_rates(const NetworkRates& rates, const std::vector<TestFlow>& flows) {
    const std::size_t hosts = rates.hosts.size();
    std::vector<double> left;  // of each host's out link, each in link, the core
    for (const NicRates& nic : rates.hosts) left.push_back(nic.out);
    for (const NicRates& nic : rates.hosts) left.push_back(nic.in);
    left.push_back(rates.core.value_or(1e30));  // never full
    const std::vector<double> whole = left;
    const auto links_of = [&](const TestFlow& flow) {
        return std::vector<std::size_t>{flow.from, hosts + flow.to, 2 * hosts};
    };
    std::vector<double> found(flows.size());
    std::vector<bool> rising(flows.size(), true);
    while (std::ranges::count(rising, true) > 0) {
        std::vector<int> crossing(left.size());
        for (std::size_t i = 0; i < flows.size(); ++i)
            if (rising[i])
                for (const std::size_t link : links_of(flows[i])) ++crossing[link];
        double step = std::numeric_limits<double>::infinity();
        for (std::size_t link = 0; link < left.size(); ++link)
            if (crossing[link] > 0) step = std::min(step, left[link] / crossing[link]);
        for (std::size_t link = 0; link < left.size(); ++link) left[link] -= step * crossing[link];
        for (std::size_t i = 0; i < flows.size(); ++i) {
            if (!rising[i]) continue;
            found[i] += step;
            for (const std::size_t link : links_of(flows[i]))
                if (left[link] <= 1e-12 * whole[link]) rising[i] = false;
        }
    }
    return found;
}

std::vector<double> slow_arrivals(const NetworkRates& rates, const std::vector<TestFlow>& flows,
                                  Nanoseconds latency) {
    std::vector<double> left;
    for (const TestFlow& flow : flows) left.push_back(flow.bytes);
    std::vector<double> arrived(flows.size(), -1);
    for (double now = 0;;) {
        std::vector<TestFlow> under_way;
        std::vector<std::size_t> numbers;
        double next = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < flows.size(); ++i) {
            const double begin = seconds(flows[i].start + latency);
            if (arrived[i] >= 0) continue;
            if (begin > now) {
                next = std::min(next, begin);
                continue;
            }
            under_way.push_back(flows[i]);
            numbers.push_back(i);
        }
        if (numbers.empty() && next == std::numeric_limits<double>::infinity()) return arrived;
        const std::vector<double> rate = filled_rates(rates, under_way);
        for (std::size_t k = 0; k < numbers.size(); ++k)
            next = std::min(next, now + left[numbers[k]] / rate[k]);
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            double& rest = left[numbers[k]];
            rest -= rate[k] * (next - now);
            if (rest <= 1e-6) arrived[numbers[k]] = next;
        }
        now = next;
    }
}

}  // namespace swath::sim::test
