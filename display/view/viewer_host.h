#pragma once
#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "common/base/clock.h"
#include "common/base/result.h"
#include "common/base/worker_thread.h"
#include "display/view/viewers.h"
#include "display/view/web_server.h"

namespace swath {

// The people who look at what this display shows: a web server and what Viewers decides, with threads of
// their own for sockets and for coding pictures, so that a session never waits for them. What waits is
// bounded, and while nobody looks nothing is coded or copied. One per program; it outlives the sessions, and
// viewers stay from one to the next.
class ViewerHost {
  public:
    struct Numbers {
        std::uint32_t viewers = 0;
        std::uint64_t encoded = 0;      // pictures so far
        std::size_t waiting_bytes = 0;  // for all viewers together, what they share counted for each
    };
    // What a session hears, on the executor that it names. They may still be called when the session has
    // ended.
    struct Callbacks {
        std::function<void(std::uint32_t viewers)> on_audience;
        // JSON by the leading viewer, as it was sent. When they come faster than this is called, the newest.
        std::function<void(ViewerId viewer, const std::string& wish)> on_wish;
    };

    // Errors name the address. `clock` outlives it.
    static Result<std::unique_ptr<ViewerHost>> make(const WebServer::Options& options, const Clock& clock);
    ~ViewerHost();
    ViewerHost(const ViewerHost&) = delete;
    ViewerHost& operator=(const ViewerHost&) = delete;

    const Address& address() const { return web_->address(); }
    const std::string& url() const { return web_->url(); }
    Numbers numbers() const;

    // The rest is for the one session that runs, from any one thread. None of it blocks.

    // How many look; on_audience tells when that changes. With `live` the session takes wishes.
    std::uint32_t begin(bool live, boost::asio::any_io_executor executor, Callbacks callbacks);
    void end();
    // A frame has begun; its picture follows.
    void announce(FrameNumber frame);
    // `stream` is below kMaxStreams. Nobody changes the picture while it is held here.
    void picture(FrameNumber frame, std::uint32_t stream, std::shared_ptr<const Picture> picture);
    // Fails on what is no JSON object of at most kMaxNoteBytes.
    Status note(NoteTopic topic, FrameNumber frame, Buffer text);

  private:
    class Messenger;

    explicit ViewerHost(const Clock& clock);
    Status on_text(ViewerId viewer, std::string_view text);
    // With mutex_ held: does what Viewers wants, and looks at when it wants to be called.
    void run(Viewers::Actions&& actions);
    void send(ViewerId to, SharedBytes bytes, bool text);
    void encode_on_its_thread(EncodePicture&& task);
    void wait_for_deadline();
    void serve();

    const Clock& clock_;
    mutable std::mutex mutex_;
    Viewers viewers_;                       // guarded by mutex_, as all up to...
    std::shared_ptr<Messenger> messenger_;  // of the session, null without one
    std::uint32_t told_viewers_ = 0;
    std::uint64_t encoded_ = 0;
    bool timer_armed_ = false;  // ... here

    boost::asio::io_context io_{1};
    boost::asio::steady_timer timer_{io_};  // thread_'s
    std::unique_ptr<WebServer> web_;        // thread_'s
    std::thread thread_;
    // A picture without loss takes long to code: what moves need not wait for it.
    std::unique_ptr<WorkerThread> encoders_[kViewFormats];
};

}  // namespace swath
