#include "client/cost/client_time.h"

#include <cmath>

namespace swath {

double client_s(std::size_t objects, std::size_t servers, Algorithm algorithm, const Hardware& hardware) {
    const Hardware::Client& client = hardware.client;
    const auto n = static_cast<double>(servers);
    double each_s = client.transform_s;
    if (algorithm != Algorithm::kSortLast)
        each_s += client.partition_server_s * n + client.partition_level_s * std::log2(n);
    return each_s * static_cast<double>(objects);
}

}  // namespace swath
