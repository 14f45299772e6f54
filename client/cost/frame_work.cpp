#include "client/cost/frame_work.h"

#include "client/cost/pricer.h"

namespace swath {
namespace {

// The approximate size of a task on the wire (docs/wire.md): view, rectangles and framing, and an id an
// object.
constexpr double kTaskBytes = 300;
constexpr double kTaskBytesPerObject = 4;

}  // namespace

std::vector<ServerWork> frame_work(const FramePlan& plan, std::span<const ProjectedObject> objects,
                                   const Hardware& hardware) {
    const Pricer price(hardware);
    std::vector<ServerWork> all(plan.servers.size());
    for (std::size_t s = 0; s < all.size(); ++s) {
        const ServerShare& share = plan.servers[s];
        double polygons = 0;
        for (const ObjectId id : share.group) polygons += static_cast<double>(objects[id].work);
        const Region tile = final_region(plan, server_id(s));
        ServerWork& work = all[s];
        work.render_s = price.render_s(polygons, share.content);
        work.read_s = price.readback_s(share.content);
        work.has_tile = !tile.empty();
        work.final_s = price.read_tile_s(tile);
        work.display_s = price.display_tile_s(tile);
        work.tile_bytes = price.tile_bytes(tile);
        work.task_bytes = kTaskBytes + kTaskBytesPerObject * static_cast<double>(share.group.size());
        // As in the cluster. But a server that does not cull also draws what nobody sees.
        work.takes_part = !share.content.empty() || work.has_tile || work.render_s > 0;
    }
    for (const Transfer& transfer : transfers(plan)) {
        all[index(transfer.from)].outgoing.push_back(
            {transfer.to, price.send_swath_s(transfer.region), price.merge_swath_s(transfer.region),
             price.swath_pixels(transfer.region), price.swath_bytes(transfer.region)});
        all[index(transfer.to)].incoming.push_back(transfer.from);
    }
    return all;
}

double overlap_factor(const FramePlan& plan, std::span<const Object> model) {
    double triangles = 0;
    double assigned = 0;
    for (const Object& object : model) triangles += object.triangle_count;
    for (const ServerShare& share : plan.servers)
        for (const ObjectId id : share.group) assigned += model[id].triangle_count;
    return triangles > 0 ? assigned / triangles : 1;
}

}  // namespace swath
