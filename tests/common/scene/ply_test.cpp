#include "common/scene/ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/file.h"
#include "tests/support/models.h"

namespace swath {
namespace {

using ::testing::HasSubstr;
using Colour = std::array<std::uint8_t, 4>;

enum class Encoding { Ascii, Little, Big };

// Writes a PLY file in any encoding, value by value: header line and value come from the same call.
class PlyWriter {
  public:
    explicit PlyWriter(Encoding encoding, std::string newline = "\n")
        : encoding_(encoding), newline_(newline) {
        constexpr const char* kNames[] = {"ascii", "binary_little_endian", "binary_big_endian"};
        line("ply").line(std::string("format ") + kNames[static_cast<int>(encoding)] + " 1.0");
    }
    PlyWriter& line(const std::string& text) {
        bytes_ += text + newline_;
        return *this;
    }
    PlyWriter& put(const std::string& type, double value) {
        if (encoding_ == Encoding::Ascii) {
            bytes_ += fmt::format("{} ", value);
        } else if (type == "char" || type == "uchar") {
            raw(static_cast<std::uint8_t>(static_cast<int>(value)));
        } else if (type == "short" || type == "ushort") {
            raw(static_cast<std::uint16_t>(static_cast<int>(value)));
        } else if (type == "int" || type == "uint") {
            raw(static_cast<std::uint32_t>(static_cast<std::int64_t>(value)));
        } else if (type == "float") {
            raw(static_cast<float>(value));
        } else {
            raw(value);
        }
        return *this;
    }
    PlyWriter& row_end() {
        if (encoding_ == Encoding::Ascii) bytes_ += newline_;
        return *this;
    }
    std::string take() { return std::move(bytes_); }

  private:
    template <class T>
    void raw(T value) {
        char data[sizeof(T)];
        std::memcpy(data, &value, sizeof(T));
        if (encoding_ == Encoding::Big) std::reverse(data, data + sizeof(T));
        bytes_.append(data, sizeof(T));
    }

