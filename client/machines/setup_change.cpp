#include "client/machines/setup_change.h"

#include "common/base/check.h"

namespace swath {

void SetupChange::begin(std::size_t servers) {
    CHECK(servers > 0u);
    *this = {};
    servers_ = missing_ = servers;
}

SetupChange::Next SetupChange::on_answer(const std::string& refused) {
    CHECK(missing_ > 0u);
    if (!refused.empty() && going_back_) return Next::kStuck;
    if (!refused.empty() && why_.empty()) why_ = refused;
    if (--missing_ > 0) return Next::kWait;
    if (going_back_) return Next::kUndone;
    if (why_.empty()) return Next::kDone;
    going_back_ = true;
    missing_ = servers_;
    return Next::kGoBack;
}

}  // namespace swath
