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

// Serves the viewers of this display: a web server and Viewers' decisions, with threads of their own for
// sockets and for encoding, so that a session never waits for them. All queues are bounded, and while nobody
// looks nothing is encoded or copied. One per program; it outlives the sessions, and viewers stay from one to
// the next.
class ViewerHost {
  public:
    struct Numbers {
        std::uint32_t viewers = 0;
        std::uint64_t encoded = 0;      // pictures so far
        std::size_t waiting_bytes = 0;  // summed over viewers; shared bytes count for each
    };
    // Called on the session's executor, perhaps still after the session has ended.
    struct Callbacks {
        std::function<void(std::uint32_t viewers)> on_audience;
        // A wish of the leader: JSON, as it was sent. When wishes come faster than calls, only the newest is
        // told.
        std::function<void(ViewerId viewer, const std::string& wish)> on_wish;
    };

    // Errors name the address. `clock` must outlive this.
    static Result<std::unique_ptr<ViewerHost>> make(const WebServer::Options& options, const Clock& clock);
    ~ViewerHost();
    ViewerHost(const ViewerHost&) = delete;
    ViewerHost& operator=(const ViewerHost&) = delete;

    const Address& address() const { return web_->address(); }
    const std::string& url() const { return web_->url(); }
    Numbers numbers() const;

    // The session that runs calls these, from any one thread. They do not block.

    // Begins a session and returns the number of viewers; on_audience tells of changes. A `live` session
    // takes wishes.
    std::uint32_t begin(bool live, boost::asio::any_io_executor executor, Callbacks callbacks);
    void end();
    // A frame has begun; its picture will follow.
    void announce(FrameNumber frame);
    // `stream` is below kMaxStreams. Nobody may change the picture while it is held here.
    void picture(FrameNumber frame, std::uint32_t stream, std::shared_ptr<const Picture> picture);
    // Fails on anything but a JSON object of at most kMaxNoteBytes.
    Status note(NoteTopic topic, FrameNumber frame, Buffer text);

  private:
    class Messenger;

    explicit ViewerHost(const Clock& clock);
    Status on_text(ViewerId viewer, std::string_view text);
    // Carries out Viewers' actions and sets the timer. With mutex_ held.
    void perform(Viewers::Actions&& actions);
    void send(ViewerId to, SharedBytes bytes, bool text);
    void encode_on_its_thread(EncodePicture&& task);
    void wait_for_deadline();
    void serve();

    const Clock& clock_;
    mutable std::mutex mutex_;
    Viewers viewers_;                       // mutex_ guards everything from here...
    std::shared_ptr<Messenger> messenger_;  // the session's; null without one
    std::uint32_t told_viewers_ = 0;
    std::uint64_t encoded_ = 0;
    bool timer_armed_ = false;  // ... to here

    boost::asio::io_context io_{1};
    boost::asio::steady_timer timer_{io_};  // thread_'s
    std::unique_ptr<WebServer> web_;        // thread_'s
    std::thread thread_;
    // PNG takes long, and JPEG need not wait for it.
    std::unique_ptr<WorkerThread> encoders_[kAll<ViewFormat>.size()];
};

}  // namespace swath
