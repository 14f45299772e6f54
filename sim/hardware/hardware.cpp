#include "sim/hardware/hardware.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "common/base/file.h"
#include "sim/hardware/keys.h"
#include "sim/hardware/profile.h"

namespace swath::sim {
namespace {

constexpr std::uint64_t kMaxFileBytes = 64 << 10;
constexpr std::string_view kSuffix = ".toml";

// The value as a profile writes it; "none" for an optional one that is not there.
struct Shown {
    Hardware& hardware;
    Unit unit;
    Need need;

    std::string operator()(double& (*place)(Hardware&)) const {
        const double value = place(hardware);
        return value == 0 && (need == Need::kForHost || need == Need::kForGraphics) ? "none"
                                                                                    : to_text(value, unit);
    }
    std::string operator()(std::optional<double>& (*place)(Hardware&)) const {
        const std::optional<double> value = place(hardware);
        return value ? to_text(*value, unit) : "none";
    }
    std::string operator()(bool& (*place)(Hardware&)) const { return place(hardware) ? "true" : "false"; }
    std::string operator()(Compositing& (*place)(Hardware&)) const {
        return std::string(place(hardware) == Compositing::kHost ? kHostWord : kGraphicsWord);
    }
    std::string operator()(std::string& (*place)(Hardware&)) const { return place(hardware); }
};

}  // namespace

const Builtin* find_builtin(std::string_view name) {
    const auto found = std::ranges::find(builtins(), name, &Builtin::name);
    return found == builtins().end() ? nullptr : &*found;
}

std::vector<std::string> builtin_hardware() {
    std::vector<std::string> names;
    for (const Builtin& builtin : builtins()) names.emplace_back(builtin.name);
    return names;
}

Result<Hardware> parse_hardware(std::string_view toml, std::string name) {
    return parse_profile(toml, name, name);
}

Result<Hardware> find_hardware(const std::string& name_or_file) {
    if (const Builtin* builtin = find_builtin(name_or_file))
        return parse_hardware(builtin->toml, name_or_file);
    if (!name_or_file.ends_with(kSuffix))
        return fail("unknown hardware '{}': the built-in profiles are {}; a file's name ends in {}",
                    name_or_file, fmt::join(builtin_hardware(), ", "), kSuffix);
    SWATH_TRY(const Buffer file, read_file(name_or_file, kMaxFileBytes));
    return parse_profile({reinterpret_cast<const char*>(file.data()), file.size()},
                         std::filesystem::path(name_or_file).stem().string(), name_or_file);
}

std::string explain(const Hardware& hardware) {
    Hardware copy = hardware;
    std::vector<std::string> values;
    std::size_t name_width = 0;
    std::size_t value_width = 0;
    for (const Key& key : hardware_keys().subspan(1)) {
        values.push_back(std::visit(Shown{copy, key.unit, key.need}, key.place));
        name_width = std::max(name_width, key.name.size());
        value_width = std::max(value_width, values.back().size());
    }
    std::string text = fmt::format("{}: {}\n", hardware.name, hardware.about);
    std::string_view section;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Key& key = hardware_keys()[i + 1];
        if (const std::string_view of = key.name.substr(0, key.name.find('.')); of != section) {
            text += '\n';
            section = of;
        }
        text +=
            fmt::format("{:<{}}  {:<{}}  {}\n", key.name, name_width, values[i], value_width, key.meaning);
    }
    return text;
}

}  // namespace swath::sim
