#include "sim/scenario/scenario.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "common/scene/model.h"
#include "common/scene/model_blob.h"
#include "sim/hardware/keys.h"

namespace swath::sim {
namespace {

std::string size_text(const PictureSize& size) { return fmt::format("{}x{}", size.width, size.height); }

std::string labelled(const std::string& model, const std::vector<std::string>& which) {
    return which.empty() ? model : fmt::format("{} ({})", model, fmt::join(which, ", "));
}

std::string digest_of(const Paths& paths) {
    static_assert(sizeof(Camera) == 12 * sizeof(float), "no padding");
    Buffer bytes;
    for (const std::vector<Camera>& cameras : paths)
        bytes.append(cameras.data(), cameras.size() * sizeof(Camera));
    return to_hex(digest(bytes.bytes()));
}

std::string exact_text(double value) { return fmt::format("{}", value); }
std::string exact_text(const std::optional<double>& value) { return value ? exact_text(*value) : "none"; }
std::string exact_text(bool value) { return value ? "true" : "false"; }
std::string exact_text(Compositing value) {
    return std::string(value == Compositing::kHost ? kHostWord : kGraphicsWord);
}
std::string exact_text(const std::string& value) { return value; }

// Writes all of a profile in SI units with every digit; explain() rounds.
std::string exact_text(const Hardware& hardware) {
    Hardware copy = hardware;
    std::string text = fmt::format("hardware {}\n", hardware.name);
    for (const Key& key : hardware_keys())
        text += fmt::format("{}: {}\n", key.name,
                            std::visit([&](auto place) { return exact_text(place(copy)); }, key.place));
    return text;
}

// Tables tell experiments apart by their labels only.
Status check_labels(const std::vector<Experiment>& experiments) {
    std::set<std::tuple<std::string, std::string, std::size_t>> labels;
    for (const Experiment& e : experiments)
        if (!labels.insert({e.algorithm_name, e.model_name, e.servers}).second)
            return fail("two models would be called '{}': give them other names", e.model_name);
    return {};
}

}  // namespace

Result<Scenario> Scenario::load(const ScenarioOptions& options) {
    Scenario scenario;
    const PathSpec& path = options.path;
    scenario.add_settings(fmt::format("path {}, {} frames, zoom {}, seeds {} to {}, {} in flight", path.path,
                                      path.frames, path.zoom, path.seed, path.seed + path.seeds - 1,
                                      options.frames_in_flight));
    for (const std::string& name : options.hardware) {
        auto hardware = find_hardware(name);
        if (!hardware) return fail_in("--hardware", hardware.error());
        if (std::ranges::find(scenario.hardware_, hardware->name, &Hardware::name) !=
            scenario.hardware_.end())
            return fail("--hardware: two profiles are called '{}'", hardware->name);
        scenario.add_settings(exact_text(*hardware));
        scenario.hardware_.push_back(std::move(*hardware));
    }
    for (const ModelName& name : options.models) SWATH_TRY_VOID(scenario.add_model(name, options));
    SWATH_TRY_VOID(check_labels(scenario.experiments_));
    for (const Experiment& e : scenario.experiments_)
        scenario.add_settings(fmt::format("{}, {}, {} servers, {}x{}, {}", e.model_name, e.algorithm_name,
                                          e.servers, e.width, e.height, e.hardware->name));
    return scenario;
}

void Scenario::add_settings(std::string_view lines) {
    while (!lines.empty()) {
        const std::size_t end = std::min(lines.find('\n'), lines.size());
        settings_.emplace_back(lines.substr(0, end));
        lines.remove_prefix(std::min(end + 1, lines.size()));
    }
}

Status Scenario::add_model(const ModelName& name, const ScenarioOptions& options) {
    SWATH_TRY(const auto mesh, load_model(name.file));
    const Buffer blob = write_blob(mesh);
    add_settings(fmt::format("model {}: {} polygons, SHA-256 {}", name.name, mesh.triangle_count(),
                             to_hex(digest(blob.bytes()))));
    std::vector<std::pair<const StudyModel*, std::string>> cuts;
    for (const Granularity& granularity : options.granularities) {
        const StudyModel& model =
            models_.emplace_back(StudyModel{name.name, build_objects(mesh, granularity)});
        const auto same_cut = [&](const auto& cut) { return cut.first->scene.cut == model.scene.cut; };
        // Two wished numbers of objects can come to the same depth.
        if (std::ranges::any_of(cuts, same_cut)) {
            models_.pop_back();
            continue;
        }
        const Cut& cut = model.scene.cut;
        const std::string which = cut.by == ObjectsBy::kSah ? fmt::format("SAH {}", cut.objects)
                                                            : fmt::format("depth {}", cut.depth);
        add_settings(fmt::format("{}: {} objects, {}", name.name, model.scene.objects.size(), which));
        cuts.emplace_back(&model, which);
    }
    for (const PictureSize& size : options.sizes) {
        SWATH_TRY(auto paths,
                  make_paths(options.path, models_.back().scene.swept_bounds(), size.width, size.height));
        const Paths& cameras = paths_.emplace_back(std::move(paths));
        add_settings(
            fmt::format("{}: cameras at {}, SHA-256 {}", name.name, size_text(size), digest_of(cameras)));
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
