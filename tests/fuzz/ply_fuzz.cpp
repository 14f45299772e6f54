#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "common/scene/ply.h"

// Any bytes give one printable line of error, or a mesh that can be rendered.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const swath::Result<swath::Mesh> mesh = swath::read_ply({data, size});
    if (mesh && !swath::validate(*mesh)) std::abort();
    if (!mesh && (mesh.error().message.empty() || mesh.error().message.find('\n') != std::string::npos))
        std::abort();
    return 0;
}
