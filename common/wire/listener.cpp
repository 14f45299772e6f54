#include "common/wire/listener.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <new>

namespace swath {
namespace asio = boost::asio;
using asio::ip::tcp;

Result<std::unique_ptr<Listener>> Listener::make(asio::io_context& io, const Address& address,
                                                 OnSocket on_socket) {
    boost::system::error_code error;
    const auto failed = [&] { return fail("cannot listen on {}: {}", to_string(address), error.message()); };
    tcp::resolver resolver(io);
    const auto found =
        resolver.resolve(address.host, std::to_string(address.port), tcp::resolver::passive, error);
    if (error) return failed();
    const tcp::endpoint endpoint = found.begin()->endpoint();
    tcp::acceptor acceptor(io);
    acceptor.open(endpoint.protocol(), error);
    if (error) return failed();
    acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (error) return failed();
    acceptor.bind(endpoint, error);
    if (error) return failed();
    acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) return failed();
    std::unique_ptr<Listener> listener(new Listener(std::move(acceptor), address.host, std::move(on_socket)));
    listener->accept();
    return listener;
}

Listener::Listener(tcp::acceptor acceptor, std::string host, OnSocket on_socket)
    : acceptor_(std::move(acceptor)),
      host_(std::move(host)),
      on_socket_(std::move(on_socket)),
      pause_(acceptor_.get_executor()) {}

Address Listener::address() const { return {host_, acceptor_.local_endpoint().port()}; }

void Listener::accept() {
    // Destroying the acceptor cancels the wait, but not a socket that has been accepted and awaits its turn.
    acceptor_.async_accept([this, alive = std::weak_ptr<char>(alive_)](const boost::system::error_code& error,
                                                                       tcp::socket socket) {
        if (alive.expired() || error == asio::error::operation_aborted) return;
        if (!error) {
            try {
                on_socket_(std::move(socket));
            } catch (const std::bad_alloc&) {  // this one is lost; the next may be had
            }
            if (!alive.expired()) accept();
            return;
        }
        // Out of descriptors, say: wait instead of spinning.
        pause_.expires_after(std::chrono::milliseconds(100));
        pause_.async_wait([this, alive](const boost::system::error_code& stopped) {
            if (!stopped && !alive.expired()) accept();
        });
    });
}

namespace {

class Connector : public std::enable_shared_from_this<Connector> {
  public:
    Connector(asio::io_context& io, const Address& address, Nanoseconds patience,
              std::function<void(Result<tcp::socket>)> done)
        : address_(address),
          patience_(patience),
          done_(std::move(done)),
          resolver_(io),
          socket_(io),
          timer_(io),
          retry_(io) {}

    void start() {
        timer_.expires_after(patience_);
        timer_.async_wait([self = shared_from_this()](const boost::system::error_code& error) {
            if (!error) self->give_up();
        });
        attempt();
    }

  private:
    void attempt() {
        resolver_.async_resolve(address_.host, std::to_string(address_.port),
                                [self = shared_from_this()](const boost::system::error_code& error,
                                                            const tcp::resolver::results_type& found) {
                                    if (!self->done_) return;
                                    if (error) return self->try_again(error);
                                    self->connect(found);
                                });
    }
    void connect(const tcp::resolver::results_type& found) {
        asio::async_connect(
            socket_, found,
            [self = shared_from_this()](const boost::system::error_code& error, const tcp::endpoint&) {
                if (!self->done_) return;
                if (error) return self->try_again(error);
                self->finish(std::move(self->socket_));
            });
    }
    void try_again(const boost::system::error_code& error) {
        last_ = error;
        retry_.expires_after(std::chrono::milliseconds(100));
        retry_.async_wait([self = shared_from_this()](const boost::system::error_code& stopped) {
            if (!stopped && self->done_) self->attempt();
        });
    }
    void give_up() {
        const std::string why = last_ ? last_.message() : "no answer";
        finish(fail("cannot connect to {}: {} (tried for {:.1f} s)", to_string(address_), why,
                    std::chrono::duration<double>(patience_).count()));
    }
    void finish(Result<tcp::socket> result) {
        if (!done_) return;
        timer_.cancel();
        retry_.cancel();
        resolver_.cancel();
        const auto done = std::exchange(done_, nullptr);
        if (!result) {
            boost::system::error_code ignored;
            socket_.close(ignored);
        }
        done(std::move(result));
    }

    Address address_;
    Nanoseconds patience_;
    std::function<void(Result<tcp::socket>)> done_;
    tcp::resolver resolver_;
    tcp::socket socket_;
    asio::steady_timer timer_;
    asio::steady_timer retry_;
    boost::system::error_code last_;
};

}  // namespace

void async_connect(asio::io_context& io, const Address& address, Nanoseconds patience,
                   std::function<void(Result<tcp::socket>)> done) {
    std::make_shared<Connector>(io, address, patience, std::move(done))->start();
}

}  // namespace swath
