#include "common/base/check.h"

namespace swath::check_detail {

void failed(const char* expression, const char* file, int line, const std::string& values) {
    std::ostringstream out;
    out << file << ':' << line << ": CHECK(" << expression << ") failed: " << values;
    throw CheckFailed(out.str());
}

}  // namespace swath::check_detail
