#include "client/machines/roster.h"

#include <algorithm>

#include "common/base/check.h"

namespace swath {

ServerId Roster::add() {
    CHECK(full() == false);
    std::size_t number = 0;
    while (servers_.contains(server_id(number))) ++number;
    servers_[server_id(number)] = {};
    return server_id(number);
}

void Roster::remove(ServerId server) { servers_.erase(server); }

void Roster::on_ready(ServerId server, bool ready) { servers_.at(server).ready = ready; }

std::vector<Roster::Link> Roster::link() {
    using Links = Server::Links;
    const bool busy = std::any_of(servers_.begin(), servers_.end(),
                                  [](const auto& entry) { return entry.second.links == Links::kUnderWay; });
    std::vector<Link> batch;
    if (busy) return batch;
    std::vector<ServerId> linked;
    for (const auto& [id, server] : servers_)
        if (server.links == Links::kDone && !server.leaving) linked.push_back(id);
    for (auto& [id, server] : servers_) {
        if (!server.ready || server.leaving || server.links != Links::kNone) continue;
        server.links = Links::kUnderWay;
        Link link{id, linked};
        for (const Link& before : batch) link.peers.push_back(before.server);
        std::sort(link.peers.begin(), link.peers.end());
        batch.push_back(std::move(link));
    }
    return batch;
}

Status Roster::on_linked(ServerId server) {
    Server& known = servers_.at(server);
    if (known.links != Server::Links::kUnderWay) return fail("Connected is not expected now");
    known.links = Server::Links::kDone;
    return {};
}

void Roster::on_leave(ServerId server) { servers_.at(server).leaving = true; }

void Roster::on_issued(const std::vector<ServerId>& servers) {
    for (const ServerId server : servers) ++servers_.at(server).open_frames;
}

void Roster::on_over(const std::vector<ServerId>& servers) {
    for (const ServerId server : servers) --servers_.at(server).open_frames;
}

bool Roster::takes_part(const Server& server) {
    return server.ready && server.links == Server::Links::kDone && !server.leaving;
}

std::vector<ServerId> Roster::members() const {
    std::vector<ServerId> members;
    for (const auto& [id, server] : servers_)
        if (takes_part(server)) members.push_back(id);
    return members;
}

bool Roster::is_member(ServerId server) const {
    const auto found = servers_.find(server);
    return found != servers_.end() && takes_part(found->second);
}

std::vector<ServerId> Roster::released() const {
    std::vector<ServerId> released;
    for (const auto& [id, server] : servers_)
        if (server.leaving && server.open_frames == 0) released.push_back(id);
    return released;
}

}  // namespace swath
