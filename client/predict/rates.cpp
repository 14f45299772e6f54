#include "client/predict/rates.h"

#include <limits>

#include "client/cost/client_time.h"

namespace swath {
namespace {

// Time to partition, per object and log2(servers), over the time to project an object; as in gbe-2026.
constexpr double kLevelOverTransform = 11.0 / 45.0;

// These stand in until swaths have been seen. Times are relative to gathering a pixel of a tile, as measured
// with four servers; sizes and the share as in gbe-2026.
constexpr double kCodeOverGather = 10;
constexpr double kMergeOverGather = 5;
constexpr double kSwathBytes = 7.46;
constexpr double kTileBytes = 3.02;
constexpr double kSwathShare = 0.3;

Hardware::Client client_of(double transform_s) { return {transform_s, 0, transform_s * kLevelOverTransform}; }

// Adds up the spans and counters of all machines of one kind.
struct Sum {
    std::array<double, kPhaseCount> s{};
    std::array<double, kCounterCount> counted{};
    double operator[](Phase phase) const { return s[static_cast<std::size_t>(phase)]; }
    double operator[](Counter counter) const { return counted[static_cast<std::size_t>(counter)]; }

    void add(const MachineTimeline& machine) {
        for (const Span& span : machine.spans)
            s[static_cast<std::size_t>(span.phase)] +=
                std::chrono::duration<double>(span.end - span.begin).count();
        for (std::size_t i = 0; i < kCounterCount; ++i)
            counted[i] += static_cast<double>(machine.counters[i]);
    }
};

void add_ratio(RecentMedian& to, double sum, double amount) {
    if (sum > 0 && amount > 0) to.add(sum / amount);
}

double pixels_per_s(double pixel_s) {
    return pixel_s > 0 ? 1 / pixel_s : std::numeric_limits<double>::infinity();
}

}  // namespace

void Rates::add(const FramePlan& plan, const FrameTimeline& timeline, Algorithm algorithm,
                std::size_t objects) {
    Sum client;
    Sum servers;
    Sum display;
    for (const MachineTimeline& machine : timeline.machines)
        (is_server(machine.machine) ? servers : machine.machine == "display" ? display : client).add(machine);

    double drawing = 0;
    double content = 0;
    double tiles = 0;
    double swaths = 0;
    for (std::size_t s = 0; s < plan.servers.size(); ++s) {
        const Rect& drawn = plan.servers[s].content;
        content += static_cast<double>(drawn.area());
        drawing += drawn.empty() ? 0 : 1;
        tiles += static_cast<double>(area(final_region(plan, server_id(s))));
    }
    for (const Transfer& transfer : transfers(plan)) swaths += static_cast<double>(area(transfer.region));
    if (drawing == 0) return;  // the picture is empty

    if (servers[Counter::kTriangles] > 0)
        render_.add(servers[Counter::kTriangles] / drawing,
                    (servers[Phase::kCull] + servers[Phase::kRender]) / drawing);
    readback_.add(content / drawing, servers[Phase::kPixelRead] / drawing);
    add_ratio(code_s_, servers[Phase::kSwap], servers[Counter::kSwapPixels]);
    add_ratio(merge_s_, servers[Phase::kPixelWrite], servers[Counter::kReceivedPixels]);
    add_ratio(gather_s_, servers[Phase::kFinalRead] + servers[Phase::kSend], servers[Counter::kTilePixels]);
    add_ratio(assemble_s_, display[Phase::kAssemble], servers[Counter::kTilePixels]);
    add_ratio(swath_bytes_, servers[Counter::kSwapBytes], servers[Counter::kSwapPixels]);
    add_ratio(tile_bytes_, servers[Counter::kTileBytes], servers[Counter::kTilePixels]);
    Shares& shares = shares_[algorithm];
    add_ratio(shares.swath, servers[Counter::kSwapPixels], swaths);
    add_ratio(shares.tile, servers[Counter::kTilePixels], tiles);

    Hardware unit;
    unit.client = client_of(1);
    add_ratio(client_, client[Phase::kPartition], client_s(objects, plan.servers.size(), algorithm, unit));
}

std::optional<Hardware> Rates::hardware(Algorithm algorithm) const {
    const auto render = render_.line();
    const auto readback = readback_.line();
    const auto gather_s = gather_s_.median();
    if (render_.samples() < kEnoughFrames || gather_s_.samples() < kEnoughFrames || !readback) return {};

    const auto share = [&](RecentMedian Shares::*of) {
        const auto own = shares_.find(algorithm);
        std::optional<double> found = own == shares_.end() ? std::nullopt : (own->second.*of).median();
        for (const auto& [other, shares] : shares_)
            if (!found) found = (shares.*of).median();
        return found;
    };
    Hardware hardware;
    hardware.name = "measured";
    hardware.about = "this cluster, as its last frames show it";
    hardware.network.swath_bytes_per_pixel = swath_bytes_.median().value_or(kSwathBytes);
    hardware.network.tile_bytes_per_pixel = tile_bytes_.median().value_or(kTileBytes);
    hardware.network.active_share = share(&Shares::swath).value_or(kSwathShare);
    hardware.network.tile_active_share = share(&Shares::tile).value_or(1);
    hardware.client = client_of(client_.median().value_or(0));

    constexpr double kFree = std::numeric_limits<double>::infinity();
    Hardware::Server& server = hardware.server;
    server.compositing = Compositing::kHost;
    server.culls = true;
    server.frame_s = render->fixed_s;
    server.polygon_s = render->each_s;
    server.fill_pixels_per_s = kFree;
    server.colour = {readback->fixed_s, pixels_per_s(readback->each_s), 0};
    server.depth = {0, kFree, 0};
    server.pack_pixels_per_s = pixels_per_s(code_s_.median().value_or(kCodeOverGather * *gather_s));
    server.merge_pixels_per_s = pixels_per_s(merge_s_.median().value_or(kMergeOverGather * *gather_s));
    server.gather_pixels_per_s = pixels_per_s(*gather_s);
    hardware.display.colour = {0, 0, pixels_per_s(assemble_s_.median().value_or(0))};
    return hardware;
}

}  // namespace swath
