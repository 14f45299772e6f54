#pragma once
#include <string_view>

namespace swath {

std::string_view version();  // "0.1.0"
// Of the git tree that was built, with a "+" where it had changes: "1a2b3c4d5e6f+". Empty without git.
std::string_view commit();

}  // namespace swath
