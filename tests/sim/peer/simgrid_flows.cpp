// Reads flow sets and prints them again, each flow with its finish time by SimGrid's fluid network model.
// README.md has the format. Every set has hosts and links of its own on one platform.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <simgrid/s4u.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace s4u = simgrid::s4u;

struct Flow {
    s4u::Host* from = nullptr;
    s4u::Host* to = nullptr;
    std::uint64_t bytes = 0;
    double start = 0;
};

struct Line {
    std::string text;
    std::optional<Flow> flow;
    long long finish_ns = -1;
};

struct Set {
    std::string name;
    double core = 0;
    double latency = 0;
    std::vector<s4u::Host*> hosts;
    std::vector<s4u::Link*> out;
    std::vector<s4u::Link*> in;
    s4u::Link* core_link = nullptr;
};

void add_routes(s4u::NetZone& zone, const Set& set) {
    for (std::size_t from = 0; from < set.hosts.size(); ++from) {
        for (std::size_t to = 0; to < set.hosts.size(); ++to) {
            if (from == to) continue;
            std::vector<s4u::LinkInRoute> route{s4u::LinkInRoute(set.out[from]),
                                                s4u::LinkInRoute(set.in[to])};
            if (set.core_link) route.emplace_back(set.core_link);
            zone.add_route(set.hosts[from]->get_netpoint(), set.hosts[to]->get_netpoint(), nullptr, nullptr,
                           route, false);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    s4u::Engine engine(&argc, argv);
    // The fluid model alone: no corrections for TCP, no acknowledgements, no preference for fast links.
    for (const char* setting : {"network/model:CM02", "network/TCP-gamma:0", "network/bandwidth-factor:1",
                                "network/latency-factor:1", "network/weight-S:0", "network/crosstraffic:0",
                                "network/loopback-lat:0"})
        s4u::Engine::set_config(setting);
    s4u::NetZone* zone = s4u::create_full_zone("all");

    std::vector<std::unique_ptr<Line>> lines;
    std::vector<std::unique_ptr<Set>> sets;
    for (std::string text; std::getline(std::cin, text);) {
        std::istringstream in(text);
        std::string kind;
        in >> kind;
        lines.push_back(std::make_unique<Line>(Line{text, std::nullopt}));
        if (kind == "set") {
            std::size_t hosts = 0;
            Set& set = *sets.emplace_back(std::make_unique<Set>());
            in >> set.name >> hosts >> set.core >> set.latency;
            set.latency /= 1e9;
            if (set.core > 0) set.core_link = zone->create_link(set.name + "-core", set.core)->seal();
        } else if (kind == "host") {
            Set& set = *sets.back();
            double out = 0;
            double into = 0;
            in >> out >> into;
            const std::string name = set.name + "-" + std::to_string(set.hosts.size());
            set.hosts.push_back(zone->create_host(name, 1e9)->seal());
            set.out.push_back(zone->create_link(name + "-out", out)->set_latency(set.latency)->seal());
            set.in.push_back(zone->create_link(name + "-in", into)->seal());
        } else if (kind == "flow") {
            std::size_t from = 0;
            std::size_t to = 0;
            Flow flow;
            in >> from >> to >> flow.bytes >> flow.start;
            flow.from = sets.back()->hosts.at(from);
            flow.to = sets.back()->hosts.at(to);
            flow.start /= 1e9;
            lines.back()->flow = flow;
        }
    }
    for (const auto& set : sets) add_routes(*zone, *set);
    zone->seal();
    for (const auto& line : lines) {
        if (!line->flow) continue;
        s4u::Actor::create("flow", line->flow->from, [&line] {
            s4u::this_actor::sleep_until(line->flow->start);
            s4u::Comm::sendto(line->flow->from, line->flow->to, line->flow->bytes);
            line->finish_ns = std::llround(s4u::Engine::get_clock() * 1e9);
        });
    }
    engine.run();
    for (const auto& line : lines) {
        std::printf("%s", line->text.c_str());
        if (line->flow) std::printf(" %lld", line->finish_ns);
        std::printf("\n");
    }
}
