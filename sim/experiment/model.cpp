#include "sim/experiment/model.h"

#include "common/scene/model.h"

namespace swath::sim {

Result<StudyModel> load_study_model(const std::string& name, const std::string& file,
                                    const Granularity& granularity) {
    SWATH_TRY(auto mesh, load_model(file));
    return StudyModel{name, build_objects(std::move(mesh), granularity)};
}

Result<Paths> make_paths(const PathSpec& spec, const Box& bounds, int width, int height) {
    Paths paths;
    const std::size_t count = spec.path == "random" ? spec.seeds : 1;
    for (std::size_t k = 0; k < count; ++k) {
        PathOptions options;
        options.frames = spec.frames;
        options.seed = spec.seed + k;
        options.aspect = static_cast<float>(width) / static_cast<float>(height);
        options.zoom = static_cast<float>(spec.zoom);
        SWATH_TRY(auto cameras, make_path(spec.path, bounds, options));
        paths.push_back(std::move(cameras));
    }
    return paths;
}

}  // namespace swath::sim