    Encoding encoding_;
    std::string newline_;
    std::string bytes_;
};

Result<Mesh> read(const std::string& text) {
    // Copies exactly that many bytes, so that the sanitizers see a read past the end.
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    return read_ply(bytes);
}

std::string why_not(const std::string& text) {
    const Result<Mesh> mesh = read(text);
    return mesh ? "valid" : mesh.error().message;
}

struct Types {
    std::string coordinate = "float";
    std::string count = "uchar";
    std::string index = "int";
};

std::string cube_ply(Encoding encoding, const Types& types = {}, const std::string& newline = "\n") {
    const Mesh cube = test::cube(1);
    PlyWriter ply(encoding, newline);
    ply.line("comment made by a test").line("element vertex 8");
    for (const char* axis : {"x", "y", "z"}) ply.line("property " + types.coordinate + " " + axis);
    ply.line("element face 12").line("property list " + types.count + " " + types.index + " vertex_indices");
    ply.line("end_header");
    for (const Vertex& vertex : cube.vertices) {
        for (int axis = 0; axis < 3; ++axis) ply.put(types.coordinate, double{vertex.position[axis]});
        ply.row_end();
    }
    for (std::size_t t = 0; t < 12; ++t) {
        ply.put(types.count, 3);
        for (std::size_t c = 0; c < 3; ++c) ply.put(types.index, cube.indices[3 * t + c]);
        ply.row_end();
    }
    return ply.take();
}

constexpr Encoding kEncodings[] = {Encoding::Ascii, Encoding::Little, Encoding::Big};

TEST(PlyTest, a_file_reads_the_same_in_every_encoding_and_type) {
    for (const Encoding encoding : kEncodings) {
        for (const char* coordinate : {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"})
            EXPECT_EQ(read(cube_ply(encoding, {.coordinate = coordinate})), test::cube()) << coordinate;
        for (const char* type : {"char", "uchar", "short", "ushort", "int", "uint"}) {
            EXPECT_EQ(read(cube_ply(encoding, {.count = type})), test::cube()) << type;
            EXPECT_EQ(read(cube_ply(encoding, {.index = type})), test::cube()) << type;
        }
    }
}

TEST(PlyTest, lines_may_end_in_any_of_the_three_ways) {
    for (const Encoding encoding : kEncodings)
        for (const char* newline : {"\n", "\r\n", "\r"})
            EXPECT_EQ(read(cube_ply(encoding, {}, newline)), test::cube())
                << why_not(cube_ply(encoding, {}, newline));
}

TEST(PlyTest, after_a_lone_carriage_return_a_line_feed_belongs_to_the_body) {
    PlyWriter ply(Encoding::Little, "\r");
    ply.line("element vertex 3").line("property uchar x").line("property uchar y").line("property uchar z");
    ply.line("element face 1").line("property list uchar uchar vertex_index").line("end_header");
    for (const int value : {10, 1, 2, 3, 4, 5, 6, 7, 9, 3, 0, 1, 2}) ply.put("uchar", value);
    const Result<Mesh> mesh = read(ply.take());
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->vertices[0].position, glm::vec3(10, 1, 2));
}

TEST(PlyTest, unknown_elements_and_properties_are_skipped_wherever_they_stand) {
    for (const Encoding encoding : kEncodings) {
        PlyWriter ply(encoding);
        ply.line("obj_info nothing").line("element camera 2").line("property double fov");
        ply.line("property list ushort float weights").line("element nothing 4000000000");
        ply.line("element face 2").line("property uchar flags").line("property list int double uv");
        ply.line("property list uchar ushort vertex_index").line("property short material");
        ply.line("element vertex 4").line("property float confidence").line("property float z");
        ply.line("property list uchar char tags").line("property float x").line("property double y");
        ply.line("element tristrips 1").line("property list int int vertex_indices").line("end_header");
        ply.put("double", 45).put("ushort", 2).put("float", 0.5).put("float", 7).row_end();
        ply.put("double", 60).put("ushort", 0).row_end();
        for (const std::vector<int>& face : {std::vector{0, 1, 2}, {0, 2, 3}}) {
            ply.put("uchar", 255).put("int", 1).put("double", 0.25).put("uchar", 3);
            for (const int index : face) ply.put("ushort", index);
            ply.put("short", -1).row_end();
        }
        for (int i = 0; i < 4; ++i) {
            ply.put("float", 1).put("float", 3 * i).put("uchar", i);
            for (int tag = 0; tag < i; ++tag) ply.put("char", -tag);
            ply.put("float", i).put("double", 0.5 * i).row_end();
        }
        ply.put("int", 1).put("int", 0).row_end();
        const Result<Mesh> mesh = read(ply.take());
        ASSERT_TRUE(mesh) << mesh.error().message;
        EXPECT_EQ(mesh->indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
        ASSERT_EQ(mesh->vertices.size(), 4u);
        EXPECT_EQ(mesh->vertices[3].position, glm::vec3(3, 1.5f, 9));
    }
}

// An ASCII file of four vertices in a square whose rows have the given properties after x y z.
std::string square(const std::string& properties, const std::string& values,
                   const std::string& faces = "4 0 1 2 3") {
    const auto count = std::to_string(1 + std::count(faces.begin(), faces.end(), '\n'));
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
    text += properties + "element face " + count + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const char* corner : {"0 0 0 ", "1 0 0 ", "1 1 0 ", "0 1 0 "}) text += corner + values + "\n";
    return text + faces + "\n";
}

TEST(PlyTest, polygons_become_fans_and_faces_of_two_corners_are_dropped) {
    const Result<Mesh> mesh = read(square("", "", "2 0 1\n4 3 2 1 0\n0\n1 2\n3 0 1 2"));
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->indices, (std::vector<std::uint32_t>{3, 2, 1, 3, 1, 0, 0, 1, 2}));
}

TEST(PlyTest, a_list_of_hundreds_of_corners_is_a_fan) {
    std::string face = "300";
    for (int i = 0; i < 300; ++i) face += fmt::format(" {}", i % 4);
    std::string text = square("", "", face);
    text.replace(text.find("list uchar"), 10, "list ushort");
    const Result<Mesh> mesh = read(text);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->triangle_count(), 298u);
}

TEST(PlyTest, colours_are_taken_as_bytes_words_or_fractions) {
    const auto colour = [](const std::string& type, const std::string& values,
                           const std::string& prefix = "") {
        std::string properties;
        for (const char* name : {"red", "green", "blue", "alpha"})
            properties += "property " + type + " " + prefix + name + "\n";
        const Result<Mesh> mesh = read(square(properties, values));
        return mesh ? mesh->vertices[2].colour : Colour{};
    };
    EXPECT_EQ(colour("uchar", "1 20 255 128"), (Colour{1, 20, 255, 128}));
    EXPECT_EQ(colour("uchar", "1 20 255 128", "diffuse_"), (Colour{1, 20, 255, 128}));
    EXPECT_EQ(colour("int", "-1 20 256 4000"), (Colour{0, 20, 255, 255}));
    EXPECT_EQ(colour("ushort", "0 257 65535 32896"), (Colour{0, 1, 255, 128}));
    EXPECT_EQ(colour("float", "0 0.5 1 0.2"), (Colour{0, 128, 255, 51}));
    EXPECT_EQ(colour("double", "-3 nan inf 1e30"), (Colour{0, 0, 255, 255}));
}

TEST(PlyTest, without_all_three_colours_the_default_stays) {
    const Result<Mesh> mesh = read(square("property uchar red\nproperty uchar green\n", "1 2"));
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->vertices[0].colour, Vertex{}.colour);
}

