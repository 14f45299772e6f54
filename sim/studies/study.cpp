#include "sim/studies/study.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <iostream>

#include "sim/studies/published.h"
#include "sim/studies/studies.h"

namespace swath::sim {
namespace {

struct Study {
    const char* name;
    Status (*run)(StudyContext&);
};
constexpr std::array kStudies{Study{"feasibility", feasibility}, Study{"scalability", scalability},
                              Study{"sort-first", sort_first},   Study{"sort-last", sort_last},
                              Study{"resolution", resolution},   Study{"granularity", granularity}};

void introduce(StudyContext& context) {
    const StudyOptions& options = context.options();
    Page& page = context.page();
    page.text(
        "Samanta, Funkhouser, Li and Singh (Graphics Hardware 2000) studied their hybrid of sort-first and "
        "sort-last rendering in simulations. This page repeats the studies with our partitioners, the same "
        "that the real cluster runs.");
    page.text(fmt::format(
        "Paper mode counts as the paper does: a server's phases follow one another, the network takes no "
        "time, and a frame takes as long as its slowest server. Full mode simulates everything at once: "
        "client, network, {} frames in flight, and the display, which the paper's speed-ups leave out. "
        "Hardware: {} ({}). {} camera paths of {} frames, seeds {} to {}.",
        Experiment{}.frames_in_flight, context.hardware().name, context.hardware().about, options.seeds,
        options.frames, options.seed, options.seed + options.seeds - 1));
    PageTable table{{"model", "file", "polygons", "objects", "paper's polygons", "paper's objects", "zoom"},
                    {}};
    for (const StudySubject& subject : context.subjects()) {
        const auto paper = [&](const char* column) {
            const auto value = published("model", subject.paper_name, 0, column);
            return value ? fmt::format("{:.0f}", *value) : "";
        };
        table.rows.push_back({subject.model.name, std::filesystem::path(subject.file).filename().string(),
                              std::to_string(subject.model.scene.mesh.triangle_count()),
                              std::to_string(subject.model.scene.objects.size()), paper("polygons"),
                              paper("objects"), fmt::format("{}", subject.zoom)});
    }
    page.table(table, "Objects are the triangles whose centres fall into one cell of an octree of depth 4.");
    for (const std::string& absence : context.absences()) page.note(absence);
    if (options.hardware != StudyOptions{}.hardware)
        page.note(
            fmt::format("The paper's numbers are of its own hardware, ours of {}: beside each other they "
                        "compare two clusters, and do not say how well the paper is reproduced.",
                        context.hardware().name));
}

}  // namespace

std::vector<std::string> study_names() {
    std::vector<std::string> names;
    for (const Study& study : kStudies) names.emplace_back(study.name);
    return names;
}

Status run_studies(const StudyOptions& options) {
    SWATH_TRY(auto context, StudyContext::open(options));
    introduce(context);
    for (const Study& study : kStudies) {
        if (std::ranges::find(options.names, study.name) == options.names.end()) continue;
        if (auto status = study.run(context); !status) return fail_in(study.name, status.error());
    }
    SWATH_TRY_VOID(context.write("index.html", context.page().html()));
    std::cout << "page: " << (options.out / "index.html").string() << '\n';
    return {};
}

}  // namespace swath::sim
