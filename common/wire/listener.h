#pragma once
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <memory>

#include "common/base/clock.h"
#include "common/base/result.h"
#include "common/wire/address.h"

namespace swath {

// Accepts TCP connections at one address until it is destroyed. On the io_context's thread.
class Listener {
  public:
    using OnSocket = std::function<void(boost::asio::ip::tcp::socket)>;

    // Port 0 takes a free one. Errors name the address: taken, not ours, unknown host.
    static Result<std::unique_ptr<Listener>> make(boost::asio::io_context& io, const Address& address,
                                                  OnSocket on_socket);
    Address address() const;  // with the port that it got

  private:
    Listener(boost::asio::ip::tcp::acceptor acceptor, std::string host, OnSocket on_socket);
    void accept();

    boost::asio::ip::tcp::acceptor acceptor_;
    std::string host_;
    OnSocket on_socket_;
    boost::asio::steady_timer pause_;
    std::shared_ptr<char> alive_ =
        std::make_shared<char>();  // callbacks hold it weakly: none acts after destruction
};

// Connects to an address; a refusal is tried again until `patience` is over (a program may just be starting).
// Calls back once, with the socket or one line that names the address and the last reason.
void async_connect(boost::asio::io_context& io, const Address& address, Nanoseconds patience,
                   std::function<void(Result<boost::asio::ip::tcp::socket>)> done);

}  // namespace swath
