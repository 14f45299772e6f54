#include "common/image/pixel_codec.h"

#include <bit>
#include <cstring>
#include <vector>

#include "common/base/check.h"

namespace swath {
namespace {

static_assert(std::endian::native == std::endian::little, "bodies are little-endian and copied as they are");

constexpr std::uint32_t kFarBits = std::bit_cast<std::uint32_t>(kFarDepth);
constexpr std::size_t kSwathPixelBytes = 7;  // depth and colour
constexpr std::size_t kTilePixelBytes = 3;   // colour
constexpr int kChunk = 16;                   // pixels that find() tests together

bool active(float depth) { return depth < kFarDepth; }

// The first x in [x, end) whose pixel is active (kWanted) or is not (!kWanted), else end. Skips whole chunks.
template <bool kWanted>
int find(const float* row, int x, int end) {
    while (x + kChunk <= end) {
        unsigned hits = 0;
        for (int i = 0; i < kChunk; ++i) hits += static_cast<unsigned>(active(row[x + i]) == kWanted);
        if (hits != 0) break;
        x += kChunk;
    }
    while (x < end && active(row[x]) != kWanted) ++x;
    return x;
}

void put_varint(std::vector<std::uint8_t>& out, std::uint32_t value) {
    while (value >= 0x80) {
        out.push_back(static_cast<std::uint8_t>(value | 0x80));
        value >>= 7;
    }
    out.push_back(static_cast<std::uint8_t>(value));
}

bool get_varint(const std::uint8_t*& at, const std::uint8_t* end, std::uint32_t& value) {
    value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
        if (at == end) return false;
        const std::uint32_t byte = *at++;
        if (shift == 28 && byte > 0x0f) return false;
        value |= (byte & 0x7f) << shift;
        if (byte < 0x80) return true;
    }
    return false;
}

// Writes the span table of `region` and calls on_span(x, y, length) for each span.
template <class OnSpan>
std::uint32_t scan_spans(const PixelFrame& frame, const Region& region, std::vector<std::uint8_t>& table,
                         const OnSpan& on_span) {
    std::uint32_t pixels = 0;
    std::vector<std::uint8_t> row_spans;
    for (const Rect& rect : region) {
        CHECK(frame.rect().contains(rect) == true);
        for (int y = rect.y0; y < rect.y1; ++y) {
            const float* row = frame.depth(rect.x0, y, rect.width());
            row_spans.clear();
            std::uint32_t count = 0;
            int done = 0;
            for (int x = find<true>(row, 0, rect.width()); x < rect.width();) {
                const int end = find<false>(row, x, rect.width());
                put_varint(row_spans, static_cast<std::uint32_t>(x - done));
                put_varint(row_spans, static_cast<std::uint32_t>(end - x));
                on_span(rect.x0 + x, y, end - x);
                pixels += static_cast<std::uint32_t>(end - x);
                ++count;
                done = end;
                x = find<true>(row, end, rect.width());
            }
            put_varint(table, count);
            table.insert(table.end(), row_spans.begin(), row_spans.end());
        }
    }
    return pixels;
}

// Reads a span table against the region it must describe and calls on_span(x, y, length, pixels before).
template <class OnSpan>
Status walk_spans(std::span<const std::uint8_t> table, const Region& region, std::uint32_t pixels,
                  const OnSpan& on_span) {
    const std::uint8_t* at = table.data();
    const std::uint8_t* const end = at + table.size();
    std::uint32_t done = 0;
    for (const Rect& rect : region) {
        const auto width = static_cast<std::uint32_t>(rect.width());
        for (int y = rect.y0; y < rect.y1; ++y) {
            std::uint32_t count = 0;
            if (!get_varint(at, end, count)) return fail("spans: the table ends in row {}", y);
            std::uint32_t x = 0;
            for (std::uint32_t i = 0; i < count; ++i) {
                std::uint32_t skip = 0;
                std::uint32_t length = 0;
                if (!get_varint(at, end, skip) || !get_varint(at, end, length))
                    return fail("spans: the table ends in row {}", y);
                if (length == 0 || skip > width - x || length > width - x - skip)
                    return fail("spans: {} pixels after {} and {} skipped in a row of {}", length, x, skip,
                                width);
                if (length > pixels - done) return fail("spans: more pixels than the {} announced", pixels);
                x += skip;
                on_span(rect.x0 + static_cast<int>(x), y, static_cast<int>(length), done);
                x += length;
                done += length;
            }
        }
    }
    if (at != end) return fail("spans: {} bytes too many", end - at);
    if (done != pixels) return fail("spans: {} pixels where {} were announced", done, pixels);
    return {};
}

// Writes three bytes a pixel with four-byte stores, so there must be one byte of room behind the last.
std::uint8_t* pack_rgb(const std::uint32_t* colour, int length, std::uint8_t* out) {
    for (int i = 0; i < length; ++i, out += 3) std::memcpy(out, colour + i, 4);
    return out;
}

Status check_sizes(std::span<const std::uint8_t> body, const BodySizes& sizes, std::uint64_t bytes_a_pixel,
                   const Region& region) {
    if (sizes.pixels > static_cast<std::uint64_t>(area(region)))
        return fail("{} pixels for a region of {}", sizes.pixels, area(region));
    const std::uint64_t wanted = bytes_a_pixel * sizes.pixels + sizes.span_bytes + sizes.id_bytes;
    if (body.size() != wanted) return fail("a body of {} bytes where its head says {}", body.size(), wanted);
    return {};
}

Status decode_ids(std::span<const std::uint8_t> bytes, std::uint32_t pixels, ObjectId limit,
                  std::vector<ObjectId>& ids) {
    ids.resize(pixels);
    const std::uint8_t* at = bytes.data();
    const std::uint8_t* const end = at + bytes.size();
    std::uint32_t done = 0;
    std::int64_t id = 0;
    while (at != end) {
        std::uint32_t length = 0;
        std::uint32_t step = 0;
        if (!get_varint(at, end, length) || !get_varint(at, end, step))
            return fail("ids: a number is cut off or too long");
        id += static_cast<std::int64_t>(step >> 1) ^ -static_cast<std::int64_t>(step & 1);
        if (length == 0 || length > pixels - done)
            return fail("ids: a run of {} where {} pixels are left", length, pixels - done);
        if (id < 0 || id >= limit) return fail("ids: object {}, the limit is {}", id, limit);
        std::fill_n(ids.begin() + done, length, static_cast<ObjectId>(id));
        done += length;
    }
    if (done != pixels) return fail("ids: for {} of {} pixels", done, pixels);
    return {};
}

}  // namespace

