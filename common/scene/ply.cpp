#include "common/scene/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

#include "common/scene/ply_header.h"

namespace swath {
namespace {

static_assert(std::endian::native == std::endian::little);

// Reads the values of a binary body one by one. Every integer type of PLY fits in a double.
template <bool kSwapped>
class BinaryReader {
  public:
    explicit BinaryReader(std::span<const std::uint8_t> body) : at_(body.data()), end_(at_ + body.size()) {}

    std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }

    bool read(PlyType type, double& value) {
        switch (type) {
            case PlyType::Int8:
                return take<std::int8_t>(value);
            case PlyType::Uint8:
                return take<std::uint8_t>(value);
            case PlyType::Int16:
                return take<std::int16_t>(value);
            case PlyType::Uint16:
                return take<std::uint16_t>(value);
            case PlyType::Int32:
                return take<std::int32_t>(value);
            case PlyType::Uint32:
                return take<std::uint32_t>(value);
            case PlyType::Float32:
                return take<float>(value);
            case PlyType::Float64:
                return take<double>(value);
        }
        return false;
    }

    bool skip(PlyType type, std::uint64_t count) {
        if (count > remaining() / size_of(type)) return false;
        at_ += count * size_of(type);
        return true;
    }

    std::string why() const { return "the file ends there"; }

  private:
    template <class T>
    bool take(double& value) {
        if (remaining() < sizeof(T)) return false;
        std::array<std::uint8_t, sizeof(T)> raw;
        std::memcpy(raw.data(), at_, sizeof(T));
        if constexpr (kSwapped) std::reverse(raw.begin(), raw.end());
        value = static_cast<double>(std::bit_cast<T>(raw));
        at_ += sizeof(T);
        return true;
    }

    const std::uint8_t* at_;
    const std::uint8_t* end_;
};

// The same for an ASCII body. Line ends count as blanks, since the properties say where a row ends.
class AsciiReader {
  public:
    explicit AsciiReader(std::span<const std::uint8_t> body)
        : at_(reinterpret_cast<const char*>(body.data())), end_(at_ + body.size()) {}

    // One more than there are, because the last value of a file needs no blank behind it.
    std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_) + 1; }

    bool read(PlyType, double& value) {
        while (at_ < end_ && is_blank(*at_)) ++at_;
        const char* number = at_;
        if (end_ - at_ > 1 && *at_ == '+' && at_[1] != '-') ++number;  // from_chars knows no plus sign
        const auto [stop, error] = std::from_chars(number, end_, value);
        if (error != std::errc{} || (stop != end_ && !is_blank(*stop))) return false;
        at_ = stop;
        return true;
    }

    bool skip(PlyType type, std::uint64_t count) {
        if (count > remaining() / 2) return false;
        double ignored = 0;
        for (std::uint64_t i = 0; i < count; ++i)
            if (!read(type, ignored)) return false;
        return true;
    }

    std::string why() const {
        return at_ == end_ ? "the file ends there" : "no number that a double can hold";
    }

  private:
    static bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

    const char* at_;
    const char* end_;
};

// The properties of a vertex that we use; kIgnored stands for all others.
enum Slot { kX, kY, kZ, kNormalX, kNormalY, kNormalZ, kRed, kGreen, kBlue, kAlpha, kSlots, kIgnored };

Slot slot_named(std::string_view name) {
    constexpr std::array<std::string_view, kSlots> kNames = {"x",  "y",   "z",     "nx",   "ny",
                                                             "nz", "red", "green", "blue", "alpha"};
    if (name.starts_with("diffuse_")) name.remove_prefix(8);
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    return found == kNames.end() ? kIgnored : static_cast<Slot>(found - kNames.begin());
}

// Floats are 0 to 1, 16-bit integers 0 to 65535, all other integers 0 to 255.
std::uint8_t colour_byte(double value, PlyType type) {
    if (is_float(type)) value *= 255.0;
    if (type == PlyType::Uint16) value /= 257.0;
    if (!(value > 0)) return 0;  // also if it is NaN
    return value >= 255.0 ? std::uint8_t{255} : static_cast<std::uint8_t>(value + 0.5);
}

