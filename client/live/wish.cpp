#include "client/live/wish.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/scene/objects.h"

namespace swath {
namespace {

using Json = nlohmann::json;

// Each takes one field's value, or says what it expects.

Status take(const Json& value, bool& to) {
    if (!value.is_boolean()) return fail("true or false is expected");
    to = value.get<bool>();
    return {};
}

// A whole number within [low, high]; JavaScript writes them without a point.
template <class Number>
Status take(const Json& value, std::uint64_t low, std::uint64_t high, Number& to) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() < low || value.get<std::uint64_t>() > high)
        return fail("a whole number from {} to {} is expected", low, high);
    to = static_cast<Number>(value.get<std::uint64_t>());
    return {};
}

template <class Parse, class To>
Status take_name(const Json& value, const Parse& parse, To& to) {
    if (!value.is_string()) return fail("a name is expected");
    SWATH_TRY(to, parse(value.get_ref<const std::string&>()));
    return {};
}

Status take_against(const Json& value, std::optional<Algorithm>& to) {
    if (!value.is_null()) return take_name(value, parse<Algorithm>, to);
    to.reset();
    return {};
}

Status take_servers(const Json& value, std::size_t most, std::optional<std::size_t>& to) {
    std::size_t servers = 0;
    if (!value.is_null()) SWATH_TRY_VOID(take(value, 1, most, servers));
    to = value.is_null() ? std::nullopt : std::optional(servers);
    return {};
}

Status take_path(const Json& value, std::string& to) {
    const auto parse = [](const std::string& name) -> Result<std::string> {
        if (name == "orbit" || name == "random") return name;
        return fail("path '{}' is not known; there are: orbit, random", name);
    };
    if (!value.is_null()) return take_name(value, parse, to);
    to.clear();
    return {};
}

Status take_camera(const Json& value, CameraNumbers& to) {
    CameraNumbers numbers{};
    if (!value.is_array() || value.size() != numbers.size())
        return fail("{} numbers are expected", numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (!value[i].is_number()) return fail("{} numbers are expected", numbers.size());
        numbers[i] = static_cast<float>(value[i].get<double>());
    }
    SWATH_TRY_VOID(camera_of(numbers));
    to = numbers;
    return {};
}

// Takes both or none: a picture's size is one thing.
Status take_size(const Json& wide, const Json& high, const WishLimits& limits, LiveWish& wish) {
    constexpr std::uint64_t kMost = 100'000;  // more than any window has
    int width = 0;
    int height = 0;
    for (const auto& status : {take(wide, 1, kMost, width), take(high, 1, kMost, height)})
        if (!status) return status;
    const double scale = std::min({1.0, static_cast<double>(limits.max_width) / width,
                                   static_cast<double>(limits.max_height) / height});
    const auto scaled = [&](int side, int most) {
        return std::clamp(static_cast<int>(std::floor(scale * side)), 1, most);
    };
    wish.width = scaled(width, limits.max_width);
    wish.height = scaled(height, limits.max_height);
    return {};
}

}  // namespace

Result<Refusals> apply_wish(std::string_view text, std::uint32_t by, const WishLimits& limits,
                            LiveWish& wish) {
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) return fail("a wish that is no JSON object");
    Refusals refused;
    const auto field = [&](const char* name, const auto& take_it) {
        const auto found = json.find(name);
        if (found == json.end()) return;
        if (const Status status = take_it(*found); !status) refused[name] = status.error().message;
    };
    constexpr std::uint64_t kAny = std::uint64_t{1} << 53;  // the largest count of JavaScript
    field("id", [&](const Json& value) { return take(value, 0, kAny, wish.id); });
    field("camera", [&](const Json& value) { return take_camera(value, wish.camera); });
    if (json.contains("width") && json.contains("height"))
        field("width", [&](const Json& value) { return take_size(value, json["height"], limits, wish); });
    field("algorithm", [&](const Json& value) { return take_name(value, parse<Algorithm>, wish.algorithm); });
    field("against", [&](const Json& value) { return take_against(value, wish.against); });
    field("servers", [&](const Json& value) { return take_servers(value, limits.servers, wish.servers); });
    field("objects", [&](const Json& value) { return take(value, 1, kMaxObjectsAsked, wish.setup.objects); });
    field("renderer",
          [&](const Json& value) { return take_name(value, parse_renderers, wish.setup.draw.renderers); });
    field("cull",
          [&](const Json& value) { return take_name(value, parse<CullAlgorithm>, wish.setup.draw.cull); });
    field("path", [&](const Json& value) { return take_path(value, wish.path); });
    field("paused", [&](const Json& value) { return take(value, wish.paused); });
    field("step", [&](const Json& value) { return take(value, 0, kAny, wish.step); });
    field("measure", [&](const Json& value) { return take(value, 0, kAny, wish.measure); });
    field("trace", [&](const Json& value) { return take(value, 0, kAny, wish.trace); });
    wish.by = by;
    return refused;
}

}  // namespace swath
