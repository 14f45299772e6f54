#pragma once
#include <string>
#include <string_view>

#include "common/base/buffer.h"
#include "common/base/result.h"

namespace swath::sim {

// Makes one line of the text that can stand in a picture or an error. Control characters become spaces, bytes
// that are not UTF-8 become question marks, and long text is cut.
std::string printable(std::string_view text);

// Makes a string of gnuplot's language of any text.
std::string literal(std::string_view text);

// Runs the script, without anybody's settings, and returns gnuplot's output. Errors are one line.
Result<Buffer> run_gnuplot(std::string_view script);

}  // namespace swath::sim
