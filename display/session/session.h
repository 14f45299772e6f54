#pragma once
#include <boost/asio/io_context.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/worker_thread.h"
#include "common/wire/pieces.h"
#include "common/wire/session_host.h"
#include "display/assemble/assembly.h"
#include "display/session/picture_pool.h"
#include "display/view/viewer_host.h"

namespace swath {

// A client's run on the display. It does what Assembly decides. A complete picture is encoded before its
// frame is reported, so that slow encoding holds the client back instead of piling up. Viewers get the same
// pictures and hold nobody back.
class DisplaySession final : public Session, public std::enable_shared_from_this<DisplaySession> {
  public:
    // `viewers` outlives the session; null if nobody can look.
    DisplaySession(boost::asio::io_context& io, const Clock& clock, ViewerHost* viewers,
                   std::shared_ptr<Connection> client);

    std::uint64_t id() const override { return setup_.session; }
    ServerId server() const override { return {}; }
    Status on_peer(const std::shared_ptr<Connection>& connection, const Hello& hello) override;
    Status on_message(const std::shared_ptr<Connection>& from, Message&& message, Buffer&& body) override;
    bool on_closed(const std::shared_ptr<Connection>& connection, const Status& why) override;
    void leave() override { give_up({"it was stopped"}); }
    void stop() override;

  private:
    struct OpenFrame {
        AssembleFrame task;
        std::shared_ptr<Picture> picture;
        DisplayReport report;
    };

    Status from_client(const Message& message, Buffer&& body);
    Status on_setup(const DisplaySetup& setup);
    std::uint32_t begin_viewing();
    Status on_note(const Note& note, Buffer&& text);
    void pass_wish();
    Status on_assemble(const AssembleFrame& task);
    Status from_server(ServerId from, const Message& message, Buffer&& body);
    Status perform(const Assembly::Actions& actions, const Piece* arrived = nullptr);
    Status assemble(OpenFrame& frame, ServerId from, const Piece& tile);
    void complete(FrameNumber number);
    void tell(const Message& message, Buffer body = {});
    void give_up(const Error& error);

    boost::asio::io_context& io_;
    const Clock& clock_;
    ViewerHost* const viewers_;
    std::shared_ptr<Connection> client_;
    DisplaySetup setup_;
    bool stopped_ = false;
    // The newest wish that the client does not have yet. It gets one at a time, so that it never works off
    // old ones.
    std::optional<std::pair<ViewerId, std::string>> next_wish_;
    bool wish_under_way_ = false;  // until the client's next state note
    std::map<ServerId, std::shared_ptr<Connection>> servers_;
    std::unique_ptr<Assembly> assembly_;
    std::map<FrameNumber, OpenFrame> frames_;
    Pieces early_;
    PicturePool pool_;
    std::unique_ptr<WorkerThread> encoder_;
};

}  // namespace swath
