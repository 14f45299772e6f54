#pragma once
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "common/base/check.h"
#include "common/scene/model_blob.h"
#include "server/session/server.h"
#include "tests/support/models.h"
#include "tests/support/wire_peer.h"

namespace swath::test {

// Draws the first object of its ranges as a flat rectangle at depth 0.5, whose colour and id name that
// object.
class FakeRenderer final : public Renderer {
  public:
    Status draw(std::span<const TriangleRange> ranges, const View& view, const Rect& rect) override {
        if (view.height == 13) return fail("13 rows bring bad luck");
        objects_.clear();
        for (const TriangleRange& range : ranges) objects_.push_back(range.object);
        rect_ = rect;
        return {};
    }
    Status read(const Rect& rect, PixelFrame& frame) override {
        CHECK(rect_.contains(rect) == true);
        CHECK(frame.rect().contains(rect) == true);
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x) {
                *frame.depth(x, y) = objects_.empty() ? kFarDepth : 0.5f;
                if (objects_.empty()) continue;
                *frame.colour(x, y) = 0xff000000 | (objects_.front() + 1);
                *frame.id(x, y) = objects_.front();
            }
        return {};
    }
    std::string description() const override { return "a fake"; }

  private:
    std::vector<ObjectId> objects_;
    Rect rect_;
};

// A server in this process, and its peers: a client, a display and other servers, each as far as a test
// brings it up. The model is a cube of a few objects that the server gets from its client.
class ServerTest : public testing::Test {
  protected:
    ServerTest();

    ServerSetup setup(std::size_t server = 0) const;
    // The addresses of the display and the servers before this one, which listen at doors of their own.
    Connect connect_to(std::size_t before = 0);
    std::unique_ptr<Peer> come(const Hello& hello);
    std::unique_ptr<Peer> client() { return come(hello_of(Role::kClient)); }
    // A client that has sent its setup and, if asked, the model.
    std::unique_ptr<Peer> ready_client(const ServerSetup& setup);
    // A client whose server is connected to the display and the other servers, in display_ and others_.
    std::unique_ptr<Peer> connected_client(std::size_t server = 0, std::size_t count = 1);

    // A frame of 8 x 4 pixels, all of which this server draws and owns.
    RenderFrame task(FrameNumber frame) const;
    Buffer model_bytes() const;

    static constexpr std::uint64_t kSession = 42;
    TemporaryFolder cache_;
    Loop loop_;
    std::function<Status()> before_renderer_ = [] { return Status(); };  // called by the factory of renderers
    ServerOptions options_;
    RendererSetup asked_;  // by the newest call of the factory
    Buffer blob_;
    std::size_t objects_ = 0;
    std::unique_ptr<SessionHost> server_;
    Door display_door_{loop_};
    std::vector<std::unique_ptr<Door>> doors_;
    std::unique_ptr<Peer> display_;
    std::vector<std::unique_ptr<Peer>> others_;  // by ServerId, null for the server itself
};

}  // namespace swath::test
