#include "client/cluster/run_cluster.h"

#include <boost/asio/post.hpp>

namespace swath {

Result<std::vector<FrameTimeline>> run_cluster(
    ClusterJob job, const Clock& clock, StopSignals& signals,
    std::function<void(const std::string& page, std::size_t servers)> on_ready,
    std::function<Status(FrameNumber, const Buffer&)> on_picture) {
    boost::asio::io_context io(1);
    Result<std::vector<FrameTimeline>> result = fail("the run did not end");
    bool over = false;
    const bool live = job.live.has_value();
    const auto run =
        std::make_shared<ClusterRun>(io, std::move(job), clock,
                                     ClusterRun::Handlers{std::move(on_ready), std::move(on_picture),
                                                          [&](Result<std::vector<FrameTimeline>> done) {
                                                              result = std::move(done);
                                                              over = true;
                                                          }});
    run->start();
    signals.on_stop([&] {
        boost::asio::post(io, [&] {
            if (over) return;
            if (live) return run->end();
            run->stop();
            result = fail("interrupted");
            over = true;
        });
    });
    while (!over && io.run_one() > 0) {
    }
    // Sends the last words to peers. Attempts to connect may also be pending, but no longer matter.
    io.run_for(std::chrono::milliseconds(200));
    // The run has ended: a signal must not reach it any more.
    signals.on_stop([] {});
    return result;
}

}  // namespace swath
