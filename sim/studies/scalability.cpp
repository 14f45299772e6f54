#include <fmt/core.h>

#include "client/cost/client_time.h"
#include "sim/studies/published.h"
#include "sim/studies/studies.h"

namespace swath::sim {
namespace {

Plot figure_7(const StudyContext& context, const StudySubject& subject) {
    Plot plot{fmt::format("Client, {}", subject.model.name), "Servers", "Time (ms a frame)", false, {}};
    for (const Algorithm algorithm : kPaperAlgorithms) {
        Series series{table_name(algorithm), {}, Style::kLine, {}};
        for (std::size_t servers = 8; servers <= 64; servers += 8)
            series.points.emplace_back(servers, 1e3 * client_s(subject.model.scene.objects.size(), servers,
                                                               algorithm, context.hardware()));
        plot.series.push_back(std::move(series));
    }
    return plot;
}

Plot figure_9(const Results& results, const StudySubject& subject) {
    Plot plot{fmt::format("Speed-up, {}", subject.model.name), "Servers", "Speed-up", false, {}};
    std::size_t colour = 0;
    for (const Algorithm algorithm : kPaperAlgorithms) {
        Series ours{table_name(algorithm), {}, Style::kLine, colour};
        Series paper{table_name(algorithm) + ", paper", {}, Style::kPoints, colour};
        Series full{table_name(algorithm) + ", full mode", {}, Style::kDashed, colour};
        for (const std::size_t servers : kPaperServers) {
            const auto x = static_cast<double>(servers);
            ours.points.emplace_back(x, results.value(algorithm, subject.model.name, servers, "speedup"));
            full.points.emplace_back(x,
                                     results.value(algorithm, subject.model.name, servers, "full_speedup"));
            if (const auto value = published(table_name(algorithm), subject.paper_name, servers, "speedup"))
                paper.points.emplace_back(x, *value);
        }
        plot.series.push_back(std::move(ours));
        plot.series.push_back(std::move(full));
        if (!paper.points.empty()) plot.series.push_back(std::move(paper));
        ++colour;
    }
    plot.series.push_back({"ideal", {{8, 8}, {64, 64}}, Style::kReference, {}});
    return plot;
}

}  // namespace

Bars server_bars(const Results& results, const std::string& model, const std::string& title) {
    Bars bars;
    bars.title = title;
    bars.y_label = "Time (ms a frame)";
    bars.segments = {"ideal render", "overlap render", "pixel read",
                     "pixel write",  "final read",     "imbalance"};
    for (const Algorithm algorithm : kPaperAlgorithms) {
        const bool replicates = grouping_of(algorithm) == Grouping::kAtLeastOnce;
        Bars::Group group{table_name(algorithm), {}};
        for (const std::size_t servers : kPaperServers) {
            const auto value = [&](const char* column) {
                return results.value(algorithm, model, servers, column);
            };
            group.bars.push_back(
                {std::to_string(servers),
                 {value("ideal_render"), replicates ? value("overlap_render") : 0,
                  replicates ? 0 : value("pixel_read"), replicates ? 0 : value("pixel_write"),
                  value("final_read"), value("imbalance")}});
        }
        bars.groups.push_back(std::move(group));
    }
    return bars;
}

Status scalability(StudyContext& context) {
    const Results& results = context.table1();
    const StudySubject& subject = context.figures_subject();
    const std::string& name = subject.model.name;
    Page& page = context.page();
    page.section("Scalability: figures 7, 8 and 9");
    page.text(
        "Does it scale with the number of servers? The pipeline goes at the pace of its slowest stage, so "
        "client, servers and display have to.");
    SWATH_TRY_VOID(context.figure(
        figure_7(context, subject), "figure_7",
        fmt::format("Figure 7 for {}, from the hardware profile's client times. The paper's numbers are "
                    "not printed: its text says that the hybrid grows linearly with the servers, and "
                    "that a Buddha of 1,476 objects would reach 33 ms at about 150 of them. Sort-first "
                    "is taken to cost the same.",
                    name)));
    SWATH_TRY_VOID(context.figure(
        server_bars(results, name, fmt::format("Servers at 1280x960, {}", name)), "figure_8",
        fmt::format("Figure 8 for {}: where a server's time goes, for 8 to 64 servers.", name)));
    for (const StudySubject& each : context.subjects()) {
        std::string caption = fmt::format(
            "Figure 9 for {}. Lines are paper mode, dashes full mode, which includes client, network and "
            "display.",
            each.model.name);
        if (!each.paper_name.empty())
            caption += each.stand_in ? " Points are the paper's, of a mesh that this one stands in for."
                                     : " Points are the paper's.";
        SWATH_TRY_VOID(
            context.figure(figure_9(results, each), "figure_9_" + file_name_of(each.model.name), caption));
    }
    return {};
}

}  // namespace swath::sim