BodySizes encode_swath(const PixelFrame& frame, const Region& region, Buffer& body) {
    struct Place {
        int x, y, length;
    };
    std::vector<Place> places;
    std::vector<std::uint8_t> spans;
    BodySizes sizes;
    sizes.pixels = scan_spans(frame, region, spans, [&](int x, int y, int length) {
        places.push_back({x, y, length});
    });

    body.resize(kSwathPixelBytes * sizes.pixels + 1);
    std::uint8_t* depth = body.data();
    std::uint8_t* rgb = body.data() + sizeof(float) * sizes.pixels;
    std::vector<std::uint8_t> ids;
    std::uint32_t run = 0;
    ObjectId current = 0;
    ObjectId previous = 0;
    const auto end_run = [&] {
        if (run == 0) return;
        const std::int64_t step = std::int64_t{current} - std::int64_t{previous};
        put_varint(ids, run);
        put_varint(ids, static_cast<std::uint32_t>((step << 1) ^ (step >> 63)));
        previous = current;
        run = 0;
    };
    for (const Place& place : places) {
        const std::size_t bytes = sizeof(float) * static_cast<std::size_t>(place.length);
        std::memcpy(depth, frame.depth(place.x, place.y, place.length), bytes);
        depth += bytes;
        rgb = pack_rgb(frame.colour(place.x, place.y, place.length), place.length, rgb);
        const ObjectId* id = frame.id(place.x, place.y, place.length);
        for (int i = 0; i < place.length; ++i) {
            if (id[i] != current || run == 0) {
                end_run();
                current = id[i];
            }
            ++run;
        }
    }
    end_run();
    sizes.span_bytes = static_cast<std::uint32_t>(spans.size());
    sizes.id_bytes = static_cast<std::uint32_t>(ids.size());
    body.resize(kSwathPixelBytes * sizes.pixels);
    body.append(spans.data(), spans.size());
    body.append(ids.data(), ids.size());
    return sizes;
}

BodySizes encode_tile(const PixelFrame& frame, const Region& region, Buffer& body) {
    std::vector<std::uint8_t> spans;
    body.resize(kTilePixelBytes * static_cast<std::size_t>(area(region)) + 1);
    std::uint8_t* out = body.data();
    BodySizes sizes;
    sizes.pixels = scan_spans(frame, region, spans, [&](int x, int y, int length) {
        out = pack_rgb(frame.colour(x, y, length), length, out);
    });
    sizes.span_bytes = static_cast<std::uint32_t>(spans.size());
    body.resize(kTilePixelBytes * sizes.pixels);
    body.append(spans.data(), spans.size());
    return sizes;
}

