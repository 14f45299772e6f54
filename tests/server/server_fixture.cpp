#include "tests/server/server_fixture.h"

namespace swath::test {

ServerTest::ServerTest() : blob_(write_blob(cube())) {
    options_.cache = cache_.path_of("models");
    options_.connect_patience = std::chrono::milliseconds(200);
    options_.max_model_bytes = 1 << 20;
    const auto factory = [this](const RendererSetup& asked,
                                const ObjectSet&) -> Result<std::unique_ptr<Renderer>> {
        asked_ = asked;
        if (const Status status = before_renderer_(); !status) return tl::unexpected(status.error());
        return std::make_unique<FakeRenderer>();
    };
    server_ = std::move(*make_server(loop_.io, options_, loop_.clock, factory));
}

ServerSetup ServerTest::setup(std::size_t server) const {
    ServerSetup made;
    made.session = kSession;
    made.server = server_id(server);
    made.model = cache_.path_of("no such model.ply");
    made.digest = digest(blob_.bytes());
    made.blob_bytes = blob_.size();
    made.drawing.cut.depth = 2;
    made.frames_in_flight = 2;
    return made;
}

Connect ServerTest::connect_to(std::size_t before) {
    while (doors_.size() < before) doors_.push_back(std::make_unique<Door>(loop_));
    Connect made{to_string(display_door_.address()), {}};
    for (std::size_t i = 0; i < before; ++i)
        made.peers.push_back({server_id(i), to_string(doors_[i]->address())});
    return made;
}

std::unique_ptr<Peer> ServerTest::come(const Hello& hello) {
    return std::make_unique<Peer>(loop_, connect(loop_, server_->address()), hello);
}

Buffer ServerTest::model_bytes() const {
    Buffer copy;
    copy.append(blob_.data(), blob_.size());
    return copy;
}

std::unique_ptr<Peer> ServerTest::ready_client(const ServerSetup& setup) {
    auto made = client();
    made->send(setup);
    loop_.run_until([&] { return !made->inbox.empty() || made->closed; });
    if (!made->inbox.empty() && std::holds_alternative<NeedModel>(made->inbox.front().first)) {
        EXPECT_EQ(made->expect<NeedModel>(), NeedModel{0});
        made->send(ModelPart{0}, model_bytes());
    }
    objects_ = made->expect<Ready>().objects;
    return made;
}

std::unique_ptr<Peer> ServerTest::connected_client(std::size_t server, std::size_t count) {
    auto made = ready_client(setup(server));
    made->send(connect_to(server));
    display_ = std::make_unique<Peer>(loop_, display_door_.next(), hello_of(Role::kDisplay, kSession));
    others_.clear();
    for (std::size_t i = 0; i < count; ++i) {
        const Hello hello = hello_of(Role::kServer, kSession, i);
        others_.push_back(i < server   ? std::make_unique<Peer>(loop_, doors_[i]->next(), hello)
                          : i > server ? come(hello)
                                       : nullptr);
        if (i > server) loop_.run_until([&] { return others_[i]->connection->has_clock_offset(); });
    }
    made->expect<Connected>();
    return made;
}

RenderFrame ServerTest::task(FrameNumber frame) const {
    RenderFrame made;
    made.frame = frame;
    made.view.width = 8;
    made.view.height = 4;
    for (ObjectId id = 0; id < objects_; ++id) made.group.push_back(id);
    made.content = made.view.viewport();
    made.final_region = {made.content};
    return made;
}

}  // namespace swath::test
