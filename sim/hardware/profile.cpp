#include "sim/hardware/profile.h"

#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "sim/hardware/keys.h"

namespace swath::sim {
namespace {

constexpr std::size_t kMaxAbout = 200;
constexpr std::string_view kBase = "base";

std::string known_profiles() { return fmt::format("{}", fmt::join(builtin_hardware(), ", ")); }

// The number of insertions, deletions and replacements from one word to the other.
std::size_t edits(std::string_view from, std::string_view to) {
    std::vector<std::size_t> row(to.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < from.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < to.size(); ++j) {
            const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
        }
    }
    return row.back();
}

// "did you mean 'network.latency'?"; or a list of all keys if none is near.
std::string suggestion(std::string_view unknown) {
    constexpr std::size_t kNear = 3;
    unknown = unknown.substr(0, 100);
    const auto nearest = std::ranges::min_element(hardware_keys(), {},
                                                  [&](const Key& key) { return edits(unknown, key.name); });
    if (edits(unknown, nearest->name) <= kNear) return fmt::format("did you mean '{}'?", nearest->name);
    std::vector<std::string_view> known{kBase};
    for (const Key& key : hardware_keys()) known.push_back(key.name);
    return fmt::format("there are {}", fmt::join(known, ", "));
}

std::string_view kind_of(const toml::node& node) {
    if (node.is_table()) return "a table";
    if (node.is_array()) return "an array";
    if (node.is_boolean()) return "true or false";
    if (node.is_string()) return "a text";
    return node.is_number() ? "a number" : "a date or time";
}

// The digits of a number, about as the profile has them.
std::string digits_of(const toml::node& node) {
    if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
    return fmt::format("{}", node.as_floating_point()->get());
}

// Sets one key's value from a node of the profile.
class Setter {
  public:
    Setter(Hardware& hardware, const Key& key, const toml::node& node)
        : hardware_(hardware), key_(key), node_(node) {}

    Status operator()(double& (*place)(Hardware&)) const {
        SWATH_TRY(place(hardware_), quantity());
        return {};
    }
    Status operator()(std::optional<double>& (*place)(Hardware&)) const {
        SWATH_TRY(place(hardware_), quantity());
        return {};
    }
    Status operator()(bool& (*place)(Hardware&)) const {
        if (!node_.is_boolean()) return fail("{}, expected true or false", kind_of(node_));
        place(hardware_) = node_.as_boolean()->get();
        return {};
    }
    Status operator()(Compositing& (*place)(Hardware&)) const {
        const std::string word = node_.value_or(std::string());
        if (!node_.is_string() || (word != kGraphicsWord && word != kHostWord))
            return fail("{}, expected {}",
                        node_.is_string() ? fmt::format("\"{}\"", word) : std::string(kind_of(node_)),
                        example(key_));
        place(hardware_) = word == kHostWord ? Compositing::kHost : Compositing::kGraphics;
        return {};
    }
    Status operator()(std::string& (*place)(Hardware&)) const {
        const std::string text = node_.value_or(std::string());
        if (!node_.is_string()) return fail("{}, expected a text", kind_of(node_));
        const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
        if (text.empty() || text.size() > kMaxAbout || std::ranges::any_of(text, is_control))
            return fail("expected one line of 1 to {} bytes", kMaxAbout);
        place(hardware_) = text;
        return {};
    }

  private:
    Result<double> quantity() const {
        if (const auto* text = node_.as_string()) return parse_quantity(text->get(), key_.unit);
        if (!node_.is_number()) return fail("{}, expected e.g. {}", kind_of(node_), example(key_));
        return parse_quantity(digits_of(node_), key_.unit);
    }

    Hardware& hardware_;
    const Key& key_;
    const toml::node& node_;
};

// Reads one profile.
class Reader {
  public:
    Reader(std::string name, std::string source) : source_(std::move(source)) {
        hardware_.name = std::move(name);
    }

    Result<Hardware> read(std::string_view text) {
        toml::table table;
        try {
            table = toml::parse(text);
        } catch (const toml::parse_error& error) {
            return fail("{}: {}", at(error.source()), error.description());
        }
        if (const toml::node* node = table.get(kBase)) {
            SWATH_TRY_VOID(take_base(*node));
            table.erase(kBase);
        }
        SWATH_TRY_VOID(take(table, ""));
        SWATH_TRY_VOID(complete());
        if (!base_.empty() && !set_.contains("about"))
            hardware_.about = fmt::format("{} with {} changed", base_,
                                          set_.empty() ? "nothing" : fmt::to_string(fmt::join(set_, ", ")));
        return std::move(hardware_);
    }

  private:
    std::string at(const toml::source_region& region) const {
        return fmt::format("{}:{}", source_, region.begin.line);
    }

    Status take_base(const toml::node& node) {
        const std::string base = node.value_or(std::string());
        const Builtin* builtin = find_builtin(base);
        if (builtin == nullptr)
            return fail("{}: base: {}, expected one of {}", at(node.source()),
                        node.is_string() ? fmt::format("\"{}\"", base) : std::string(kind_of(node)),
                        known_profiles());
        SWATH_TRY(auto parsed, parse_hardware(builtin->toml, base));
        base_ = base;
        parsed.name = hardware_.name;
        hardware_ = std::move(parsed);
        return {};
    }

    Status take(const toml::table& table, const std::string& prefix) {
        for (const auto& [last, node] : table) {
            const std::string key = prefix + std::string(last.str());
            const auto known = std::ranges::find(hardware_keys(), key, &Key::name);
            if (known != hardware_keys().end()) {
                const Status taken = std::visit(Setter(hardware_, *known, node), known->place);
                if (!taken) return fail("{}: {}: {}", at(node.source()), key, taken.error().message);
                set_.insert(known->name);
                continue;
            }
            const std::string section = key + ".";
            const bool is_section = std::ranges::any_of(
                hardware_keys(), [&](const Key& of) { return of.name.starts_with(section); });
            if (!is_section)
                return fail("{}: unknown key '{}': {}", at(last.source()), key.substr(0, 100),
                            suggestion(key));
            if (!node.is_table())
                return fail("{}: {}: {}, expected the table [{}]", at(node.source()), key, kind_of(node),
                            key);
            SWATH_TRY_VOID(take(*node.as_table(), section));
        }
        return {};
    }

    // True if the profile or its base sets the key.
    bool has(const Key& key) {
        if (set_.contains(key.name)) return true;
        if (base_.empty()) return false;
        return key.need == Need::kAlways || std::get<double& (*)(Hardware&)>(key.place)(hardware_) > 0;
    }

    Status complete() {
        const bool on_host = hardware_.server.compositing == Compositing::kHost;
        for (const Key& key : hardware_keys()) {
            if (key.need == Need::kOptional || key.need == (on_host ? Need::kForGraphics : Need::kForHost))
                continue;
            if (!has(key))
                return fail("{}: {} is missing, expected e.g. {}", source_, key.name, example(key));
        }
        return {};
    }

    std::string source_;
    std::string base_;
    Hardware hardware_;
    std::set<std::string_view> set_;  // the keys that this profile sets
};

}  // namespace

Result<Hardware> parse_profile(std::string_view toml, std::string name, std::string source) {
    return Reader(std::move(name), std::move(source)).read(toml);
}

}  // namespace swath::sim
