#include "common/scene/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>

namespace swath {
namespace {

// Real headers have some hundred bytes. The limit keeps us from searching a whole body for an end_header.
constexpr std::size_t kMaxHeaderBytes = 1 << 20;
constexpr std::size_t kMaxElements = 1000;
constexpr std::size_t kMaxProperties = 1000;  // of one element

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypeNames = {{
    {"char", PlyType::Int8},
    {"int8", PlyType::Int8},
    {"uchar", PlyType::Uint8},
    {"uint8", PlyType::Uint8},
    {"short", PlyType::Int16},
    {"int16", PlyType::Int16},
    {"ushort", PlyType::Uint16},
    {"uint16", PlyType::Uint16},
    {"int", PlyType::Int32},
    {"int32", PlyType::Int32},
    {"uint", PlyType::Uint32},
    {"uint32", PlyType::Uint32},
    {"float", PlyType::Float32},
    {"float32", PlyType::Float32},
    {"double", PlyType::Float64},
    {"float64", PlyType::Float64},
}};

std::optional<PlyType> type_named(std::string_view name) {
    for (const auto& [text, type] : kTypeNames)
        if (text == name) return type;
    return std::nullopt;
}

std::vector<std::string_view> words_of(std::string_view line) {
    constexpr std::string_view kBlank = " \t\r";
    std::vector<std::string_view> words;
    std::size_t at = line.find_first_not_of(kBlank);
    while (at != std::string_view::npos) {
        const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(kBlank, end);
    }
    return words;
}

// A line as an error shows it: short, and printable whatever the file holds.
std::string quoted(std::string_view line) {
    constexpr std::size_t kMost = 60;
    std::string text(line.substr(0, kMost));
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return line.size() > kMost ? text + "..." : text;
}

Status add_element(PlyHeader& header, const std::vector<std::string_view>& words) {
    if (words.size() != 3) return fail("an element needs a name and a count");
    PlyElement element;
    element.name = std::string(words[1]);
    const char* end = words[2].data() + words[2].size();
    const auto [stop, error] = std::from_chars(words[2].data(), end, element.count);
    if (error != std::errc{} || stop != end) return fail("the count is no whole number below 2^64");
    for (const PlyElement& other : header.elements)
        if (other.name == element.name) return fail("this element was declared before");
    if (header.elements.size() == kMaxElements) return fail("the limit is {} elements", kMaxElements);
    header.elements.push_back(std::move(element));
    return {};
}

Status add_property(PlyHeader& header, const std::vector<std::string_view>& words) {
    if (header.elements.empty()) return fail("a property before the first element");
    PlyProperty property;
    if (words.size() == 5 && words[1] == "list") {
        property.count_type = type_named(words[2]);
        if (!property.count_type || is_float(*property.count_type))
            return fail("a list is counted by a PLY integer type");
    } else if (words.size() != 3) {
        return fail("a property needs a type and a name");
    }
    const std::optional<PlyType> type = type_named(words[words.size() - 2]);
    if (!type) return fail("unknown type");
    property.type = *type;
    property.name = std::string(words.back());
    std::vector<PlyProperty>& properties = header.elements.back().properties;
    for (const PlyProperty& other : properties)
        if (other.name == property.name) return fail("this property was declared before");
    if (properties.size() == kMaxProperties) return fail("the limit is {} properties", kMaxProperties);
    properties.push_back(std::move(property));
    return {};
}

Status set_format(PlyHeader& header, const std::vector<std::string_view>& words) {
    if (words.size() != 3 || words[2] != "1.0") return fail("expected a format of version 1.0");
    if (words[1] == "ascii") {
        header.format = PlyFormat::Ascii;
    } else if (words[1] == "binary_little_endian") {
        header.format = PlyFormat::LittleEndian;
    } else if (words[1] == "binary_big_endian") {
        header.format = PlyFormat::BigEndian;
    } else {
        return fail("unknown format");
    }
    return {};
}

}  // namespace

std::size_t size_of(PlyType type) {
    switch (type) {
        case PlyType::Int8:
        case PlyType::Uint8:
            return 1;
        case PlyType::Int16:
        case PlyType::Uint16:
            return 2;
        case PlyType::Float64:
            return 8;
        default:
            return 4;
    }
}

std::size_t PlyElement::min_row_bytes(PlyFormat format) const {
    if (format == PlyFormat::Ascii) return 2 * properties.size();  // a digit and a blank each
    std::size_t bytes = 0;
    for (const PlyProperty& property : properties)
        bytes += size_of(property.count_type.value_or(property.type));
    return bytes;
}

Result<PlyHeader> read_ply_header(std::span<const std::uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                                std::min(bytes.size(), kMaxHeaderBytes));
    if (!text.starts_with("ply\n") && !text.starts_with("ply\r"))
        return fail("does not start with a line `ply`");
    // The first line decides how lines end, because after a lone CR a binary body may start with an LF's
    // byte.
    const char newline = text[3] == '\r' && !text.substr(4).starts_with('\n') ? '\r' : '\n';

    PlyHeader header;
    bool format_seen = false;
    std::size_t at = 0;
    for (std::size_t number = 1;; ++number) {
        const std::size_t end = text.find(newline, at);
        if (end == std::string_view::npos)
            return fail("header: no end_header in {} {} bytes",
                        text.size() < bytes.size() ? "the first" : "all", text.size());
        const std::string_view line = text.substr(at, end - at);
        at = end + 1;
        const std::vector<std::string_view> words = words_of(line);
        if (number == 1 || words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
        if (words[0] == "end_header") break;

        Status status;
        if (words[0] == "format") {
            status = set_format(header, words);
            format_seen = true;
        } else if (words[0] == "element") {
            status = add_element(header, words);
        } else if (words[0] == "property") {
            status = add_property(header, words);
        } else {
            status = fail("unknown keyword");
        }
        if (!status) return fail("header line {} `{}`: {}", number, quoted(line), status.error().message);
    }
    if (!format_seen) return fail("header: no format");
    header.body = at;
    return header;
}

}  // namespace swath
