#include "sim/engine/flow_network.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/base/check.h"

namespace swath::sim {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;
// Levels within this ratio are equal: taking about a thousand flows' rates from a link's rounds that much.
constexpr double kSameLevel = 1 + 1e-10;
// Slack for rounding in a flow's time in nanoseconds.
constexpr double kSlackNs = 1e-3;
constexpr double kRelativeSlack = 1e-12;
constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kLongestNs = 4e18;  // 127 years

void check_rate(double rate) {
    CHECK(rate > 0);
    CHECK(std::isfinite(rate));
}

// These orders make heaps with the first one on top.
constexpr auto later_end = [](const auto& a, const auto& b) {
    return a.until != b.until ? a.until > b.until : a.number > b.number;
};
constexpr auto later_level = [](const auto& a, const auto& b) {
    return a.level != b.level ? a.level > b.level : a.link > b.link;
};

}  // namespace

FlowNetwork::FlowNetwork(EventQueue& events, NetworkRates rates)
    : events_(events), bytes_out_(rates.hosts.size()), bytes_in_(rates.hosts.size()) {
    const std::size_t hosts = rates.hosts.size();
    links_.resize(2 * hosts);
    for (std::size_t host = 0; host < hosts; ++host) {
        check_rate(rates.hosts[host].out);
        check_rate(rates.hosts[host].in);
        links_[host].rate = rates.hosts[host].out;
        links_[hosts + host].rate = rates.hosts[host].in;
    }
    if (rates.core) {
        check_rate(*rates.core);
        core_.rate = *rates.core;
    }
}

void FlowNetwork::send(std::size_t from, std::size_t to, double bytes, EventQueue::Action arrived) {
    CHECK(from < bytes_out_.size());
    CHECK(to < bytes_in_.size());
    CHECK(bytes >= 0);
    CHECK(std::isfinite(bytes));
    CHECK(static_cast<bool>(arrived));
    if (from != to) {
        bytes_out_[from] += bytes;
        bytes_in_[to] += bytes;
        bytes_ += bytes;
    }
    if (from == to || bytes == 0) {
        events_.after(Nanoseconds(0), std::move(arrived));
        return;
    }
    Index flow = static_cast<Index>(flows_.size());
    if (free_flows_.empty()) {
        flows_.emplace_back();
    } else {
        flow = free_flows_.back();
        free_flows_.pop_back();
    }
    flows_[flow] = {static_cast<Index>(from), static_cast<Index>(to), bytes, sent_++, std::move(arrived)};
    begin(flow);
}

double FlowNetwork::rate(std::size_t from, std::size_t to) const {
    CHECK(from < bytes_out_.size());
    CHECK(to < bytes_in_.size());
    const auto found = pair_index_.find(from * bytes_in_.size() + to);
    return found == pair_index_.end() ? 0 : pairs_[found->second].rate;
}

void FlowNetwork::begin(Index flow) {
    const Index index = pair_of(flows_[flow].from, flows_[flow].to);
    Pair& pair = pairs_[index];
    if (pair.flows.empty()) activate(index);
    pair.flows.push_back({served(pair) + flows_[flow].bytes, flows_[flow].number, flow});
    std::ranges::push_heap(pair.flows, later_end);
    count(index, 1);
    links_[shares_[index].out_link].grown = true;
    links_[shares_[index].in_link].grown = true;
    change(index);
}

// Ends all flows that are due now.
void FlowNetwork::end_flows() {
    wake_.reset();
    ended_.clear();
    // Backwards, because deactivate() fills gaps from behind.
    for (std::size_t place = active_.size(); place-- > 0;) {
        if (ends_[place] > events_.now()) continue;
        const Index index = active_[place];
        Pair& pair = pairs_[index];
        while (!pair.flows.empty() && end_of(pair) <= events_.now()) {
            ended_.push_back(pair.flows.front());
            std::ranges::pop_heap(pair.flows, later_end);
            pair.flows.pop_back();
            count(index, -1);
        }
        change(index);
        lowest_ended_ = std::min(lowest_ended_, pair.rate);
        if (pair.flows.empty()) deactivate(index);
    }
    std::ranges::sort(ended_, {}, &Waiting::number);
    for (std::size_t i = 0; i < ended_.size(); ++i) {  // an action may send(), but does not change ended_
        const Index flow = ended_[i].flow;
        const EventQueue::Action arrived = std::exchange(flows_[flow].arrived, nullptr);
        free_flows_.push_back(flow);
        arrived();
    }
}

