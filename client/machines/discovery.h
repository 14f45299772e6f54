#pragma once
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <memory>
#include <vector>

#include "client/machines/server_source.h"

namespace swath {

// Asks a source of servers again and again, every second or so, until it is destroyed. On the io_context's
// thread.
class Discovery {
  public:
    // What the source says now, without doubles. An error is no end: the name may not be known yet. Of a
    // host's addresses those of IPv6 count only where it has no other: they would be the same servers again.
    using OnFound = std::function<void(const Result<std::vector<Address>>&)>;
    Discovery(boost::asio::io_context& io, ServerSource source, OnFound on_found);

    void start() { ask(); }

  private:
    void ask();
    void answer(Result<std::vector<Address>> found);

    ServerSource source_;
    OnFound on_found_;
    boost::asio::ip::tcp::resolver resolver_;
    boost::asio::steady_timer timer_;
    std::shared_ptr<char> alive_ =
        std::make_shared<char>();  // callbacks hold it weakly: none acts after destruction
};

}  // namespace swath