TEST(PlyTest, normals_are_taken_where_present_and_computed_where_not) {
    const std::string normals = "property float nx\nproperty float ny\nproperty float nz\n";
    const Result<Mesh> given = read(square(normals, "0 2 0"));
    ASSERT_TRUE(given);
    EXPECT_EQ(given->vertices[1].normal, pack_normal({0, 1, 0}));
    const Result<Mesh> computed = read(square("", "", "4 3 2 1 0"));
    ASSERT_TRUE(computed);
    EXPECT_EQ(computed->vertices[1].normal, pack_normal({0, 0, -1}));
    const Result<Mesh> broken = read(square(normals, "nan 0 0"));
    ASSERT_TRUE(broken);
    EXPECT_EQ(broken->vertices[1].normal, pack_normal({0, 0, 1}));
}

TEST(PlyTest, ascii_numbers_may_have_a_plus_sign_and_any_blanks_between) {
    std::string text = square("", "");
    text.replace(text.find("1 0 0 \n"), 7, "+1e0\t0\r\n\n 0.0\n");
    EXPECT_EQ(read(text), read(square("", "")));
}

TEST(PlyTest, a_file_cut_off_anywhere_is_refused_or_whole) {
    for (const Encoding encoding : kEncodings) {
        const std::string whole = cube_ply(encoding);
        for (std::size_t size = 0; size < whole.size(); ++size) {
            const Result<Mesh> mesh = read(whole.substr(0, size));
            if (mesh) {
                EXPECT_EQ(*mesh, test::cube()) << size;
                // An ASCII file may lose only the blanks at its end.
                EXPECT_GE(size + 2, whole.size());
            } else {
                EXPECT_EQ(mesh.error().message.find('\n'), std::string::npos);
            }
        }
    }
}

TEST(PlyTest, a_changed_byte_never_gives_an_invalid_mesh) {
    for (const Encoding encoding : kEncodings) {
        const std::string whole = cube_ply(encoding);
        for (std::size_t at = 0; at < whole.size(); ++at)
            for (const int change : {0x01, 0x10, 0x80, 0xff}) {
                std::string text = whole;
                text[at] = static_cast<char>(text[at] ^ change);
                const Result<Mesh> mesh = read(text);
                EXPECT_TRUE(!mesh || validate(*mesh)) << at;
            }
    }
}

