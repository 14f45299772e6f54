#include "common/octree/sah/sah_build.h"

namespace swath {

std::unique_ptr<SahBuild> make_cuda_build(std::string& why) {
    why = "built without CUDA";
    return nullptr;
}

}  // namespace swath
