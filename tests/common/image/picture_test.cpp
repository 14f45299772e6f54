#include "common/image/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <turbojpeg.h>
#include <zlib.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include "common/base/check.h"

namespace swath {
namespace {

using testing::HasSubstr;

Picture noise(int width, int height) {
    Picture picture{width, height, {}};
    std::mt19937 random(static_cast<unsigned>(width * 31 + height));
    picture.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::uint8_t& byte : picture.rgb) byte = static_cast<std::uint8_t>(random());
    return picture;
}

// The lower half red, the upper half blue.
Picture red_below_blue(int width, int height) {
    Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Rgb colour = y < height / 2 ? Rgb{255, 0, 0} : Rgb{0, 0, 255};
            picture.rgb.insert(picture.rgb.end(), colour.begin(), colour.end());
        }
    return picture;
}

std::vector<std::uint8_t> png_of(const Picture& picture) {
    const Buffer file = encode(picture, PictureFormat::kPng);
    return {file.bytes().begin(), file.bytes().end()};
}

// A PNG of one pixel, in a format of other programs.
std::vector<std::uint8_t> foreign_png(png_uint_32 format, const std::vector<std::uint8_t>& pixel) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = image.height = 1;
    image.format = format;
    std::vector<std::uint8_t> file(1024);
    png_alloc_size_t size = file.size();
    EXPECT_NE(png_image_write_to_memory(&image, file.data(), &size, 0, pixel.data(), 0, nullptr), 0);
    file.resize(size);
    return file;
}

// The file with wrong sides in its header, and the right checksum.
std::vector<std::uint8_t> with_announced_sides(std::vector<std::uint8_t> file, std::uint32_t width,
                                               std::uint32_t height) {
    // 8 bytes signature, 4 length, then the part that the checksum covers: "IHDR" and 13 bytes that begin
    // with the sides.
    const auto put = [&](std::size_t at, std::uint32_t value) {
        for (std::size_t i = 0; i < 4; ++i) file[at + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
    };
    put(16, width);
    put(20, height);
    put(29, static_cast<std::uint32_t>(crc32(0, file.data() + 12, 17)));
    return file;
}

// A JPEG's pixels, rows top-down as in the file.
Picture decode_jpeg_top_down(std::span<const std::uint8_t> bytes) {
    const std::unique_ptr<void, int (*)(void*)> jpeg(tjInitDecompress(), tjDestroy);
    Picture picture;
    int sampling = -1;
    int colours = -1;
    const auto size = static_cast<unsigned long>(bytes.size());
    EXPECT_EQ(tjDecompressHeader3(jpeg.get(), bytes.data(), size, &picture.width, &picture.height, &sampling,
                                  &colours),
              0);
    EXPECT_EQ(sampling, TJSAMP_420);
    picture.rgb.resize(3 * static_cast<std::size_t>(picture.width) *
                       static_cast<std::size_t>(picture.height));
    EXPECT_EQ(tjDecompress2(jpeg.get(), bytes.data(), size, picture.rgb.data(), picture.width, 0,
                            picture.height, TJPF_RGB, 0),
              0);
    return picture;
}

TEST(Png, GivesBackEveryPixelWhateverTheSides) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {7, 1}, {3, 5}, {17, 13}, {640, 481}}) {
        const Picture picture = noise(width, height);
        const Result<Picture> back = decode_png(png_of(picture));
        ASSERT_TRUE(back.has_value()) << back.error().message;
        EXPECT_EQ(*back, picture) << width << " x " << height;
    }
}

TEST(Png, IsTheSameFileEveryTime) {
    const Picture picture = noise(64, 64);
    EXPECT_EQ(png_of(picture), png_of(picture));
}

TEST(Png, FirstRowOfTheFileIsTheTopRow) {
    const Picture picture{1, 2, {2, 2, 2, 1, 1, 1}};
    const std::vector<std::uint8_t> file = png_of(picture);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_memory(&image, file.data(), file.size()), 0);
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> top_down(6);
    ASSERT_NE(png_image_finish_read(&image, nullptr, top_down.data(), 3, nullptr), 0);
    EXPECT_EQ(top_down, (std::vector<std::uint8_t>{1, 1, 1, 2, 2, 2}));
}

TEST(Png, DecodesGreyAndTransparentPicturesToo) {
    EXPECT_EQ(*decode_png(foreign_png(PNG_FORMAT_GRAY, {77})), (Picture{1, 1, {77, 77, 77}}));
    EXPECT_EQ(*decode_png(foreign_png(PNG_FORMAT_RGBA, {10, 20, 30, 255})), (Picture{1, 1, {10, 20, 30}}));
    EXPECT_EQ(*decode_png(foreign_png(PNG_FORMAT_RGBA, {10, 20, 30, 0})), (Picture{1, 1, {0, 0, 0}}));
}

