#pragma once
#include <cstddef>
#include <map>
#include <vector>

#include "common/base/ids.h"
#include "common/base/result.h"

namespace swath {

// Which servers take part in a run: those that have the model as it is drawn, are linked to each other and do
// not want to leave. The others come up beside the run, which does not wait for them, and are linked in
// batches to those that are there. A server's number is nobody else's while it is here. Sans-I/O. Not
// thread-safe.
class Roster {
  public:
    // A server to be linked, and those that it is to connect to, ascending: the ones that are linked and,
    // of its batch, the ones with smaller numbers.
    struct Link {
        ServerId server{};
        std::vector<ServerId> peers;
    };

    bool full() const { return servers_.size() >= kMaxServers; }
    // One that is not ready yet, with the smallest number that is free. Not when full.
    ServerId add();
    // Gone, or let go. Nothing about it may follow.
    void remove(ServerId server);

    // It has the model as it is drawn; or not any more.
    void on_ready(ServerId server, bool ready);
    // The next batch: all that are ready, unless one is still being linked.
    std::vector<Link> link();
    // An error: it was not asked.
    Status on_linked(ServerId server);
    // No more frames with it. It may say so at any time and more than once.
    void on_leave(ServerId server);

    // A frame with these is open; is over.
    void on_issued(const std::vector<ServerId>& servers);
    void on_over(const std::vector<ServerId>& servers);

    // Those that may take part in the next frame, ascending: a server's place here is its place in a plan.
    std::vector<ServerId> members() const;
    bool is_member(ServerId server) const;
    bool has_open_frames(ServerId server) const { return servers_.at(server).open_frames > 0; }
    // Those that want to leave and have no open frame: to be let go.
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
