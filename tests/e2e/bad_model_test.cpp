// A bad model ends the client with exit code 1 and one line that names the file, the fault and the limit;
// nothing is written.
#include <fmt/core.h>

#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

constexpr std::string_view kHeader =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face {}\nproperty list uchar int vertex_indices\nend_header\n";

std::string ply(int faces, const std::string& rows) {
    return fmt::format(fmt::runtime(kHeader), faces) + rows;
}

struct BadModelCase {
    std::string name;
    std::string file;  // its name
    std::string text;
    std::vector<std::string> words;
};
void PrintTo(const BadModelCase& c, std::ostream* out) { *out << c.name; }

const std::vector<BadModelCase> kBadModels{
    {"EmptyPly", "empty.ply", "", {"empty.ply"}},
    {"EmptyObj", "empty.obj", "", {"empty.obj"}},
    {"TruncatedPly", "short.ply", ply(1, "0 0 0\n1 0 0\n"), {"short.ply", "vertex"}},
    {"TruncatedBinaryPly",
     "short.ply",
     "ply\nformat binary_little_endian 1.0\nelement vertex 1000\nproperty float x\nproperty float y\n"
     "property float z\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n0123456789",
     {"short.ply", "vertex", "1000", "10 bytes"}},
    {"PlyThatAnnouncesTooMuch",
     "huge.ply",
     "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
     "property float z\nelement face 4000000000\nproperty list uchar int vertex_indices\nend_header\n",
     {"huge.ply", "vertex"}},
    {"VertexIsNoNumber",
     "nan.ply",
     ply(1, "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"),
     {"nan.ply", "vertex", "nan", "limit"}},
    {"VertexIsInfinite",
     "inf.ply",
     ply(1, "0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n"),
     {"inf.ply", "vertex", "limit"}},
    {"IndexOutOfRange",
     "index.ply",
     ply(1, "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
     {"index.ply", "index 3", "3 vertices"}},
    {"NoFaces", "flat.ply", ply(0, "0 0 0\n1 0 0\n0 1 0\n"), {"flat.ply", "no triangles"}},
    {"ObjWithoutFaces", "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", {"points.obj"}},
    {"NoPlyAtAll", "text.ply", "GET / HTTP/1.1\r\n\r\n", {"text.ply"}},
    {"UnknownKind", "model.unknown", std::string("\0garbage\xff", 9), {"model.unknown"}},
    {"GarbledStl", "model.stl", std::string(100, '\xff'), {"model.stl"}},
    {"GarbledGltf", "model.gltf", "{\"asset\": [", {"model.gltf"}},
};

class BadModel : public EndToEnd {
  protected:
    void expect_refused(const std::string& model, const std::vector<std::string>& words) {
        for (const Arguments& where : {Arguments{"--single"}, Arguments{"--local", "2"}}) {
            SCOPED_TRACE(where[0]);
            const std::string out = files_.path_of("out");
            const Finished finished =
                client(Arguments{model, "--out", out, "--timeline", out + ".csv"} + where);
            expect_one_error(finished, 1, words);
            EXPECT_LT(finished.took, kSlowdown * std::chrono::seconds(5));
            EXPECT_FALSE(std::filesystem::exists(out));
            EXPECT_FALSE(std::filesystem::exists(out + ".csv"));
        }
    }
};

class BadFile : public BadModel, public testing::WithParamInterface<BadModelCase> {};

TEST_P(BadFile, IsRefusedInOneLine) {
    expect_refused(files_.write(GetParam().file, GetParam().text), GetParam().words);
}

INSTANTIATE_TEST_SUITE_P(Cases, BadFile, testing::ValuesIn(kBadModels),
                         [](const auto& c) { return c.param.name; });

TEST_F(BadModel, MissingFileIsNamed) {
    expect_refused(files_.path_of("missing.ply"), {"missing.ply", "No such file"});
    expect_refused(files_.path_of("missing.obj"), {"missing.obj"});
}

TEST_F(BadModel, FolderIsRefused) {
    for (const char* name : {"folder.ply", "folder.obj", "folder"}) {
        std::filesystem::create_directory(files_.path_of(name));
        expect_refused(files_.path_of(name), {name});
    }
}

TEST_F(BadModel, UnknownBuiltinNameGetsTheList) {
    expect_refused("builtin:teapot", {"teapot", "knot", "spheres", "town"});
}

TEST_F(BadModel, BuiltinSizeMustBeANumberWithinTheLimits) {
    expect_refused("builtin:knot:many", {"builtin:knot:many", "many"});
    expect_refused("builtin:knot:-5", {"-5"});
    expect_refused("builtin:knot:3", {"12", "50000000"});
    expect_refused("builtin:knot:50000001", {"12", "50000000"});
    expect_refused("builtin:knot:99999999999999999999999", {"99999999999999999999999"});
}

TEST_F(BadModel, BadCameraFileIsNamedWithItsLine) {
    for (const Arguments& where : {Arguments{"--single"}, Arguments{"--local", "1"}}) {
        const Arguments arguments =
            Arguments{"builtin:knot:1000", "--out", files_.path_of("out"), "--path"} + where;
        const auto with = [&](const std::string& path) {
            Arguments all = arguments;
            all.insert(all.begin() + 4, path);
            return client(all);
        };
        expect_one_error(with(files_.path_of("none.txt")), 1, {"none.txt"});
        expect_one_error(with(files_.write("cameras.txt", "# none\n")), 1, {"cameras.txt", "no cameras"});
        expect_one_error(with(files_.write("cameras.txt", "0 0 5 0 0 0 0 1 0 40\n0 0 5\n")), 1,
                         {"cameras.txt:2"});
        expect_one_error(with(files_.write("cameras.txt", "0 0 nan 0 0 0 0 1 0 40\n")), 1,
                         {"cameras.txt:1", "nan"});
    }
    EXPECT_FALSE(std::filesystem::exists(files_.path_of("out")));
}

TEST_F(BadModel, TrianglesWithoutAreaAreNoHarm) {
    // One triangle with an area, and three without: a repeated corner, three corners on a line, three in one
    // place.
    const std::string rows = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 1\n3 0 0 0\n3 2 2 1\n";
    const Arguments arguments{files_.write("thin.ply", ply(4, rows)), "--size", "64x48", "--frames", "2"};
    const std::string expected = render(arguments + Arguments{"--single"});
    expect_not_only({16, 18, 24}, expected);
    expect_same_pictures(expected, render(arguments + Arguments{"--local", "3"}));
    // Only such triangles make an empty picture, not an error.
    const std::string nothing = files_.write("line.ply", ply(2, "0 0 0\n1 1 1\n2 2 2\n3 0 1 2\n3 1 1 1\n"));
    expect_only({16, 18, 24}, render({nothing, "--local", "2", "--size", "64x48", "--frames", "1"}));
}

}  // namespace
}  // namespace swath::test