TEST(Png, DecodingNamesTheLimitOfTheSides) {
    const Result<Picture> picture = decode_png(with_announced_sides(png_of(noise(1, 1)), 16385, 1));
    ASSERT_FALSE(picture.has_value());
    EXPECT_EQ(picture.error().message, "PNG: 16385 x 1 pixels, the limit is 16384 x 16384");
}

TEST(Png, DecodingGivesNoMemoryForPixelsThatCannotBeInTheFile) {
    const Result<Picture> picture = decode_png(with_announced_sides(png_of(noise(1, 1)), 16384, 16384));
    ASSERT_FALSE(picture.has_value());
    EXPECT_THAT(picture.error().message, HasSubstr("16384 x 16384 pixels cannot be in"));
}

TEST(Png, DecodingFailsOnEveryTruncation) {
    const std::vector<std::uint8_t> file = png_of(noise(9, 9));
    // The last 16 bytes are the end chunk and a checksum, which a reader of pixels need not reach.
    for (std::size_t length = 0; length + 16 < file.size(); ++length) {
        const Result<Picture> picture = decode_png(std::span(file).first(length));
        ASSERT_FALSE(picture.has_value()) << "after " << length << " of " << file.size() << " bytes";
        EXPECT_THAT(picture.error().message, HasSubstr("PNG"));
    }
}

TEST(Png, DecodingNeverCrashesOnDamage) {
    const std::vector<std::uint8_t> file = png_of(noise(9, 9));
    std::mt19937 random(1);
    for (int round = 0; round < 2000; ++round) {
        std::vector<std::uint8_t> damaged = file;
        for (int i = 0; i < 3; ++i) damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
        const Result<Picture> picture = decode_png(damaged);
        EXPECT_TRUE(picture.has_value() || !picture.error().message.empty());
    }
}

TEST(Png, DecodingRefusesWhatIsNoPng) {
    EXPECT_FALSE(decode_png({}).has_value());
    const std::string text = "this is a text, not a picture";
    EXPECT_FALSE(decode_png({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}).has_value());
}

TEST(Png, EncodingAPictureWithoutPixelsIsABug) {
    EXPECT_THROW(encode(Picture{}, PictureFormat::kPng), CheckFailed);
    EXPECT_THROW(encode(Picture{2, 2, {1, 2, 3}}, PictureFormat::kPng), CheckFailed);
    EXPECT_THROW(encode(Picture{-1, -1, {1, 2, 3}}, PictureFormat::kJpeg), CheckFailed);
    EXPECT_THROW(encode(Picture{1, 1, {1, 2, 3}}, PictureFormat::kNone), CheckFailed);
    EXPECT_THROW(encode(Picture{kMaxPictureSide + 1, 0, {}}, PictureFormat::kPng), CheckFailed);
}

TEST(Jpeg, IsCloseAndTopDown) {
    const Picture picture = red_below_blue(33, 48);
    const Buffer file = encode(picture, PictureFormat::kJpeg);
    const Picture top_down = decode_jpeg_top_down(file.bytes());
    ASSERT_EQ(top_down.width, 33);
    ASSERT_EQ(top_down.height, 48);
    const std::uint8_t* top = top_down.rgb.data();
    const std::uint8_t* bottom = top_down.rgb.data() + top_down.rgb.size() - 3;
    EXPECT_LE(top[0], 5);
    EXPECT_GE(top[2], 250);
    EXPECT_GE(bottom[0], 250);
    EXPECT_LE(bottom[2], 5);
}

TEST(Jpeg, TakesOddSides) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {15, 17}, {101, 3}}) {
        const Buffer file = encode(noise(width, height), PictureFormat::kJpeg);
        const Picture back = decode_jpeg_top_down(file.bytes());
        EXPECT_EQ(back.width, width);
        EXPECT_EQ(back.height, height);
    }
}

TEST(Jpeg, IsTheSameFileEveryTimeAndSmallerThanThePng) {
    const Picture picture = noise(64, 64);
    const Buffer first = encode(picture, PictureFormat::kJpeg);
    const Buffer second = encode(picture, PictureFormat::kJpeg);
    EXPECT_TRUE(std::ranges::equal(first.bytes(), second.bytes()));
    EXPECT_LT(first.size(), encode(picture, PictureFormat::kPng).size());
}

TEST(PictureFormat, HasTheUsualExtensions) {
    EXPECT_EQ(file_extension(PictureFormat::kPng), "png");
    EXPECT_EQ(file_extension(PictureFormat::kJpeg), "jpg");
    EXPECT_THROW(file_extension(PictureFormat::kNone), CheckFailed);
}

}  // namespace
}  // namespace swath
