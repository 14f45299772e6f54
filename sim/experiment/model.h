#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "client/path/path.h"
#include "common/base/result.h"
#include "common/scene/objects.h"

namespace swath::sim {

// A model, cut into objects, under the name that tables give it.
struct StudyModel {
    std::string name;
    ObjectSet scene;
};

// `file` as in load_model().
Result<StudyModel> load_study_model(const std::string& name, const std::string& file,
                                    const Granularity& granularity);

// The cameras of an experiment: a path a seed, `seed` and those after it. A path that does not depend on the
// seed comes once.
using Paths = std::vector<std::vector<Camera>>;
struct PathSpec {
    std::string path = "random";  // as make_path() knows it
    std::size_t frames = 50;
    double zoom = 1;
    std::uint64_t seed = 1;
    std::size_t seeds = 1;
};
Result<Paths> make_paths(const PathSpec& spec, const Box& bounds, int width, int height);

}  // namespace swath::sim
