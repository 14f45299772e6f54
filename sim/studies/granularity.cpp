#include <fmt/core.h>

#include "client/cost/client_time.h"
#include "sim/picture/figures.h"
#include "sim/studies/pictures.h"
#include "sim/studies/studies.h"

namespace swath::sim {
namespace {

constexpr std::array kDepths{3, 4, 5};

// Cuts the subject at kDepths. Models are named by their number of objects.
Result<std::list<StudyModel>> cuts(const StudySubject& subject) {
    std::list<StudyModel> models;
    for (const int depth : kDepths) {
        SWATH_TRY(auto model, load_study_model(subject.model.name, subject.file, {depth, 0}));
        model.name = fmt::format("{} ({} objects)", subject.model.name, model.scene.objects.size());
        models.push_back(std::move(model));
    }
    return models;
}

// Cuts the same numbers of objects with a SAH octree, or as close as it gets.
Result<std::list<StudyModel>> sah_cuts(const StudySubject& subject, const std::list<StudyModel>& uniform) {
    std::list<StudyModel> models;
    for (const StudyModel& other : uniform) {
        SWATH_TRY(auto model,
                  load_study_model(subject.model.name, subject.file,
                                   {.objects = other.scene.objects.size(), .by = ObjectsBy::kSah}));
        model.name = fmt::format("{} ({} asked for by SAH)", subject.model.name, model.scene.cut.objects);
        models.push_back(std::move(model));
    }
    return models;
}

Plot figure_12(const StudyContext& context, const std::string& name, const std::list<StudyModel>& models) {
    Plot plot{fmt::format("Client, {}", name), "Objects", "Time (ms a frame, 64 servers)", false, {}};
    for (const Algorithm algorithm : kPaperAlgorithms) {
        Series series{table_name(algorithm), {}, Style::kLine, {}};
        for (const StudyModel& model : models) {
            const std::size_t objects = model.scene.objects.size();
            series.points.emplace_back(objects, 1e3 * client_s(objects, 64, algorithm, context.hardware()));
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

double overhead(const Results& results, Algorithm algorithm, const StudyModel& model, std::size_t servers) {
    return (results.value(algorithm, model.name, servers, "server_total") /
                results.value(algorithm, model.name, servers, "ideal_render") -
            1) *
           100;
}

Plot figure_13(const Results& results, const std::string& name, const std::list<StudyModel>& models) {
    Plot plot{
        fmt::format("Overhead of servers, {}", name), "Objects", "Overhead (% of ideal rendering)", true, {}};
    std::size_t colour = 0;
    for (const Algorithm algorithm : kPaperAlgorithms) {
        for (const auto& [servers, style] : {std::pair{64u, Style::kLine}, std::pair{16u, Style::kDashed}}) {
            Series series{fmt::format("{}, {} servers", table_name(algorithm), servers), {}, style, colour};
            for (const StudyModel& model : models)
                series.points.emplace_back(model.scene.objects.size(),
                                           overhead(results, algorithm, model, servers));
            plot.series.push_back(std::move(series));
        }
        ++colour;
    }
    return plot;
}

// The hybrid's overhead with the SAH octree's objects beside the uniform ones.
Plot figure_sah(const Results& results, const std::string& name, const std::list<StudyModel>& uniform,
                const std::list<StudyModel>& sah) {
    Plot plot{fmt::format("Overhead of servers by cut, {}", name),
              "Objects",
              "Overhead of the hybrid (% of ideal rendering)",
              true,
              {}};
    std::size_t colour = 0;
    for (const auto& [cut, models] : {std::pair{"uniform", &uniform}, std::pair{"SAH", &sah}}) {
        for (const auto& [servers, style] : {std::pair{64u, Style::kLine}, std::pair{16u, Style::kDashed}}) {
            Series series{fmt::format("{}, {} servers", cut, servers), {}, style, colour};
            for (const StudyModel& model : *models)
                series.points.emplace_back(model.scene.objects.size(),
                                           overhead(results, Algorithm::kHybrid, model, servers));
            plot.series.push_back(std::move(series));
        }
        ++colour;
    }
    return plot;
}

Status figure_14(StudyContext& context, const StudySubject& subject, const std::list<StudyModel>& models) {
    std::vector<Page::Picture> top;
    std::vector<Page::Picture> bottom;
    SWATH_TRY(const auto frame, first_frame(subject));
    for (const StudyModel& model : models) {
        const std::size_t objects = model.scene.objects.size();
        const FramePlan plan = first_plan(subject, model, Algorithm::kHybrid, kPictureServers);
        const std::string boxes = fmt::format("figure_14_boxes_{}.png", objects);
        const std::string tiles = fmt::format("figure_14_tiles_{}.png", objects);
        SWATH_TRY_VOID(write_picture(context, boxes_figure(frame, plan.view, model.scene.objects), boxes));
        SWATH_TRY_VOID(write_picture(context, overlap_figure(frame, plan), tiles));
        top.push_back({boxes, fmt::format("{} objects", objects)});
        bottom.push_back({tiles, fmt::format("{} objects", objects)});
    }
    context.page().figure(top, "Figure 14, top: the objects' boxes.");
    context.page().figure(bottom,
                          fmt::format("Figure 14, bottom: the hybrid's tiles for {} servers, overlaps "
                                      "in white. Finer objects give thinner swaths.",
                                      kPictureServers));
    return {};
}

}  // namespace

Status granularity(StudyContext& context) {
    const StudySubject& subject = context.figures_subject();
    const std::string& name = subject.model.name;
    SWATH_TRY(const auto models, cuts(subject));
    SWATH_TRY(const auto sah_models, sah_cuts(subject, models));
    std::vector<Experiment> experiments;
    for (const auto* cut : {&models, &sah_models})
        for (const StudyModel& model : *cut)
            std::ranges::move(
                context.experiments(subject, model, kPaperAlgorithms, kPaperWidth, kPaperHeight),
                std::back_inserter(experiments));
    const Results results = context.run(std::move(experiments), "granularity");
    SWATH_TRY_VOID(context.write("granularity.csv", to_csv(results.rows())));

    Page& page = context.page();
    page.section("Object granularity: figures 12, 13 and 14");
    page.text(
        "Finer objects make overlaps smaller and the client's work larger. The paper cuts the Buddha into "
        "293, 1,476 and 6,521 objects: octrees of depth 3, 4 and 5.");
    SWATH_TRY_VOID(context.figure(
        figure_12(context, name, models), "figure_12",
        fmt::format("Figure 12 for {}: the client's time grows linearly with the objects.", name)));
    SWATH_TRY_VOID(context.figure(
        figure_13(results, name, models), "figure_13",
        fmt::format("Figure 13 for {}: what servers do beyond their share of ideal rendering.", name)));
    SWATH_TRY_VOID(context.figure(
        figure_sah(results, name, models, sah_models), "granularity_sah",
        fmt::format("Not in the paper: the hybrid with objects that are leaves of a SAH octree, beside "
                    "cells of the uniform one, {}.",
                    name)));
    PageTable table{{"objects", "cut", "servers", "hybrid", "sort-first", "sort-last"}, {}};
    for (const auto* cut : {&models, &sah_models}) {
        for (const StudyModel& model : *cut) {
            for (const std::size_t servers : kPaperServers) {
                const auto cell = [&](Algorithm algorithm) {
                    return fmt::format("{:.0f} %", overhead(results, algorithm, model, servers));
                };
                table.rows.push_back({std::to_string(model.scene.objects.size()),
                                      std::string(name_of(model.scene.cut.by)), std::to_string(servers),
                                      cell(Algorithm::kHybrid), cell(Algorithm::kMahd),
                                      cell(Algorithm::kSortLast)});
            }
        }
    }
    page.table(table, fmt::format("Overhead over ideal rendering, {}.", name));
    const auto of_64 = [&](Algorithm algorithm, const StudyModel& model) {
        return overhead(results, algorithm, model, 64);
    };
    page.link("granularity.csv", "all columns of both modes");
    page.note(fmt::format(
        "The paper says that sort-last is unaffected by granularity. Here its groups are cut by the hybrid's "
        "sweep and depend on the objects too: with 64 servers its overhead is {:.0f} per cent with the "
        "coarsest cut and {:.0f} with the finest, the hybrid's {:.0f} and {:.0f}.",
        of_64(Algorithm::kSortLast, models.front()), of_64(Algorithm::kSortLast, models.back()),
        of_64(Algorithm::kHybrid, models.front()), of_64(Algorithm::kHybrid, models.back())));
    return figure_14(context, subject, models);
}

}  // namespace swath::sim
