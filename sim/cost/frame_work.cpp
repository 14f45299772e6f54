#include "sim/cost/frame_work.h"

#include <algorithm>

namespace swath::sim {
namespace {

// About what a task takes on the wire (docs/wire.md): view, rectangles and framing, and an id an object.
constexpr double kTaskBytes = 300;
constexpr double kTaskBytesPerObject = 4;

double pixels(const Rect& rect) { return static_cast<double>(rect.area()); }

class Pricer {
  public:
    explicit Pricer(const Hardware& hardware) : hardware_(hardware), server_(hardware.server) {}

    SwathWork swath(ServerId peer, const Region& region) const {
        const double sent = static_cast<double>(area(region)) * hardware_.network.active_share;
        SwathWork work{peer, 0, 0, sent * hardware_.network.swath_bytes_per_pixel};
        if (server_.compositing == Compositing::kHost) {
            work.send_s = sent / server_.pack_pixels_per_s;
            work.merge_s = sent / server_.merge_pixels_per_s;
        } else {
            for (const Rect& rect : region) {
                work.send_s += server_.colour.read_s(pixels(rect)) + server_.depth.read_s(pixels(rect));
                work.merge_s += server_.colour.write_s(pixels(rect)) + server_.depth.write_s(pixels(rect));
            }
        }
        return work;
    }

    void add_drawing(double polygons, const Rect& content, ServerWork& work) const {
        work.render_s = std::max(polygons * server_.polygon_s, pixels(content) / server_.fill_pixels_per_s);
        if (server_.compositing == Compositing::kHost && !content.empty())
            work.read_s = server_.colour.read_s(pixels(content)) + server_.depth.read_s(pixels(content));
    }

    void add_tile(const Region& region, ServerWork& work) const {
        const double share = hardware_.network.tile_active_share;
        const double sent = static_cast<double>(area(region)) * share;
        work.has_tile = !region.empty();
        work.tile_bytes = sent * hardware_.network.tile_bytes_per_pixel;
        if (server_.compositing == Compositing::kHost) work.final_s = sent / server_.pack_pixels_per_s;
        for (const Rect& rect : region) {
            if (server_.compositing == Compositing::kGraphics)
                work.final_s += server_.colour.read_s(pixels(rect));
            work.display_s += hardware_.display.colour.write_s(pixels(rect) * share);
        }
    }

  private:
    const Hardware& hardware_;
    const Hardware::Server& server_;
};

}  // namespace

std::vector<ServerWork> frame_work(const FramePlan& plan, std::span<const ProjectedObject> objects,
                                   const Hardware& hardware) {
    const Pricer price(hardware);
    std::vector<ServerWork> work(plan.servers.size());
    for (std::size_t s = 0; s < work.size(); ++s) {
        const ServerShare& share = plan.servers[s];
        double polygons = 0;
        for (const ObjectId id : share.group) polygons += static_cast<double>(objects[id].work);
        price.add_drawing(polygons, share.content, work[s]);
        price.add_tile(final_region(plan, server_id(s)), work[s]);
        work[s].task_bytes = kTaskBytes + kTaskBytesPerObject * static_cast<double>(share.group.size());
        // As in the cluster, but a server that does not cull also draws what nobody sees.
        work[s].takes_part = !share.content.empty() || work[s].has_tile || work[s].render_s > 0;
    }
    for (const Transfer& transfer : transfers(plan)) {
        work[index(transfer.from)].outgoing.push_back(price.swath(transfer.to, transfer.region));
        work[index(transfer.to)].incoming.push_back(transfer.from);
    }
    return work;
}

}  // namespace swath::sim
