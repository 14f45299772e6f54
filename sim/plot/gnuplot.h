#pragma once
#include <string>
#include <string_view>

#include "common/base/buffer.h"
#include "common/base/result.h"

namespace swath::sim {

// The text as one line that can stand in a picture or an error: control characters become spaces, bytes that
// are not UTF-8 question marks, and what is long is cut.
std::string printable(std::string_view text);

// The text as a string of gnuplot's language, whatever it contains.
std::string literal(std::string_view text);

// What gnuplot writes to its output when it runs the script, without reading anybody's settings. Errors are
// one line.
Result<Buffer> run_gnuplot(std::string_view script);

}  // namespace swath::sim
