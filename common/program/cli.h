#pragma once
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "common/base/result.h"

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace swath {

// How every program of ours reads its command line and says what is wrong with it.

enum ExitCode { kExitDone = 0, kExitFailed = 1, kExitUsage = 2 };

// Parses; the exit code if the program is to end now (help, --version, or a wrong flag: one line on stderr
// and kExitUsage). `about` gives further lines for --version.
std::optional<int> parse_options(CLI::App& app, int argc, char** argv,
                                 const std::function<std::string()>& about = {});
int usage_error(const Error& error);  // prints the line, gives kExitUsage
int run_error(const Error& error);    // prints the line, gives kExitFailed

// "1280x960", within the limits of pictures. Errors name the flag.
struct PictureSize {
    int width = 0;
    int height = 0;
    bool operator==(const PictureSize&) const = default;
};
Result<PictureSize> parse_size(const std::string& flag, const std::string& text);

// Stricter than CLI11's own, which let "nan" through, take "-1" for the largest whole number and "010" for 8; and
// their words are the same with all its versions. For CLI::Option::transform: CLI11 gets the number as it writes it.
CLI::Validator number_within(double low, double high);
CLI::Validator whole_number(std::uint64_t low = 0,
                            std::uint64_t high = std::numeric_limits<std::uint64_t>::max());

}  // namespace swath
