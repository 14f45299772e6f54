#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "client/path/path.h"
#include "common/base/result.h"
#include "common/scene/objects.h"

namespace swath::sim {

// A model, cut into objects, with its name in tables.
struct StudyModel {
    std::string name;
    ObjectSet scene;
};

// `file` is as for load_model().
Result<StudyModel> load_study_model(const std::string& name, const std::string& file,
                                    const Granularity& granularity);

// The cameras of an experiment: one path for each of the seeds from `seed` on, or a single path if it does
// not depend on the seed.
using Paths = std::vector<std::vector<Camera>>;
struct PathSpec {
    std::string path = "random";  // see make_path()
    std::size_t frames = 50;
    double zoom = 1;
    std::uint64_t seed = 1;
    std::size_t seeds = 1;
};
Result<Paths> make_paths(const PathSpec& spec, const Box& bounds, int width, int height);

}  // namespace swath::sim
