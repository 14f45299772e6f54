#include "sim/cost/paper_frame.h"

#include <algorithm>

#include "client/cost/client_time.h"
#include "client/cost/pricer.h"
#include "client/partition/mahd.h"
#include "common/base/check.h"

namespace swath::sim {
namespace {

// The plan with the paper's contents, which unseen objects belong to.
FramePlan with_whole_contents(const FramePlan& plan, std::span<const ProjectedObject> objects,
                              Algorithm algorithm) {
    const bool clipped = grouping_of(algorithm) == Grouping::kAtLeastOnce;
    FramePlan whole = plan;
    for (ServerShare& share : whole.servers) {
        const Rect tile = share.tile.empty() ? Rect{} : share.tile.front();
        share.content = {};
        for (const ObjectId id : share.group)
            share.content =
                bounding(share.content, clipped ? intersect(objects[id].box, tile) : objects[id].box);
    }
    return whole;
}

// The region that tiles are cut from: the bounds of all boxes, or, for MAHD, of the cells that they touch.
Rect region_of(const FramePlan& plan, std::span<const ProjectedObject> objects, Algorithm algorithm) {
    Rect region;
    for (const ProjectedObject& object : objects) region = bounding(region, object.box);
    if (algorithm != Algorithm::kMahd || region.empty()) return region;
    constexpr int kCell = Mahd::kCellPixels;
    return intersect({region.x0 / kCell * kCell, region.y0 / kCell * kCell,
                      ((region.x1 - 1) / kCell + 1) * kCell, ((region.y1 - 1) / kCell + 1) * kCell},
                     plan.view.viewport());
}

}  // namespace

PaperFrame paper_frame(const FramePlan& plan, std::span<const ProjectedObject> objects, Algorithm algorithm,
                       const Hardware& hardware) {
    const FramePlan whole = with_whole_contents(plan, objects, algorithm);
    const Rect region = region_of(plan, objects, algorithm);

    const Pricer price(hardware);
    PaperFrame frame;
    frame.client_s = client_s(objects.size(), plan.servers.size(), algorithm, hardware);
    frame.servers.resize(plan.servers.size());
    for (std::size_t s = 0; s < plan.servers.size(); ++s) {
        ServerTimes& server = frame.servers[s];
        const ServerShare& share = whole.servers[s];
        double polygons = 0;
        for (const ObjectId id : share.group) polygons += static_cast<double>(objects[id].work);
        server.render_s = price.render_s(polygons, share.content);
        server.read_s = price.readback_s(share.content);
        Region read;
        Region sent;
        if (algorithm == Algorithm::kSortLast) {
            read = sent = final_region(whole, server_id(s));
        } else if (!share.tile.empty()) {
            const Rect tile = intersect(share.tile.front(), region);
            if (!tile.empty()) sent = {tile};
            read = sent;
            if (algorithm != Algorithm::kHybrid)
                read = share.content.empty() ? Region{} : Region{share.content};
        }
        server.final_s = price.read_tile_s(read);
        frame.display_s += price.display_tile_s(sent);
    }
    for (const Transfer& transfer : transfers(whole)) {
        frame.servers[index(transfer.from)].read_s += price.send_swath_s(transfer.region);
        frame.servers[index(transfer.to)].write_s += price.merge_swath_s(transfer.region);
    }
    return frame;
}

void PaperMeans::add(const PaperFrame& frame) {
    const auto servers = static_cast<double>(frame.servers.size());
    double longest_s = 0;
    for (const ServerTimes& server : frame.servers) {
        mean_.render_s += server.render_s / servers;
        mean_.read_s += server.read_s / servers;
        mean_.write_s += server.write_s / servers;
        mean_.final_s += server.final_s / servers;
        longest_s = std::max(longest_s, server.total_s());
    }
    longest_s_ += longest_s;
    client_s_ += frame.client_s;
    display_s_ += frame.display_s;
    ++frames_;
}

void PaperMeans::add(const PaperMeans& other) {
    frames_ += other.frames_;
    mean_.render_s += other.mean_.render_s;
    mean_.read_s += other.mean_.read_s;
    mean_.write_s += other.mean_.write_s;
    mean_.final_s += other.mean_.final_s;
    longest_s_ += other.longest_s_;
    client_s_ += other.client_s_;
    display_s_ += other.display_s_;
}

std::vector<Row> PaperMeans::table1(const Row& of, Grouping grouping, double ideal_s) const {
    CHECK(frames_ > 0);
    const double to_ms = 1e3 / frames_;
    const double total_ms = longest_s_ * to_ms;
    const double ideal_ms = ideal_s * 1e3;
    std::vector<Row> rows;
    const auto add = [&](const char* column, double value) {
        rows.push_back({of.algorithm, of.model, of.servers, column, value});
    };
    // Neither can be negative, but rounding may make it so.
    const double overlap_ms = std::max(0.0, mean_.render_s * to_ms - ideal_ms);
    const double imbalance_ms = std::max(0.0, total_ms - mean_.total_s() * to_ms);
    add("ideal_render", ideal_ms);
    if (grouping == Grouping::kAtLeastOnce) {
        add("overlap_render", overlap_ms);
    } else {
        add("pixel_read", mean_.read_s * to_ms);
        add("pixel_write", mean_.write_s * to_ms);
    }
    add("final_read", mean_.final_s * to_ms);
    add("imbalance", imbalance_ms);
    add("server_total", total_ms);
    add("display_write", display_s_ * to_ms);
    add("speedup", total_ms > 0 ? ideal_ms * static_cast<double>(of.servers) / total_ms : 0);
    return rows;
}

std::vector<Row> PaperMeans::stages(const Row& of) const {
    CHECK(frames_ > 0);
    const double to_ms = 1e3 / frames_;
    return {{of.algorithm, of.model, of.servers, "client", client_s_ * to_ms},
            {of.algorithm, of.model, of.servers, "effective_frame",
             std::max({client_s_, longest_s_, display_s_}) * to_ms}};
}

}  // namespace swath::sim