void composite_pixels(std::size_t n, const std::uint32_t* __restrict colour_in,
                      const float* __restrict depth_in, const ObjectId* __restrict id_in,
                      std::uint32_t* __restrict colour, float* __restrict depth, ObjectId* __restrict id) {
    // Depths are not negative, so their bits are ordered like them, and ids are below 2^31: signed integer
    // comparisons and selects without branches, of which the compiler makes vectors.
    for (std::size_t i = 0; i < n; ++i) {
        const auto theirs = std::bit_cast<std::int32_t>(depth_in[i]);
        const auto ours = std::bit_cast<std::int32_t>(depth[i]);
        const auto their_id = static_cast<std::int32_t>(id_in[i]);
        const auto our_id = static_cast<std::int32_t>(id[i]);
        const bool nearer = (theirs < ours) | ((theirs == ours) & (their_id < our_id));
        colour[i] = nearer ? colour_in[i] : colour[i];
        depth[i] = std::bit_cast<float>(nearer ? theirs : ours);
        id[i] = static_cast<ObjectId>(nearer ? their_id : our_id);
    }
}

Status composite_swath(std::span<const std::uint8_t> body, const BodySizes& sizes, const Region& region,
                       ObjectId object_limit, PixelFrame& frame) {
    // The region comes from the caller's plan, not from the peer.
    for (const Rect& rect : region) CHECK(frame.rect().contains(rect) == true);
    SWATH_TRY_VOID(check_sizes(body, sizes, kSwathPixelBytes, region));
    // Depths are read where they lie. A Buffer is aligned for them.
    CHECK(reinterpret_cast<std::uintptr_t>(body.data()) % alignof(float) == 0u);
    const auto* const depth = reinterpret_cast<const float*>(body.data());
    std::uint32_t highest = 0;
    for (std::size_t i = 0; i < sizes.pixels; ++i)
        highest = std::max(highest, std::bit_cast<std::uint32_t>(depth[i]));
    if (highest >= kFarBits) return fail("depths: a value outside [0, 1)");
    const std::uint8_t* const rgb = body.data() + sizeof(float) * sizes.pixels;
    const std::size_t pixel_bytes = kSwathPixelBytes * sizes.pixels;
    std::vector<ObjectId> ids;
    SWATH_TRY_VOID(decode_ids(body.subspan(pixel_bytes + sizes.span_bytes), sizes.pixels, object_limit, ids));
    std::vector<std::uint32_t> colour;  // of one span
    return walk_spans(body.subspan(pixel_bytes, sizes.span_bytes), region, sizes.pixels,
                      [&](int x, int y, int length, std::uint32_t at) {
                          const auto n = static_cast<std::size_t>(length);
                          colour.resize(n);
                          const std::uint8_t* from = rgb + kTilePixelBytes * at;
                          for (std::size_t i = 0; i < n; ++i, from += 3)
                              colour[i] = 0xff000000u | std::uint32_t{from[2]} << 16 |
                                          std::uint32_t{from[1]} << 8 | from[0];
                          composite_pixels(n, colour.data(), depth + at, &ids[at], frame.colour(x, y, length),
                                           frame.depth(x, y, length), frame.id(x, y, length));
                      });
}

Status assemble_tile(std::span<const std::uint8_t> body, const BodySizes& sizes, const Region& region,
                     Picture& picture) {
    const Rect all{0, 0, picture.width, picture.height};
    for (const Rect& rect : region) CHECK(all.contains(rect) == true);
    if (sizes.id_bytes != 0) return fail("a tile with object ids");
    SWATH_TRY_VOID(check_sizes(body, sizes, kTilePixelBytes, region));
    return walk_spans(body.subspan(kTilePixelBytes * sizes.pixels), region, sizes.pixels,
                      [&](int x, int y, int length, std::uint32_t at) {
                          const std::size_t to =
                              3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                   static_cast<std::size_t>(x));
                          std::memcpy(picture.rgb.data() + to, body.data() + std::size_t{3} * at,
                                      3 * static_cast<std::size_t>(length));
                      });
}

void fill(Picture& picture, int width, int height, const Rgb& background) {
    picture.width = width;
    picture.height = height;
    const std::size_t row = 3 * static_cast<std::size_t>(width);
    picture.rgb.resize(row * static_cast<std::size_t>(height));
    for (std::size_t x = 0; x < row && height > 0; ++x) picture.rgb[x] = background[x % 3];
    for (int y = 1; y < height; ++y)
        std::memcpy(picture.rgb.data() + row * static_cast<std::size_t>(y), picture.rgb.data(), row);
}

Picture to_picture(const PixelFrame& frame, const Rgb& background) {
    const Rect& rect = frame.rect();
    Picture picture;
    fill(picture, rect.width(), rect.height(), background);
    std::uint8_t* out = picture.rgb.data();
    for (int y = rect.y0; y < rect.y1; ++y) {
        const std::uint32_t* colour = frame.colour(rect.x0, y, rect.width());
        const float* depth = frame.depth(rect.x0, y, rect.width());
        for (int x = 0; x < rect.width(); ++x, out += 3)
            if (active(depth[x])) std::memcpy(out, colour + x, 3);
    }
    return picture;
}

}  // namespace swath
