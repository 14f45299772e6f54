#include <filesystem>
#include <iostream>

#include "common/base/check.h"
#include "common/base/file.h"
#include "common/wire/codec.h"
#include "tests/common/image/frames.h"
#include "tests/common/wire/sample_messages.h"

// make_corpus FOLDER: writes the corpora of message_fuzz and pixels_fuzz, one file for each kind of message
// and for a few bodies. Run it again when the bytes on the wire change.

namespace {

using namespace swath;

void write(const std::filesystem::path& path, const Buffer& bytes) {
    CHECK(write_file(path, bytes.bytes()).has_value());
}

void write_messages(const std::filesystem::path& folder) {
    for (const Message& message : test::sample_messages(3)) {
        const std::string head = encode_head(message);
        const auto prefix = encode_prefix({static_cast<std::uint32_t>(head.size()), 0});
        Buffer bytes;
        bytes.append(prefix.data(), prefix.size());
        bytes.append(head.data(), head.size());
        write(folder / std::string(name(message)), bytes);
    }
}

// Writes bodies for the region that pixels_fuzz decodes.
void write_pixels(const std::filesystem::path& folder) {
    const Region region{{1, 1, 9, 4}, {10, 0, 13, 6}};
    test::Random random(1);
    for (const int coverage : {0, 1, 2, 3}) {
        const PixelFrame frame = test::random_frame({0, 0, 16, 8}, random, coverage);
        for (const bool tile : {false, true}) {
            Buffer body;
            const BodySizes sizes =
                tile ? encode_tile(frame, region, body) : encode_swath(frame, region, body);
            Buffer bytes;
            for (const std::uint32_t n : {sizes.pixels, sizes.span_bytes, sizes.id_bytes}) {
                CHECK(n < 256u);
                const auto byte = static_cast<std::uint8_t>(n);
                bytes.append(&byte, 1);
            }
            bytes.append(body.data(), body.size());
            write(folder / fmt::format("{}_{}", tile ? "tile" : "swath", coverage), bytes);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "make_corpus FOLDER\n";
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    write_messages(folder / "message");
    write_pixels(folder / "pixels");
}
