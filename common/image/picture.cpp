#include "common/image/picture.h"

#include <png.h>
#include <turbojpeg.h>

#include <csetjmp>
#include <memory>
#include <stdexcept>

#include "common/base/check.h"

namespace swath {
namespace {

constexpr int kJpegQuality = 90;
// zlib's level, 1 to 9. Level 1 with the SUB filter is the fastest that still makes rendered pictures small.
constexpr int kPngLevel = 1;
// The bytes of an IDAT chunk. libpng's default means a call and a checksum every 8 KiB.
constexpr std::size_t kPngChunkBytes = 256 * 1024;
// Deflate never packs better than 1032 to 1.
constexpr std::uint64_t kMaxDeflateRatio = 1032;

std::size_t row_bytes(int width) { return 3 * static_cast<std::size_t>(width); }
std::size_t picture_bytes(int width, int height) {
    return row_bytes(width) * static_cast<std::size_t>(height);
}

// Takes what libpng writes, and its error.
struct PngSink {
    Buffer file;
    std::string error;
};

// libpng is C and leaves by longjmp. No exception crosses it, and no frame that longjmp skips (on_error,
// on_write, write_rows) has an object with a destructor alive at that moment.
[[noreturn]] void on_error(png_structp png, png_const_charp message) {
    try {
        static_cast<PngSink*>(png_get_error_ptr(png))->error = message;
    } catch (...) {
        // Without memory for the message it stays empty.
    }
    png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_write(png_structp png, png_bytep bytes, std::size_t count) {
    bool fits = true;
    try {
        static_cast<PngSink*>(png_get_io_ptr(png))->file.append(bytes, count);
    } catch (...) {
        fits = false;
    }
    if (!fits) png_error(png, "out of memory");
}

void on_flush(png_structp) {}

bool write_rows(png_structp png, png_infop info, const Picture& picture) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height),
                 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png, kPngLevel);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_buffer_size(png, kPngChunkBytes);
    png_write_info(png, info);
    for (int y = picture.height - 1; y >= 0; --y)
        png_write_row(png, picture.rgb.data() + static_cast<std::size_t>(y) * row_bytes(picture.width));
    png_write_end(png, info);
    return true;
}

Buffer encode_png(const Picture& picture) {
    PngSink sink;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, on_error, on_warning);
    png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
    if (info == nullptr) {
        png_destroy_write_struct(&png, &info);
        throw std::runtime_error("PNG: cannot make an encoder");
    }
    png_set_write_fn(png, &sink, on_write, on_flush);
    const bool ok = write_rows(png, info, picture);
    png_destroy_write_struct(&png, &info);
    if (!ok) throw std::runtime_error("PNG: " + sink.error);
    return std::move(sink.file);
}

struct DestroyJpeg {
    void operator()(void* handle) const { tjDestroy(handle); }
};

Buffer encode_jpeg(const Picture& picture) {
    const std::unique_ptr<void, DestroyJpeg> jpeg(tjInitCompress());
    if (jpeg == nullptr) throw std::runtime_error(std::string("JPEG: ") + tjGetErrorStr2(nullptr));
    // The largest size that the file can have, so that turbojpeg needs no block of its own.
    unsigned long size = tjBufSize(picture.width, picture.height, TJSAMP_420);
    Buffer file(size);
    unsigned char* out = file.data();
    if (tjCompress2(jpeg.get(), picture.rgb.data(), picture.width, 0, picture.height, TJPF_RGB, &out, &size,
                    TJSAMP_420, kJpegQuality, TJFLAG_BOTTOMUP | TJFLAG_NOREALLOC) != 0)
        throw std::runtime_error(std::string("JPEG: ") + tjGetErrorStr2(jpeg.get()));
    file.resize(size);
    return file;
}

// libpng's simplified reader, which lets no longjmp out.
struct PngImage {
    PngImage() { image.version = PNG_IMAGE_VERSION; }
    PngImage(const PngImage&) = delete;
    PngImage& operator=(const PngImage&) = delete;
    ~PngImage() { png_image_free(&image); }
    png_image image{};
};

}  // namespace

Buffer encode(const Picture& picture, PictureFormat format) {
    CHECK(picture.width >= 1);
    CHECK(picture.height >= 1);
    CHECK(picture.width <= kMaxPictureSide);
    CHECK(picture.height <= kMaxPictureSide);
    CHECK(picture.rgb.size() == picture_bytes(picture.width, picture.height));
    CHECK(format != PictureFormat::kNone);
    return format == PictureFormat::kPng ? encode_png(picture) : encode_jpeg(picture);
}

std::string file_extension(PictureFormat format) {
    CHECK(format != PictureFormat::kNone);
    return format == PictureFormat::kPng ? "png" : "jpg";
}

Result<Picture> decode_png(std::span<const std::uint8_t> bytes) {
    PngImage reader;
    png_image& image = reader.image;
    if (bytes.empty()) return fail("PNG: no bytes");
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0)
        return fail("PNG: {}", image.message);
    constexpr auto kMaxSide = static_cast<png_uint_32>(kMaxPictureSide);
    if (image.width > kMaxSide || image.height > kMaxSide)
        return fail("PNG: {} x {} pixels, the limit is {} x {}", image.width, image.height, kMaxPictureSide,
                    kMaxPictureSide);
    // A few bytes that announce a huge picture get no memory: they cannot hold even one bit a pixel.
    if (std::uint64_t{image.height} * (image.width / 8) > kMaxDeflateRatio * bytes.size())
        return fail("PNG: {} x {} pixels cannot be in {} bytes", image.width, image.height, bytes.size());

    image.format = PNG_FORMAT_RGB;
    Picture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
    picture.rgb.resize(picture_bytes(picture.width, picture.height));
    const png_color black{0, 0, 0};
    // A negative stride fills rows from the last one up.
    const auto stride = -static_cast<png_int_32>(row_bytes(picture.width));
    if (png_image_finish_read(&image, &black, picture.rgb.data(), stride, nullptr) == 0)
        return fail("PNG: {}", image.message);
    return picture;
}

}  // namespace swath
