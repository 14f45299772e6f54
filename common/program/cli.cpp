#include "common/program/cli.h"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <charconv>
#include <filesystem>
#include <iostream>

#include "common/image/picture.h"
#include "common/program/version.h"

namespace swath {
namespace {

// Our texts are broken into lines already. CLI11 2.5 and later would break them again, at 65 and 80 columns, and
// indent long flags.
template <class Formatter>
void leave_lines_alone(Formatter& formatter) {
    if constexpr (requires { formatter.right_column_width(1); }) {
        formatter.right_column_width(1000);
        formatter.description_paragraph_width(1000);
        formatter.footer_paragraph_width(1000);
    }
    if constexpr (requires { formatter.long_option_alignment_ratio(0.2f); })
        formatter.long_option_alignment_ratio(0.2f);
}

// Takes a text that is a T within the limits, and nothing else.
template <class T>
CLI::Validator within(const char* what, T low, T high) {
    return CLI::Validator(
        [=](std::string& text) -> std::string {
            T value{};
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            if (error != std::errc{} || end != text.data() + text.size() || !(value >= low && value <= high))
                return fmt::format("'{}' is not a {} from {} to {}", text, what, low, high);
            // CLI11 would read a zero in front as octal.
            text = fmt::format("{}", value);
            return {};
        },
        fmt::format("[{} - {}]", low, high));
}

}  // namespace

std::optional<int> parse_options(CLI::App& app, int argc, char** argv,
                                 const std::function<std::string()>& about) {
    leave_lines_alone(*app.get_formatter());
    const std::string program = std::filesystem::path(argv[0]).filename();
    app.set_version_flag(
        "--version",
        [&] {
            const std::string from = commit().empty() ? "" : fmt::format(", commit {}", commit());
            return fmt::format("{} {}{}\n{}", program, version(), from, about ? about() : "");
        },
        "version, commit, and what the program speaks and draws with");
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help();
        return kExitDone;
    } catch (const CLI::CallForVersion& said) {
        std::cout << said.what();
        return kExitDone;
    } catch (const CLI::ParseError& error) {
        return usage_error({error.what()});
    }
    return std::nullopt;
}

int usage_error(const Error& error) {
    std::cerr << "error: " << error.message << " (see --help)\n";
    return kExitUsage;
}

int run_error(const Error& error) {
    std::cerr << "error: " << error.message << '\n';
    return kExitFailed;
}

Result<PictureSize> parse_size(const std::string& flag, const std::string& text) {
    int width = 0;
    int height = 0;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, width);
    if (first.ec == std::errc{} && first.ptr != end && *first.ptr == 'x') {
        const auto second = std::from_chars(first.ptr + 1, end, height);
        if (second.ec == std::errc{} && second.ptr == end && width >= 1 && height >= 1 &&
            width <= kMaxPictureSide && height <= kMaxPictureSide &&
            std::int64_t{width} * height <= kMaxPicturePixels)
            return PictureSize{width, height};
    }
    return fail("{}: '{}': expected WxH, each from 1 to {}, at most {} pixels", flag, text, kMaxPictureSide,
                kMaxPicturePixels);
}

CLI::Validator number_within(double low, double high) { return within("number", low, high); }

CLI::Validator whole_number(std::uint64_t low, std::uint64_t high) {
    auto validator = within("whole number", low, high);
    if (high == std::numeric_limits<std::uint64_t>::max()) validator.description("");
    return validator;
}

}  // namespace swath
