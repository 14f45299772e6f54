#include <fmt/core.h>

#include "sim/picture/figures.h"
#include "sim/studies/pictures.h"
#include "sim/studies/studies.h"

namespace swath::sim {
namespace {

PageTable sort_last_comparison(const Results& results, const std::string& model) {
    PageTable table{{"servers", "hybrid", "sort-last", "hybrid / sort-last", "hybrid read + write (ms)",
                     "sort-last read + write (ms)", "ratio"},
                    {}};
    for (const std::size_t servers : kPaperServers) {
        const auto value = [&](Algorithm algorithm, const char* column) {
            return results.value(algorithm, model, servers, column);
        };
        const auto moved = [&](Algorithm algorithm) {
            return value(algorithm, "pixel_read") + value(algorithm, "pixel_write");
        };
        const double hybrid = value(Algorithm::kHybrid, "speedup");
        const double last = value(Algorithm::kSortLast, "speedup");
        table.rows.push_back({std::to_string(servers), fmt::format("{:.2f}", hybrid),
                              fmt::format("{:.2f}", last), quotient(hybrid, last, 2),
                              fmt::format("{:.1f}", moved(Algorithm::kHybrid)),
                              fmt::format("{:.1f}", moved(Algorithm::kSortLast)),
                              quotient(moved(Algorithm::kSortLast), moved(Algorithm::kHybrid), 1)});
    }
    return table;
}

std::int64_t transferred(const FramePlan& plan) {
    std::int64_t pixels = 0;
    for (const Transfer& transfer : transfers(plan)) pixels += area(transfer.region);
    return pixels;
}

}  // namespace

Status sort_last(StudyContext& context) {
    const Results& results = context.table1();
    Page& page = context.page();
    page.section("Comparison with sort-last");
    page.text(
        "Sort-last draws everything once and divides nothing anew in a frame, but where the hybrid's servers "
        "exchange borders, its exchange whole areas.");
    for (const StudySubject& subject : context.subjects())
        page.table(
            sort_last_comparison(results, subject.model.name),
            fmt::format("Speed-ups (paper mode) and the time for moving pixels, {}. By the paper's table "
                        "the hybrid is 19 to 27 per cent faster than sort-last with 8 servers and 33 to "
                        "63 with 64.",
                        subject.model.name));

    const StudySubject& subject = context.figures_subject();
    SWATH_TRY(const auto frame, first_frame(subject));
    std::vector<Page::Picture> pictures;
    for (const auto& [algorithm, file] : {std::pair{Algorithm::kSortLast, "figure_10b.png"},
                                          std::pair{Algorithm::kHybrid, "figure_10c.png"}}) {
        const FramePlan plan = first_plan(subject, subject.model, algorithm, kPictureServers);
        SWATH_TRY_VOID(write_picture(context, transfer_figure(frame, plan), file));
        pictures.push_back({file, fmt::format("{}: {} pixels are sent from server to server",
                                              name_of(algorithm), transferred(plan))});
    }
    page.figure(pictures, fmt::format("Figures 10b and 10c for {}, {} servers: the pixels that servers "
                                      "exchange, the more often the whiter.",
                                      subject.model.name, kPictureServers));
    return {};
}

}  // namespace swath::sim