const PlyElement* find_element(const PlyHeader& header, std::string_view name) {
    for (const PlyElement& element : header.elements)
        if (element.name == name) return &element;
    return nullptr;
}

bool is_index_list(const PlyProperty& property) {
    return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

// Fails if the body cannot give a mesh.
Status check_header(const PlyHeader& header) {
    const PlyElement* vertex = find_element(header, "vertex");
    if (vertex == nullptr) return fail("no element vertex");
    for (const std::string_view axis : {"x", "y", "z"}) {
        const auto is_axis = [&](const PlyProperty& p) { return p.name == axis && !p.count_type; };
        if (std::none_of(vertex->properties.begin(), vertex->properties.end(), is_axis))
            return fail("element vertex: no scalar property {}", axis);
    }
    if (vertex->count > kMaxVertices)
        return fail("element vertex: {} rows, the limit is {}", vertex->count, kMaxVertices);
    const PlyElement* face = find_element(header, "face");
    if (face == nullptr && find_element(header, "tristrips") != nullptr)
        return fail("element tristrips: triangle strips are not supported, save the model with faces");
    if (face == nullptr) return fail("no element face: a cloud of points has no triangles");
    if (std::none_of(face->properties.begin(), face->properties.end(), is_index_list))
        return fail("element face: no list property vertex_indices or vertex_index");
    return {};
}

// Reads the body that `header` promises into `mesh`.
template <class Reader>
class BodyReader {
  public:
    BodyReader(const PlyHeader& header, Reader reader)
        : header_(header), reader_(reader), vertex_count_(find_element(header, "vertex")->count) {}

    Result<Mesh> run() {
        for (const PlyElement& element : header_.elements) {
            const std::size_t row_bytes = element.min_row_bytes(header_.format);
            if (row_bytes == 0) continue;  // rows without properties take no room
            if (element.count > reader_.remaining() / row_bytes)
                return fail("element {}: {} rows of at least {} bytes, but {} bytes are left", element.name,
                            element.count, row_bytes, reader_.remaining());
            if (element.name == "vertex")
                SWATH_TRY_VOID(read_vertices(element));
            else if (element.name == "face")
                SWATH_TRY_VOID(read_faces(element));
            else
                SWATH_TRY_VOID(skip_rows(element));
        }
        if (mesh_.indices.empty()) return fail("element face: no triangles in {} faces", face_count_);
        if (!has_normals_) compute_normals(mesh_);
        return std::move(mesh_);
    }

  private:
    tl::unexpected<Error> fail_at(const PlyElement& element, std::uint64_t row,
                                  const PlyProperty& property) const {
        return fail("element {}, row {} of {}, property {}: {}", element.name, row, element.count,
                    property.name, reader_.why());
    }

    bool skip(const PlyProperty& property) {
        if (!property.count_type) return reader_.skip(property.type, 1);
        double count = 0;
        return reader_.read(*property.count_type, count) && count >= 0 &&
               reader_.skip(property.type, static_cast<std::uint64_t>(std::min(count, 1e18)));
    }

    Status skip_rows(const PlyElement& element) {
        for (std::uint64_t row = 0; row < element.count; ++row)
            for (const PlyProperty& property : element.properties)
                if (!skip(property)) return fail_at(element, row, property);
        return {};
    }

    Status read_vertices(const PlyElement& element) {
        std::array<bool, kSlots + 2> present{};
        std::array<PlyType, kSlots + 2> types{};
        std::vector<Slot> slots;
        for (const PlyProperty& property : element.properties) {
            slots.push_back(property.count_type ? kIgnored : slot_named(property.name));
            present[slots.back()] = true;
            types[slots.back()] = property.type;
        }
        has_normals_ = present[kNormalX] && present[kNormalY] && present[kNormalZ];
        const bool has_colour = present[kRed] && present[kGreen] && present[kBlue];

        mesh_.vertices.resize(element.count);
        std::array<double, kSlots + 2> values{};
        for (std::uint64_t row = 0; row < element.count; ++row) {
            for (std::size_t i = 0; i < slots.size(); ++i) {
                const PlyProperty& property = element.properties[i];
                const bool ok =
                    slots[i] == kIgnored ? skip(property) : reader_.read(property.type, values[slots[i]]);
                if (!ok) return fail_at(element, row, property);
            }
            for (const Slot axis : {kX, kY, kZ})
                if (!(std::abs(values[axis]) <= double{kMaxCoordinate}))
                    return fail("element vertex, row {} of {}: {} is {}, the limit is {}", row, element.count,
                                std::array{'x', 'y', 'z'}[axis], values[axis], kMaxCoordinate);
            Vertex& vertex = mesh_.vertices[row];
            vertex.position = glm::dvec3(values[kX], values[kY], values[kZ]);
            if (has_normals_)
                vertex.normal = pack_normal(glm::dvec3(values[kNormalX], values[kNormalY], values[kNormalZ]));
            if (has_colour)
                for (const Slot slot : {kRed, kGreen, kBlue, kAlpha})
                    if (present[slot])
                        vertex.colour[static_cast<std::size_t>(slot - kRed)] =
                            colour_byte(values[slot], types[slot]);
        }
        return {};
    }

    Status read_faces(const PlyElement& element) {
        face_count_ = element.count;
        const auto list = std::find_if(element.properties.begin(), element.properties.end(), is_index_list);
        const std::size_t triangle_bytes =
            size_of(*list->count_type) + 3 * (header_.format == PlyFormat::Ascii ? 2 : size_of(list->type));
        mesh_.indices.reserve(3 * std::min<std::size_t>(element.count, reader_.remaining() / triangle_bytes));
        for (std::uint64_t row = 0; row < element.count; ++row) {
            for (const PlyProperty& property : element.properties) {
                if (&property == &*list)
                    SWATH_TRY_VOID(read_polygon(element, row, property));
                else if (!skip(property))
                    return fail_at(element, row, property);
            }
            if (mesh_.triangle_count() > kMaxTriangles)
                return fail("element face: more than {} triangles", kMaxTriangles);
        }
        return {};
    }

    // Makes a fan around the polygon's first vertex, or nothing of fewer than three corners.
    Status read_polygon(const PlyElement& element, std::uint64_t row, const PlyProperty& list) {
        double corners = 0;
        if (!reader_.read(*list.count_type, corners)) return fail_at(element, row, list);
        if (!(corners >= 0 && corners <= static_cast<double>(reader_.remaining())))
            return fail("element face, row {} of {}, property {}: {} corners, but {} bytes are left", row,
                        element.count, list.name, corners, reader_.remaining());
        const auto count = static_cast<std::size_t>(corners);
        std::uint32_t first = 0;
        std::uint32_t previous = 0;
        for (std::size_t corner = 0; corner < count; ++corner) {
            double value = 0;
            if (!reader_.read(list.type, value)) return fail_at(element, row, list);
            if (!(value >= 0 && value < static_cast<double>(vertex_count_)) || value != std::floor(value))
                return fail("element face, row {} of {}, property {}: index {}, but there are {} vertices",
                            row, element.count, list.name, value, vertex_count_);
            const auto index = static_cast<std::uint32_t>(value);
            if (corner == 0) first = index;
            if (corner >= 2) mesh_.indices.insert(mesh_.indices.end(), {first, previous, index});
            previous = index;
        }
        return {};
    }

    const PlyHeader& header_;
    Reader reader_;
    std::uint64_t vertex_count_;
    std::uint64_t face_count_ = 0;
    bool has_normals_ = false;
    Mesh mesh_;
};

}  // namespace

Result<Mesh> read_ply(std::span<const std::uint8_t> bytes) {
    SWATH_TRY(const PlyHeader header, read_ply_header(bytes));
    SWATH_TRY_VOID(check_header(header));
    const std::span<const std::uint8_t> body = bytes.subspan(header.body);
    switch (header.format) {
        case PlyFormat::Ascii:
            return BodyReader(header, AsciiReader(body)).run();
        case PlyFormat::LittleEndian:
            return BodyReader(header, BinaryReader<false>(body)).run();
        case PlyFormat::BigEndian:
            return BodyReader(header, BinaryReader<true>(body)).run();
    }
    return fail("unknown format");
}

}  // namespace swath
