#pragma once
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <memory>
#include <vector>

#include "client/machines/server_source.h"

namespace swath {

// Asks a source of servers every second or so, until it is destroyed. On the io_context's thread.
class Discovery {
  public:
    // The source's addresses, without doubles. An error ends nothing: the name may not be known yet. IPv6
    // addresses of a host count only if it has no others, since they would be the same servers again.
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
    // Callbacks hold it weakly: none acts after destruction.
    std::shared_ptr<char> alive_ = std::make_shared<char>();
};

}  // namespace swath
