#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/base/result.h"

namespace swath {

// A PLY file's header, which says what its body holds. It is from outside: read_ply checks it.
enum class PlyFormat { Ascii, LittleEndian, BigEndian };
enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

std::size_t size_of(PlyType type);
constexpr bool is_float(PlyType type) { return type == PlyType::Float32 || type == PlyType::Float64; }

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float32;    // of the value, or of a list's values
    std::optional<PlyType> count_type;  // set for a list: an integer type
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    // The fewest bytes that a row takes, which it does if all its lists are empty.
    std::size_t min_row_bytes(PlyFormat format) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::Ascii;
    std::vector<PlyElement> elements;  // in the order of the body; names are unique
    std::size_t body = 0;              // where the body starts, in bytes
};

// Reads the header alone. Lines may end in LF, CR LF or CR. Errors name the line.
Result<PlyHeader> read_ply_header(std::span<const std::uint8_t> bytes);

}  // namespace swath