// Finds new rates for all flows that the instant's changes can reach.
void FlowNetwork::share() {
    sharing_asked_ = false;
    ++round_;
    find_kept();
    reach();
    fill();
    for (const Index pair : reached_pairs_) apply(pair);
    wake_at_next_end();
}

// Up to the level kept_ filling goes as it went before the instant's changes. A flow that ended makes no
// difference below its rate; one that began makes none before a link of its own is full, at the earliest at
// an equal part of the link for each of its flows.
void FlowNetwork::find_kept() {
    kept_ = std::exchange(lowest_ended_, kNone);
    bool grown = false;
    for (const Index index : touched_) {
        Link& link = links_[index];
        if (!std::exchange(link.grown, false) || link.flows == 0) continue;
        kept_ = std::min(kept_, link.rate / link.flows);
        grown = true;
    }
    if (has_core() && grown) kept_ = std::min(kept_, core_.rate / core_.flows);
    kept_ /= kSameLevel;
}

// Collects the links and pairs that are connected to a change.
void FlowNetwork::reach() {
    const auto reach_link = [&](Index index) {
        Link& link = links_[index];
        if (link.round == round_ || link.flows == 0) return;
        link.round = round_;
        link.given = 0;
        link.open = link.flows;
        reached_links_.push_back(index);
    };
    reached_links_.clear();
    reached_pairs_.clear();
    for (const Index link : touched_) {
        links_[link].touched = false;
        reach_link(link);
    }
    touched_.clear();
    if (has_core()) {  // the core connects them all
        for (Index link = 0; link < links_.size(); ++link) reach_link(link);
    }
    const std::size_t hosts = bytes_out_.size();
    for (std::size_t i = 0; i < reached_links_.size(); ++i) {
        if (reached_links_.size() == links_in_use_) {
            reached_pairs_ = active_;
            return;
        }
        const Index link = reached_links_[i];
        const bool out = link < hosts;
        for (const Index pair : links_[link].pairs) {
            reach_link(out ? shares_[pair].in_link : shares_[pair].out_link);
            if (out) reached_pairs_.push_back(pair);
        }
    }
}

// Progressive filling: the rates of all flows rise together. Those that cross the link which is full first
// keep theirs, the others rise on. A link's level is the rate at which it will be full. It can only rise on
// the way, so the heap need not learn of that before the link is on top.
void FlowNetwork::fill() {
    if (has_core()) {
        core_.given = 0;
        core_.open = core_.flows;
    }
    for (const Index pair : reached_pairs_)
        if (shares_[pair].rate < kept_) give(pair, shares_[pair].rate);
    levels_.clear();
    for (const Index link : reached_links_)
        if (links_[link].open > 0) levels_.push_back({links_[link].level(), link});
    std::ranges::make_heap(levels_, later_level);
    double risen = 0;
    while (!levels_.empty()) {
        const Level first = levels_.front();
        const bool core_first = has_core() && core_.open > 0 && core_.level() <= first.level;
        if (!core_first) {
            std::ranges::pop_heap(levels_, later_level);
            levels_.pop_back();
            Link& link = links_[first.link];
            if (link.open == 0) continue;
            if (const double level = link.level(); level > first.level * kSameLevel) {
                levels_.push_back({level, first.link});
                std::ranges::push_heap(levels_, later_level);
                continue;
            }
        }
        const double level = core_first ? core_.level() : first.level;
        if (level > risen * kSameLevel) risen = level;
        for (const Index pair : core_first ? reached_pairs_ : links_[first.link].pairs)
            if (shares_[pair].round != round_) give(pair, risen);
        if (core_first) return;
    }
}

void FlowNetwork::give(Index pair, double rate) {
    Share& share = shares_[pair];
    share.round = round_;
    share.rate = rate;
    const double flows = share.flows;
    for (Link* link : {&links_[share.out_link], &links_[share.in_link], has_core() ? &core_ : nullptr}) {
        if (!link) continue;
        link->given += flows * rate;
        link->open -= flows;
    }
}

