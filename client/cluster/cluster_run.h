#pragma once
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/director/director.h"
#include "client/live/broadcast.h"
#include "client/live/live_view.h"
#include "client/machines/machines.h"
#include "client/partition/object_costs.h"
#include "client/partition/partitioner.h"
#include "common/base/buffer.h"
#include "common/base/clock.h"
#include "common/base/result.h"
#include "common/base/worker_thread.h"
#include "common/scene/objects.h"
#include "common/timeline/timeline.h"

namespace swath {

// A run: what it renders and where.
struct ClusterJob {
    ServerSource servers;
    Address display;
    std::string model;  // as the user named it
    std::shared_ptr<const ObjectSet> scene;
    Buffer blob;  // the model, for servers that lack it
    DrawSettings draw;
    Algorithm algorithm = Algorithm::kHybrid;
    std::vector<Camera> cameras;        // one per frame; none in a live run
    std::optional<float> pose = 0;      // of all frames; none: path_pose() of each
    std::optional<glm::vec3> to_light;  // unit, model space; none: a head-light
    // Makes a live run: viewers say what is drawn, until somebody ends it. Renderers, cull, algorithm and
    // size are then those of its start.
    std::optional<LiveView::Settings> live;
    // Makes the command line that draws a view, for viewers.
    std::function<std::string(const LiveWish&, const std::vector<Address>& servers, const Cut&)> command =
        [](const auto&, const auto&, const auto&) { return std::string(); };
    int width = 1280;
    int height = 960;
    Rgb background{};
    PictureFormat format = PictureFormat::kNone;
    std::uint32_t frames_in_flight = 3;
    std::uint64_t session = 0;  // a random number
    Nanoseconds connect_patience = std::chrono::seconds(5);
    WireTiming timing;
};

// Drives a job's machines through it: partitions frame by frame, tells each machine its part, and gathers
// their reports. It does what the Director decides with the servers that Machines has brought up; in a live
// run it draws what LiveView says. On the io_context's thread; only a model is cut anew on another.
class ClusterRun : public std::enable_shared_from_this<ClusterRun> {
  public:
    struct Handlers {
        // So many servers and the display are set up. `page` is the address of the display's page, if it has
        // one.
        std::function<void(const std::string& page, std::size_t servers)> on_ready;
        std::function<Status(FrameNumber, const Buffer& picture)> on_picture;  // encoded; empty if no format
        std::function<void(Result<std::vector<FrameTimeline>>)> on_done;       // once, last
    };

    ClusterRun(boost::asio::io_context& io, ClusterJob job, const Clock& clock, Handlers handlers);
    void start();
    // Ends it without on_done.
    void stop();
    // Ends a live run well.
    void end();

  private:
    struct OpenFrame {
        FinishedFrame finished;         // as far as it is known
        std::vector<ServerId> servers;  // by rank
        std::size_t missing = 0;        // reports
    };

    Status on_started(const std::string& page);
    void on_members();
    void tell_session();
    Status on_server(ServerId server, Message&& message);
    Status on_display(Message&& message, const Buffer& body);
    Status on_audience(const Audience& audience);
    Status on_wish(const Wish& wish, const Buffer& body);
    Status on_report(std::size_t machine, const Report& report, Nanoseconds clock_offset, const Buffer& body);
    Status perform(const Director::Actions& actions);
    // Begins as much of the wish as is possible now.
    Status follow_wish();
    FrameOrder order_of(FrameNumber frame);
    Status issue(FrameNumber frame);
    Status change_setup();
    Status on_cut(std::shared_ptr<const ObjectSet> scene);
    Status end_change(const std::string& refused);
    Status go_on();
    void use(std::shared_ptr<const ObjectSet> scene);
    Partitioner& partitioner(Algorithm algorithm);
    void tell_state();
    void await_servers();
    void finish(Result<std::vector<FrameTimeline>> result);

    boost::asio::io_context& io_;
    ClusterJob job_;
    const Clock& clock_;
    Handlers handlers_;
    std::shared_ptr<Machines> machines_;                              // from start() on
    std::map<Algorithm, std::unique_ptr<Partitioner>> partitioners_;  // of job_.scene, made on demand
    std::optional<ObjectCosts> costs_;                                // for job_.scene
    Director director_;
    std::map<FrameNumber, OpenFrame> frames_;
    std::deque<FrameTimeline> timelines_;
    std::optional<LiveView> live_;
    Broadcast broadcast_;

    // A change of setup, from kReconfigure on.
    bool changing_ = false;
    LiveSetup next_setup_;
    std::shared_ptr<const ObjectSet> next_scene_;
    bool awaiting_servers_ = false;  // the run goes on when there is one
    boost::asio::steady_timer patience_;

    bool over_ = false;
    std::unique_ptr<WorkerThread> cutter_;  // null until a model is cut anew
};

}  // namespace swath
