#include "common/base/names.h"

#include "common/base/check.h"

namespace swath::names_detail {

void fail_unnamed(std::string_view what) { throw CheckFailed(std::string(what) + " without a name"); }

Error not_known(std::string_view what, std::string_view name, std::string_view known) {
    return {fmt::format("{}{}'{}' is not known; there are: {}", what, what.empty() ? "" : " ", name, known)};
}

}  // namespace swath::names_detail
