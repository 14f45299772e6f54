#pragma once
#include <cstddef>
#include <map>
#include <vector>

#include "common/base/ids.h"
#include "common/base/result.h"

namespace swath {

// Says which servers take part in a run: those that have the model as it is drawn, are linked to each other
// and do not want to leave. The others come up beside the run, which does not wait for them, and are linked
// in batches to those that are there. No two servers have one number at a time. Sans-I/O. Not thread-safe.
class Roster {
  public:
    // A server to be linked, and the servers that it is to connect to, ascending: those that are linked and,
    // of its batch, those with smaller numbers.
    struct Link {
        ServerId server{};
        std::vector<ServerId> peers;
    };

    bool full() const { return servers_.size() >= kMaxServers; }
    // Adds a server that is not ready yet, and gives it the smallest free number. Not if full.
    ServerId add();
    // The server is gone, or released. No event about it may follow.
    void remove(ServerId server);

    // The server has the model as it is drawn; or no longer.
    void on_ready(ServerId server, bool ready);
    // The next batch: all servers that are ready, unless one is still being linked.
    std::vector<Link> link();
    // An error if the server was not asked.
    Status on_linked(ServerId server);
    // The server gets no more frames. It may say so at any time and more than once.
    void on_leave(ServerId server);

    // A frame with these servers is open; is over.
    void on_issued(const std::vector<ServerId>& servers);
    void on_over(const std::vector<ServerId>& servers);

    // The servers that may take part in the next frame, ascending: the index here is the rank in a plan.
    std::vector<ServerId> members() const;
    bool is_member(ServerId server) const;
    bool has_open_frames(ServerId server) const { return servers_.at(server).open_frames > 0; }
    // The servers that want to leave and have no open frame, so may be released.
    std::vector<ServerId> released() const;

  private:
    struct Server {
        bool ready = false;
        enum class Links { kNone, kUnderWay, kDone } links = Links::kNone;
        bool leaving = false;
        std::size_t open_frames = 0;
    };
    static bool takes_part(const Server& server);

    std::map<ServerId, Server> servers_;
};

}  // namespace swath
