#include <fmt/core.h>

#include "sim/picture/figures.h"
#include "sim/studies/pictures.h"
#include "sim/studies/studies.h"

namespace swath::sim {
namespace {

PageTable sort_first_comparison(const Results& results, const std::string& model) {
    PageTable table{{"servers", "hybrid", "MAHD", "KD-split", "hybrid / MAHD", "MAHD overlap (ms)",
                     "KD-split overlap (ms)", "MAHD imbalance (ms)", "KD-split imbalance (ms)"},
                    {}};
    for (const std::size_t servers : kPaperServers) {
        const auto value = [&](Algorithm algorithm, const char* column) {
            return results.value(algorithm, model, servers, column);
        };
        const double hybrid = value(Algorithm::kHybrid, "speedup");
        const double mahd = value(Algorithm::kMahd, "speedup");
        table.rows.push_back(
            {std::to_string(servers), fmt::format("{:.2f}", hybrid), fmt::format("{:.2f}", mahd),
             fmt::format("{:.2f}", value(Algorithm::kKdSplit, "speedup")), quotient(hybrid, mahd, 2),
             fmt::format("{:.1f}", value(Algorithm::kMahd, "overlap_render")),
             fmt::format("{:.1f}", value(Algorithm::kKdSplit, "overlap_render")),
             fmt::format("{:.1f}", value(Algorithm::kMahd, "imbalance")),
             fmt::format("{:.1f}", value(Algorithm::kKdSplit, "imbalance"))});
    }
    return table;
}

}  // namespace

Status sort_first(StudyContext& context) {
    const Results& results = context.table1();
    Page& page = context.page();
    page.section("Comparison with sort-first: MAHD and KD-split");
    page.text(
        "Sort-first needs no compositing, but objects on the border of tiles are drawn several times, and "
        "the smaller the tiles the more of them there are. The paper prints MAHD and says that KD-split is "
        "similar; both are here.");
    for (const StudySubject& subject : context.subjects())
        page.table(
            sort_first_comparison(results, subject.model.name),
            fmt::format("Speed-ups (paper mode) and what costs them, {}. By the paper's table the hybrid "
                        "is 1.4 to 1.8 times as fast as MAHD with 8 servers and 2.9 to 4.5 times with 64.",
                        subject.model.name));

    const StudySubject& subject = context.figures_subject();
    SWATH_TRY(auto frame, first_frame(subject));
    const FramePlan plan = first_plan(subject, subject.model, Algorithm::kMahd, kPictureServers);
    const std::vector<Object>& objects = subject.model.scene.objects;
    const std::size_t several = replicated_objects(plan, objects.size()).size();
    SWATH_TRY_VOID(
        write_picture(context, replication_figure(std::move(frame), plan, objects), "figure_10a.png"));
    page.figure(
        {{"figure_10a.png", "objects that span tiles"}},
        fmt::format("Figure 10a for {}, MAHD, {} servers: the boxes of the {} of {} objects that span "
                    "tiles and are drawn several times.",
                    subject.model.name, kPictureServers, several, objects.size()));
    return {};
}

}  // namespace swath::sim
