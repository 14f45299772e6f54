#include "sim/scenario/scenario.h"

#include <fmt/format.h>

#include "common/scene/model.h"
#include "common/scene/model_blob.h"

namespace swath::sim {
namespace {

std::string size_text(const PictureSize& size) { return fmt::format("{}x{}", size.width, size.height); }

std::string labelled(const std::string& model, const std::vector<std::string>& which) {
    return which.empty() ? model : fmt::format("{} ({})", model, fmt::join(which, ", "));
}

}  // namespace

Result<Scenario> Scenario::load(const ScenarioOptions& options) {
    Scenario scenario;
    const PathSpec& path = options.path;
    scenario.settings_.push_back(fmt::format("path {}, {} frames, zoom {}, seeds {} to {}, {} in flight",
                                             path.path, path.frames, path.zoom, path.seed,
                                             path.seed + path.seeds - 1, options.frames_in_flight));
    for (const std::string& name : options.hardware) {
        auto hardware = find_hardware(name);
        if (!hardware) return fail_in("--hardware", hardware.error());
        scenario.settings_.push_back(fmt::format("hardware {}", hardware->name));
        scenario.settings_.push_back(explain(*hardware));
        scenario.hardware_.push_back(std::move(*hardware));
    }
    for (const ModelName& name : options.models)
        if (const auto status = scenario.add_model(name, options); !status)
            return tl::unexpected(status.error());
    for (const Experiment& e : scenario.experiments_)
        scenario.settings_.push_back(fmt::format("{}, {}, {} servers, {}x{}, {}", e.model_name,
                                                 e.algorithm_name, e.servers, e.width, e.height,
                                                 e.hardware->name));
    return scenario;
}

Status Scenario::add_model(const ModelName& name, const ScenarioOptions& options) {
    const auto mesh = load_model(name.file);
    if (!mesh) return tl::unexpected(mesh.error());
    const Buffer blob = write_blob(*mesh);
    settings_.push_back(fmt::format("model {}: {} polygons, SHA-256 {}", name.name, mesh->triangle_count(),
                                    to_hex(digest(blob.bytes()))));
    std::vector<std::pair<const StudyModel*, std::string>> cuts;
    for (const Granularity& granularity : options.granularities) {
        const StudyModel& model =
            models_.emplace_back(StudyModel{name.name, build_objects(*mesh, granularity)});
        settings_.push_back(fmt::format("{}: {} objects at depth {}", name.name, model.scene.objects.size(),
                                        model.scene.depth));
        cuts.emplace_back(&model, fmt::format("depth {}", model.scene.depth));
    }
    for (const PictureSize& size : options.sizes) {
        auto paths = make_paths(options.path, models_.back().scene.bounds, size.width, size.height);
        if (!paths) return tl::unexpected(paths.error());
        const Paths& cameras = paths_.emplace_back(std::move(*paths));
        for (const Hardware& hardware : hardware_) {
            for (const auto& [model, cut] : cuts) {
                std::vector<std::string> which;
                if (cuts.size() > 1) which.push_back(cut);
                if (options.sizes.size() > 1) which.push_back(size_text(size));
                if (hardware_.size() > 1) which.push_back(hardware.name);
                Experiment experiment;
                experiment.model = model;
                experiment.paths = &cameras;
                experiment.hardware = &hardware;
                experiment.width = size.width;
                experiment.height = size.height;
                experiment.frames_in_flight = options.frames_in_flight;
                experiment.model_name = labelled(name.name, which);
                for (const Algorithm algorithm : options.algorithms) {
                    experiment.algorithm = algorithm;
                    experiment.algorithm_name = std::string(name_of(algorithm));
                    for (const std::size_t servers : options.servers) {
                        experiment.servers = servers;
                        experiments_.push_back(experiment);
                    }
                }
            }
        }
    }
    return {};
}

}  // namespace swath::sim
