#pragma once
#include <boost/asio/io_context.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "client/director/director.h"
#include "client/partition/object_costs.h"
#include "client/partition/partitioner.h"
#include "common/base/buffer.h"
#include "common/base/clock.h"
#include "common/base/result.h"
#include "common/scene/model_blob.h"
#include "common/scene/objects.h"
#include "common/timeline/timeline.h"
#include "common/wire/address.h"
#include "common/wire/connection.h"

namespace swath {

// What a run renders and where.
struct ClusterJob {
    std::vector<Address> servers;
    Address display;
    std::string model;  // as the user named it
    const ObjectSet* scene = nullptr;
    Buffer blob;  // the model for servers that lack it
    RendererKind renderer = RendererKind::kOsmesa;
    CullAlgorithm cull = CullAlgorithm::kWide;
    Algorithm algorithm = Algorithm::kHybrid;
    std::vector<Camera> cameras;  // a frame each
    int width = 1280;
    int height = 960;
    Rgb background{};
    PictureFormat format = PictureFormat::kNone;
    std::uint32_t frames_in_flight = 3;
    std::uint64_t session = 0;  // a random number
    Nanoseconds connect_patience = std::chrono::seconds(5);
    WireTiming timing;
};

// Drives servers and a display through a job: connects, sets up, partitions frame by frame, and gathers what
// every machine did. It does what the Director decides. Single-threaded, on the io_context.
class ClusterRun : public std::enable_shared_from_this<ClusterRun> {
  public:
    struct Handlers {
        std::function<void()> on_ready;                                        // every machine is set up
        std::function<Status(FrameNumber, const Buffer& picture)> on_picture;  // encoded; empty if no format
        std::function<void(Result<std::vector<FrameTimeline>>)> on_done;       // once, last
    };

    ClusterRun(boost::asio::io_context& io, ClusterJob job, const Clock& clock, Handlers handlers);
    void start();
    // Ends it without on_done.
    void stop();

  private:
    struct Peer {
        std::string who;  // "server 2 at 127.0.0.1:4002", for people
        Role role = Role::kServer;
        std::shared_ptr<Connection> connection;
        bool greeted = false;
        bool ready = false;
        bool connected = false;
    };
    struct OpenFrame {
        FrameTimeline timeline;
        std::size_t missing = 0;  // reports
    };

    void connect(std::size_t peer, const Address& address);
    void set_up();
    Status on_message(std::size_t peer, Message&& message, Buffer&& body);
    Status send_model_part(const Peer& peer, std::uint64_t offset);
    Status on_ready(Peer& peer, const Ready& ready);
    Status on_server_report(std::size_t peer, const ServerReport& report);
    Status on_report(std::size_t peer, const Report& report, const Buffer& body);
    Status run(const Director::Actions& actions);
    Status issue(FrameNumber frame);
    Status offer(const Peer& peer, const Message& message, Buffer body = {});
    void lost(std::size_t peer, const std::string& why);
    void finish(Result<std::vector<FrameTimeline>> result);

    boost::asio::io_context& io_;
    ClusterJob job_;
    const Clock& clock_;
    Handlers handlers_;
    std::vector<Peer> peers_;  // the servers, then the display
    std::unique_ptr<Partitioner> partitioner_;
    ObjectCosts costs_;
    std::size_t model_triangles_ = 0;
    Digest digest_;  // made before the network runs: a large model takes a while
    Director director_;
    std::map<FrameNumber, OpenFrame> frames_;
    std::vector<FrameTimeline> timelines_;
    bool started_ = false;
    bool over_ = false;
};

}  // namespace swath
