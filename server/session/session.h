#pragma once
#include <boost/asio/io_context.hpp>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "common/wire/connection.h"
#include "common/wire/pieces.h"
#include "server/session/draw_thread.h"
#include "server/session/model_store.h"
#include "server/session/server.h"
#include "server/swap/frame_swap.h"

namespace swath {

// A client's run on a server: set-up, connections to peers and display, and the frames. It does what
// FrameSwap decides. On the io_context's thread; callbacks of work in progress keep it alive, and do nothing
// after stop().
class ServerSession final : public Session, public std::enable_shared_from_this<ServerSession> {
  public:
    ServerSession(boost::asio::io_context& io, const ServerOptions& options, const Clock& clock,
                  RendererFactory factory, std::shared_ptr<Connection> client);

    std::uint64_t id() const override { return setup_.session; }
    ServerId server() const override { return setup_.server; }
    // A server that joined later connects.
    Status on_peer(const std::shared_ptr<Connection>& connection, const Hello& hello) override;
    Status on_message(const std::shared_ptr<Connection>& from, Message&& message, Buffer&& body) override;
    bool on_closed(const std::shared_ptr<Connection>& connection, const Status& why) override;
    void leave() override { tell_client(Leave{}); }
    void stop() override;

  private:
    struct OpenFrame {
        RenderFrame task;
        PixelFrame pixels;

        ServerReport report;
    };

    void on_display_closed(const Connection& connection, const Status& why);
    void on_server_closed(ServerId id, const Connection& connection, const Status& why);
    Status from_client(Message&& message, Buffer&& body);
    Status on_setup(const ServerSetup& setup);
    void need_model_part();
    Status on_model_part(const ModelPart& part, const Buffer& body);
    void load(Mesh mesh);
    Status on_loaded(const Result<SceneInfo>& loaded);
    Status on_reconfigure(const Reconfigure& reconfigure);
    // The callback of load() and reconfigure(), which comes back to this thread.
    std::function<void(Result<SceneInfo>)> when_loaded();
    Status on_connect(const Connect& connect);
    void connect(const std::string& address, Role role, ServerId id);
    Status on_peer_hello(Role role, ServerId id, const Hello& hello) const;
    void on_heard();
    Status on_render_frame(RenderFrame&& task);
    Status check(const RenderFrame& task) const;
    Status from_server(ServerId from, Message&& message, Buffer&& body);
    Status perform(const FrameSwap::Actions& actions, const Piece* arrived = nullptr);
    void draw(OpenFrame& frame);
    Status on_drawn(FrameNumber number, DrawResult& drawn);
    Status send_swath(OpenFrame& frame, ServerId to);
    Status composite(OpenFrame& frame, ServerId from, const Piece& piece);
    Status send_tile(OpenFrame& frame);
    Status finish(FrameNumber number);
    void tell_client(const Message& message);
    // Goes on with something that another thread began, unless the session is over; errors end the session.
    void resume(const std::function<Status()>& rest);
    void give_up(const Error& error);

    boost::asio::io_context& io_;
    ServerOptions options_;
    const Clock& clock_;
    std::shared_ptr<Connection> client_;
    ModelStore store_;
    std::unique_ptr<DrawThread> draw_thread_;

    ServerSetup setup_;
    bool set_up_ = false;
    bool part_awaited_ = false;
    bool ready_ = false;
    bool reconfiguring_ = false;
    bool connecting_ = false;
    bool connected_ = false;
    std::size_t unheard_ = 0;  // servers it connects to that have not read our Hello
    Buffer blob_;              // the model, if the client sends it
    std::size_t objects_ = 0;
    std::map<ServerId, std::shared_ptr<Connection>> peers_;  // other servers
    std::shared_ptr<Connection> display_;
    std::unique_ptr<FrameSwap> swap_;
    std::map<FrameNumber, OpenFrame> frames_;
    Pieces early_;
    std::vector<PixelFrame> pool_;
};

}  // namespace swath