void FlowNetwork::apply(Index index) {
    Pair& pair = pairs_[index];
    const double rate = shares_[index].rate;
    if (rate != pair.rate) {
        pair.served = served(pair);
        pair.since = events_.now();
        pair.rate = rate;
    } else if (!pair.changed) {
        return;
    }
    pair.changed = false;
    ends_[pair.active_place] = end_of(pair);
}

void FlowNetwork::wake_at_next_end() {
    if (active_.empty()) {
        if (wake_) events_.cancel(*wake_);
        wake_.reset();
        return;
    }
    const Nanoseconds next = *std::ranges::min_element(ends_);
    if (wake_ && next == wake_at_) return;
    if (wake_) events_.cancel(*wake_);
    wake_at_ = next;
    wake_ = events_.at(next, [this] { end_flows(); });
}

FlowNetwork::Index FlowNetwork::pair_of(Index from, Index to) {
    const std::size_t hosts = bytes_out_.size();
    const auto [found, is_new] =
        pair_index_.try_emplace(from * hosts + to, static_cast<Index>(pairs_.size()));
    if (is_new) {
        pairs_.emplace_back();
        shares_.push_back({from, static_cast<Index>(hosts + to), 0, 0, 0});
    }
    return found->second;
}

void FlowNetwork::activate(Index index) {
    Pair& pair = pairs_[index];
    pair.served = 0;
    pair.since = events_.now();
    pair.rate = 0;
    shares_[index].rate = kNone;
    pair.active_place = static_cast<Index>(active_.size());
    active_.push_back(index);
    ends_.push_back(Nanoseconds::max());
    std::vector<Index>& out = links_[shares_[index].out_link].pairs;
    pair.out_place = static_cast<Index>(out.size());
    out.push_back(index);
    std::vector<Index>& in = links_[shares_[index].in_link].pairs;
    pair.in_place = static_cast<Index>(in.size());
    in.push_back(index);
}

void FlowNetwork::deactivate(Index index) {
    Pair& pair = pairs_[index];
    pair.rate = 0;
    pair.changed = false;
    const auto take_out = [this](std::vector<Index>& places, Index place, Index Pair::*member) {
        places[place] = places.back();
        pairs_[places[place]].*member = place;
        places.pop_back();
    };
    ends_[pair.active_place] = ends_.back();
    ends_.pop_back();
    take_out(active_, pair.active_place, &Pair::active_place);
    take_out(links_[shares_[index].out_link].pairs, pair.out_place, &Pair::out_place);
    take_out(links_[shares_[index].in_link].pairs, pair.in_place, &Pair::in_place);
}

void FlowNetwork::count(Index index, int flows) {
    const auto add = [flows](Index& to) { to = static_cast<Index>(static_cast<int>(to) + flows); };
    add(shares_[index].flows);
    if (has_core()) add(core_.flows);
    for (const Index link : {shares_[index].out_link, shares_[index].in_link}) {
        const bool was_idle = links_[link].flows == 0;
        add(links_[link].flows);
        if (was_idle) ++links_in_use_;
        if (links_[link].flows == 0) --links_in_use_;
    }
}

// Marks the pair, whose flows have changed at this instant, and its links.
void FlowNetwork::change(Index index) {
    pairs_[index].changed = true;
    for (const Index link : {shares_[index].out_link, shares_[index].in_link}) {
        if (std::exchange(links_[link].touched, true)) continue;
        touched_.push_back(link);
    }
    if (std::exchange(sharing_asked_, true)) return;
    events_.at_end_of_instant([this] { share(); });
}

// Bytes until now.
double FlowNetwork::served(const Pair& pair) const {
    return pair.served +
           pair.rate * (static_cast<double>((events_.now() - pair.since).count()) / kNanosecondsPerSecond);
}

// The time at which the pair's first flow ends.
Nanoseconds FlowNetwork::end_of(const Pair& pair) const {
    const double ns =
        std::max(0.0, pair.flows.front().until - pair.served) / pair.rate * kNanosecondsPerSecond;
    CHECK(ns < kLongestNs);
    const double least = std::max(0.0, ns - kSlackNs - ns * kRelativeSlack);
    const auto whole = static_cast<std::int64_t>(least);
    return pair.since + Nanoseconds(static_cast<double>(whole) < least ? whole + 1 : whole);
}

}  // namespace swath::sim