// A binary header of 3 float vertices and a face, each row replaceable, with `body` zeros after it.
std::string header_with(const std::string& from, const std::string& to, std::size_t body = 49) {
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::size_t at = text.find(from);
    text.replace(at, from.size(), to);
    return text + std::string(body, '\0');
}

struct Bad {
    const char* from;
    const char* to;
    const char* why;
};

TEST(PlyTest, a_bad_header_is_refused_with_the_reason) {
    constexpr Bad kTable[] = {
        {"ply\n", "plx\n", "does not start with a line `ply`"},
        {"ply\n", "ply", "does not start with a line `ply`"},
        {"format binary_little_endian 1.0\n", "", "header: no format"},
        {"binary_little_endian", "binary_middle_endian",
         "header line 2 `format binary_middle_endian 1.0`: unknown format"},
        {"1.0", "2.0", "version 1.0"},
        {"element vertex 3\n", "", "a property before the first element"},
        {"element vertex 3", "element vertices 3", "no element vertex"},
        {"element vertex 3", "element vertex -3", "no whole number"},
        {"element vertex 3", "element vertex 3.5", "no whole number"},
        {"element vertex 3", "element vertex 99999999999999999999", "no whole number"},
        {"element vertex 3", "element vertex", "a name and a count"},
        {"element vertex 3", "element vertex 4294967281", "the limit is 4294967280"},
        {"element vertex 3", "element vertex 4000000000",
         "element vertex: 4000000000 rows of at least 12 bytes, but 49"},
        {"element face 1", "element face 18446744073709551615", "rows of at least 1 bytes"},
        {"element face 1", "element vertex 1",
         "header line 7 `element vertex 1`: this element was declared before"},
        {"element face 1", "element tristrips 1", "triangle strips are not supported"},
        {"element face 1", "element edge 1", "no element face"},
        {"element face 1", "element face 0", "no triangles in 0 faces"},
        {"property float z", "property float w", "element vertex: no scalar property z"},
        {"property float z", "property float x", "this property was declared before"},
        {"property float z", "property list uchar float z", "element vertex: no scalar property z"},
        {"property float z", "property quad z", "header line 6 `property quad z`: unknown type"},
        {"property float z", "property float", "a type and a name"},
        {"property float z", "propriety float z", "unknown keyword"},
        {"list uchar int", "list float int", "counted by a PLY integer type"},
        {"list uchar int", "list uchar string", "unknown type"},
        {"vertex_indices", "corners", "element face: no list property vertex_indices or vertex_index"},
        {"list uchar int", "int", "element face: no list property"},
        {"end_header\n", "", "no end_header in all"},
        {"ply\n", "ply\nelement spare 4000000000\nproperty list uchar int a\n",
         "element spare: 4000000000 rows"},
    };
    for (const Bad& bad : kTable)
        EXPECT_THAT(why_not(header_with(bad.from, bad.to)), HasSubstr(bad.why)) << bad.to;
}

TEST(PlyTest, a_header_without_an_end_or_measure_is_refused_soon) {
    EXPECT_THAT(why_not(header_with("ply\n", "ply\n" + std::string(2 << 20, '\n'))),
                HasSubstr("the first 1048576"));
    std::string many = "ply\n";
    for (int i = 0; i < 2000; ++i) many += fmt::format("element e{} 0\n", i);
    EXPECT_THAT(why_not(header_with("ply\n", many)), HasSubstr("the limit is 1000 elements"));
    many = "property float z\n";
    for (int i = 0; i < 2000; ++i) many += fmt::format("property float p{}\n", i);
    EXPECT_THAT(why_not(header_with("property float z\n", many)), HasSubstr("the limit is 1000 properties"));
}

