#include <fmt/format.h>

#include "sim/studies/studies.h"

namespace swath::sim {
namespace {

constexpr std::array kAlgorithms{Algorithm::kMahd, Algorithm::kHybrid, Algorithm::kSortLast};

}  // namespace

Status resolution(StudyContext& context) {
    const StudySubject& subject = context.figures_subject();
    const std::string& name = subject.model.name;
    const Results& low = context.table1();
    const Results high = context.run(
        context.experiments(subject, subject.model, kAlgorithms, 2 * kPaperWidth, 2 * kPaperHeight),
        "resolution");
    if (auto status = context.write("resolution.csv", to_csv(high.rows())); !status) return status;

    Page& page = context.page();
    page.section("Screen resolution: figure 11");
    page.text(
        "What do four times as many pixels cost? Sort-first does not care as long as polygons, not pixels, "
        "take the time; sort-last moves areas and the hybrid borders. The paper concludes that the hybrid's "
        "exchange grows only with the root of the number of pixels.");
    if (auto status =
            context.figure(server_bars(high, name, fmt::format("Servers at 2560x1920, {}", name)),
                           "figure_11", fmt::format("Figure 11 for {}: figure 8 at 2560x1920.", name));
        !status)
        return status;

    PageTable table{{"servers", "hybrid (ms)", "grows by", "sort-last (ms)", "grows by", "sort-last / hybrid",
                     "speed-ups: hybrid", "sort-last", "sort-first"},
                    {}};
    for (const std::size_t servers : kPaperServers) {
        const auto moved = [&](const Results& results, Algorithm algorithm) {
            return results.value(algorithm, name, servers, "pixel_read") +
                   results.value(algorithm, name, servers, "pixel_write");
        };
        const auto speedups = [&](Algorithm algorithm) {
            return fmt::format("{:.1f} -> {:.1f}", low.value(algorithm, name, servers, "speedup"),
                               high.value(algorithm, name, servers, "speedup"));
        };
        const double hybrid = moved(high, Algorithm::kHybrid);
        const double last = moved(high, Algorithm::kSortLast);
        table.rows.push_back({std::to_string(servers), fmt::format("{:.1f}", hybrid),
                              fmt::format("{:.1f}x", hybrid / moved(low, Algorithm::kHybrid)),
                              fmt::format("{:.1f}", last),
                              fmt::format("{:.1f}x", last / moved(low, Algorithm::kSortLast)),
                              fmt::format("{:.1f}", last / hybrid), speedups(Algorithm::kHybrid),
                              speedups(Algorithm::kSortLast), speedups(Algorithm::kMahd)});
    }
    page.table(table, fmt::format("Pixel read and write at 2560x1920 and how often they are what they are at "
                                  "1280x960, {}.",
                                  name));
    page.note(
        "The root does not show: objects' boxes grow with the screen, and so does the width of the borders "
        "that the hybrid exchanges. It would hold if objects kept their size in pixels, that is, if a higher "
        "resolution came with a finer cut. The paper's other statement, around five times less exchange than "
        "sort-last, depends on the number of servers: see the table.");
    return {};
}

}  // namespace swath::sim