TEST(PlyTest, an_error_that_quotes_the_file_stays_one_printable_line) {
    const std::string why =
        why_not(header_with("element vertex 3", "element \x1b[2J\x07" + std::string(500, 'x')));
    EXPECT_LT(why.size(), 200u);
    for (const char c : why) EXPECT_TRUE(c >= ' ' && c <= '~');
}

TEST(PlyTest, a_bad_value_is_refused_with_element_row_and_limit) {
    const std::string good = square("", "");
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_EQ(why_not(good), "valid");
    EXPECT_EQ(why_not(with("1 1 0", "1 nan 0")), "element vertex, row 2 of 4: y is nan, the limit is 1e+18");
    EXPECT_EQ(why_not(with("1 1 0", "1 1 -inf")),
              "element vertex, row 2 of 4: z is -inf, the limit is 1e+18");
    EXPECT_EQ(why_not(with("1 1 0", "1e39 1 0")),
              "element vertex, row 2 of 4: x is 1e+39, the limit is 1e+18");
    EXPECT_EQ(why_not(with("1 1 0", "1 one 0")),
              "element vertex, row 2 of 4, property y: no number that a double can hold");
    EXPECT_THAT(why_not(with("1 1 0", "1 1e999 0")), HasSubstr("property y: no number"));
    const std::string face = "element face, row 0 of 1, property vertex_indices: ";
    EXPECT_EQ(why_not(with("4 0 1 2 3", "4 0 1 2 4")), face + "index 4, but there are 4 vertices");
    EXPECT_EQ(why_not(with("4 0 1 2 3", "4 0 1 -1 3")), face + "index -1, but there are 4 vertices");
    EXPECT_EQ(why_not(with("4 0 1 2 3", "4 0 1 1.5 3")), face + "index 1.5, but there are 4 vertices");
    EXPECT_EQ(why_not(with("4 0 1 2 3", "4 0 1 nan 3")), face + "index nan, but there are 4 vertices");
    EXPECT_THAT(why_not(with("4 0 1 2 3", "-4 0 1 2 3")), HasSubstr(face + "-4 corners"));
    EXPECT_THAT(why_not(with("4 0 1 2 3", "1e9 0 1 2 3")), HasSubstr(face + "1000000000 corners"));
    EXPECT_EQ(why_not(with("4 0 1 2 3", "4 0 1 2")), face + "the file ends there");
    EXPECT_EQ(why_not(with("4 0 1 2 3", "2 0 1")), "element face: no triangles in 1 faces");
}

TEST(PlyTest, an_empty_file_and_an_empty_model_are_refused) {
    EXPECT_THAT(why_not(""), HasSubstr("does not start with"));
    EXPECT_THAT(
        why_not("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
                "property float z\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n"),
        HasSubstr("no triangles"));
}

TEST(PlyTest, the_shared_models_have_the_counts_that_are_known) {
    struct Known {
        const char* name;
        std::size_t vertices;
        std::size_t triangles;
    };
    bool any = false;
    for (const Known& known : {Known{"dragon.ply", 437'645, 871'414},
                               {"bunny.ply", 35'947, 69'451},
                               {"conference.ply", 194'399, 331'179}}) {
        const auto path = test::shared_model(known.name);
        if (!path) continue;
        any = true;
        const Result<Buffer> bytes = read_file(*path, 1 << 30);
        ASSERT_TRUE(bytes) << bytes.error().message;
        const Result<Mesh> mesh = read_ply(bytes->bytes());
        ASSERT_TRUE(mesh) << mesh.error().message;
        EXPECT_EQ(mesh->vertices.size(), known.vertices);
        EXPECT_EQ(mesh->triangle_count(), known.triangles);
        EXPECT_TRUE(validate(*mesh));
    }
    if (!any) GTEST_SKIP() << "no shared models found";
}

}  // namespace
}  // namespace swath
