#include "common/raster/raster_renderer.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "common/base/check.h"
#include "common/base/thread_team.h"
#include "common/raster/clip.h"
#include "common/raster/meshlets.h"

namespace swath {
namespace {

constexpr int kMaxSide = 16384;

const RasterKernels& kernels_of(InstructionSet set) {
#ifdef __x86_64__
    if (set == InstructionSet::kAvx512) return avx512::kRasterKernels;
    if (set == InstructionSet::kAvx2) return avx2::kRasterKernels;
#else
    static_cast<void>(set);
#endif
    return portable::kRasterKernels;
}

// A meshlet, or a part of it, to be drawn.
struct Item {
    std::uint32_t meshlet;
    std::uint32_t first;  // of its triangles: [first, end)
    std::uint32_t end;
    Rect rect;  // of the screen
    float nearest;
    bool may_clip;
};

KernelView kernel_view(const View& view) {
    KernelView result{};
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            result.clip_from_model[4 * column + row] = view.clip_from_model[column][row];
    for (int axis = 0; axis < 3; ++axis) result.to_light[axis] = view.to_light[axis];
    result.pose = view.pose;
    result.half_width = 0.5f * static_cast<float>(view.width);
    result.half_height = 0.5f * static_cast<float>(view.height);
    result.guard = 16383.0f;
    return result;
}

class RasterRenderer final : public Renderer {
  public:
    RasterRenderer(const RendererSetup& setup, const ObjectSet& scene, InstructionSet set)
        : set_(set),
          kernels_(kernels_of(set)),
          scene_(scene),
          meshlets_(scene),
          team_(setup.threads, clock_) {
        for (std::size_t i = 0; i < team_.size(); ++i) pixels_of_.push_back(std::make_unique<BinPixels>());
    }

    Status draw(std::span<const TriangleRange> ranges, const View& view, const Rect& rect) override {
        if (view.width < 1 || view.height < 1 || view.width > kMaxSide || view.height > kMaxSide)
            return fail("picture size {}x{}: this renderer's limits are 1x1 to {}x{}", view.width,
                        view.height, kMaxSide, kMaxSide);
        CHECK(view.viewport().contains(rect) == true);
        frame_.reshape(rect);
        if (rect.empty()) return {};
        const KernelView projection = kernel_view(view);
        select(ranges);
        place(projection, view.pose, rect);
        deal_out(rect);
        std::atomic<std::size_t> next{0};
        team_.run([&](std::size_t member) {
            for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < order_.size();)
                draw_bin(order_[i], projection, rect, *pixels_of_[member]);
        });
        return {};
    }

    Status read(const Rect& rect, PixelFrame& frame) override {
        frame.copy(frame_, rect);
        return {};
    }

    std::string description() const override {
        return fmt::format("rasteriser, {}, {} threads", name(set_), team_.size());
    }

  private:
    // Finds the meshlets of the ranges.
    void select(std::span<const TriangleRange> ranges) {
        items_.clear();
        for (const TriangleRange& range : ranges) {
            CHECK(range.object < scene_.objects.size());
            const Object& object = scene_.objects[range.object];
            CHECK(range.first_triangle >= object.first_triangle);
            CHECK(range.first_triangle + range.triangle_count <=
                  object.first_triangle + object.triangle_count);
            const std::uint32_t end = range.first_triangle + range.triangle_count;
            for (std::uint32_t at = range.first_triangle; at < end;) {
                const std::uint32_t i = meshlets_.of_triangle(range.object, at);
                for (std::uint32_t next = i; at < end; ++next) {
                    const Meshlet& meshlet = meshlets_.all()[next];
                    const std::uint32_t last = std::min(end, meshlet.first_triangle + meshlet.triangle_count);
                    items_.push_back(
                        {next, at - meshlet.first_triangle, last - meshlet.first_triangle, {}, 0, false});
                    at = last;
                }
            }
        }
    }

    // Finds where on the screen they are, clips what must be clipped, and drops what cannot be seen.
    void place(const KernelView& view, float pose, const Rect& rect) {
        loose_.clear();
        std::size_t kept = 0;
        BoxBlock boxes;
        BoundsBlock bounds;
        for (std::size_t begin = 0; begin < items_.size(); begin += 16) {
            const std::size_t count = std::min<std::size_t>(16, items_.size() - begin);
            for (std::size_t i = 0; i < 16; ++i) {
                const Meshlet& meshlet = meshlets_.all()[items_[begin + std::min(i, count - 1)].meshlet];
                const Box box = box_at(meshlet.box, meshlet.end_box, pose);
                for (int axis = 0; axis < 3; ++axis) {
                    boxes.low[axis][i] = box.min[axis];
                    boxes.high[axis][i] = box.max[axis];
                }
            }
            kernels_.project(view, boxes, bounds);
            for (std::size_t i = 0; i < count; ++i) {
                Item item = items_[begin + i];
                item.rect = intersect({bounds.x0[i], bounds.y0[i], bounds.x1[i], bounds.y1[i]}, rect);
                item.nearest = bounds.nearest[i];
                if (item.rect.empty()) continue;
                item.may_clip = (bounds.clipped >> i & 1) != 0;
                if (item.may_clip) clip_triangles(view, item);
                items_[kept++] = item;
            }
        }
        items_.resize(kept);
    }

    void clip_triangles(const KernelView& view, const Item& item) {
        const KernelMeshlet meshlet = meshlets_.kernel(item.meshlet, item.first, item.end, true);
        std::array<ClipVertex, kMeshletVertices> vertices;
        std::array<bool, kMeshletVertices> clipped{};
        for (std::uint32_t i = 0; i < 16 * meshlet.blocks; ++i) {
            vertices[i] = clip_vertex(view, meshlet, i);
            clipped[i] = needs_clipping(view, vertices[i]);
        }
        for (std::uint32_t t = item.first; t < item.end; ++t) {
            const std::uint32_t word = meshlet.triangles[t];
            const std::uint32_t a = word & 0xff;
            const std::uint32_t b = word >> 8 & 0xff;
            const std::uint32_t c = word >> 16;
            if (clipped[a] || clipped[b] || clipped[c])
                clip(view, {vertices[a], vertices[b], vertices[c]}, meshlet.number + t, loose_);
        }
    }

    // Deals meshlets, near ones first, and loose triangles out to the bins that they may touch.
    void deal_out(const Rect& rect) {
        columns_ = (rect.width() + kBinWidth - 1) / kBinWidth;
        rows_ = (rect.height() + kBinHeight - 1) / kBinHeight;
        sort_by_distance();
        const auto bins = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
        items_of_.deal(bins, items_.size(), [&](std::size_t i, auto add) {
            for_each_bin(items_[sorted_[i]].rect, rect, [&](std::size_t bin) { add(bin, sorted_[i]); });
        });
        loose_of_.deal(bins, loose_.size(), [&](std::size_t i, auto add) {
            const auto& c = loose_[i].corner;
            const Rect touched{
                (std::min({c[0].x, c[1].x, c[2].x}) >> 8), (std::min({c[0].y, c[1].y, c[2].y}) >> 8),
                (std::max({c[0].x, c[1].x, c[2].x}) >> 8) + 1, (std::max({c[0].y, c[1].y, c[2].y}) >> 8) + 1};
            for_each_bin(intersect(touched, rect), rect,
                         [&](std::size_t bin) { add(bin, static_cast<std::uint32_t>(i)); });
        });
        // The bins with the most work come first, so that no thread is left with one in the end.
        order_.resize(bins);
        for (std::size_t i = 0; i < bins; ++i) order_[i] = static_cast<std::uint32_t>(i);
        std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
            return items_of_.of(a).size() + loose_of_.of(a).size() >
                   items_of_.of(b).size() + loose_of_.of(b).size();
        });
    }

    template <class Task>
    void for_each_bin(const Rect& touched, const Rect& rect, Task task) const {
        if (touched.empty()) return;
        const int x0 = (touched.x0 - rect.x0) / kBinWidth;
        const int x1 = (touched.x1 - 1 - rect.x0) / kBinWidth;
        const int y0 = (touched.y0 - rect.y0) / kBinHeight;
        const int y1 = (touched.y1 - 1 - rect.y0) / kBinHeight;
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) task(static_cast<std::size_t>(y * columns_ + x));
    }

    // Orders items by their nearest depth, roughly: it decides only how much is hidden.
    void sort_by_distance() {
        constexpr std::size_t kBuckets = 4096;
        float low = 1;
        float high = 0;
        for (const Item& item : items_) {
            low = std::min(low, item.nearest);
            high = std::max(high, item.nearest);
        }
        const float scale = high > low ? static_cast<float>(kBuckets - 1) / (high - low) : 0.0f;
        const auto bucket = [&](const Item& item) {
            return static_cast<std::size_t>((item.nearest - low) * scale);
        };
        buckets_.assign(kBuckets + 1, 0);
        for (const Item& item : items_) ++buckets_[std::min(bucket(item), kBuckets - 1) + 1];
        for (std::size_t i = 0; i < kBuckets; ++i) buckets_[i + 1] += buckets_[i];
        sorted_.resize(items_.size());
        for (std::size_t i = 0; i < items_.size(); ++i)
            sorted_[buckets_[std::min(bucket(items_[i]), kBuckets - 1)]++] = static_cast<std::uint32_t>(i);
    }

    void draw_bin(std::uint32_t number, const KernelView& view, const Rect& rect, BinPixels& pixels) {
        const int column = static_cast<int>(number) % columns_;
        const int row = static_cast<int>(number) / columns_;
        const int x = rect.x0 + column * kBinWidth;
        const int y = rect.y0 + row * kBinHeight;
        const KernelBin bin{&pixels, x, y, std::min(kBinWidth, rect.x1 - x),
                            std::min(kBinHeight, rect.y1 - y)};
        const Rect area{x, y, x + bin.width, y + bin.height};
        const auto items = items_of_.of(number);
        const auto loose = loose_of_.of(number);
        if (items.empty() && loose.empty()) {
            frame_.clear(area);
            return;
        }
        kernels_.clear(pixels);
        Rect drawn = loose.empty() ? Rect{} : area;
        for (const std::uint32_t i : loose) kernels_.draw_triangle(loose_[i], bin);
        for (const std::uint32_t i : items) {
            const Item& item = items_[i];
            const Rect part = intersect(item.rect, area);
            drawn = bounding(drawn, part);
            if (kernels_.hides(pixels, part.x0 - x, part.y0 - y, part.x1 - x, part.y1 - y, item.nearest))
                continue;
            kernels_.draw(view, meshlets_.kernel(item.meshlet, item.first, item.end, item.may_clip), bin);
        }
        for (int row_y = y; row_y < area.y1; ++row_y) {
            if (row_y < drawn.y0 || row_y >= drawn.y1) {
                frame_.clear({area.x0, row_y, area.x1, row_y + 1});
                continue;
            }
            frame_.clear({area.x0, row_y, drawn.x0, row_y + 1});
            frame_.clear({drawn.x1, row_y, area.x1, row_y + 1});
            const int n = drawn.width();
            kernels_.read(pixels, drawn.x0 - x, row_y - y, n, meshlets_.objects(),
                          frame_.colour(drawn.x0, row_y, n), frame_.depth(drawn.x0, row_y, n),
                          frame_.id(drawn.x0, row_y, n));
        }
    }

    // Lists of numbers, one a bin, in one array.
    class Lists {
      public:
        // Calls visit(i, add) for each i below `size`, twice; add(list, number) adds to a list.
        template <class Visit>
        void deal(std::size_t lists, std::size_t size, Visit visit) {
            begins_.assign(lists + 1, 0);
            for (std::size_t i = 0; i < size; ++i)
                visit(i, [&](std::size_t list, std::uint32_t) { ++begins_[list + 1]; });
            for (std::size_t i = 0; i < lists; ++i) begins_[i + 1] += begins_[i];
            numbers_.resize(begins_.back());
            next_.assign(begins_.begin(), begins_.end() - 1);
            for (std::size_t i = 0; i < size; ++i)
                visit(i, [&](std::size_t list, std::uint32_t number) { numbers_[next_[list]++] = number; });
        }
        std::span<const std::uint32_t> of(std::size_t list) const {
            return std::span(numbers_).subspan(begins_[list], begins_[list + 1] - begins_[list]);
        }

      private:
        std::vector<std::size_t> begins_;
        std::vector<std::size_t> next_;
        std::vector<std::uint32_t> numbers_;
    };

    InstructionSet set_;
    const RasterKernels& kernels_;
    const ObjectSet& scene_;
    Meshlets meshlets_;
    SteadyClock clock_;  // the team needs one, though nobody asks for its times
    ThreadTeam team_;
    std::vector<std::unique_ptr<BinPixels>> pixels_of_;  // of each member
    PixelFrame frame_;                                   // of the last draw

    // Of the frame being drawn.
    std::vector<Item> items_;
    std::vector<ScreenTriangle> loose_;  // clipped ones
    std::vector<std::uint32_t> sorted_;  // items, near ones first
    std::vector<std::size_t> buckets_;
    Lists items_of_;
    Lists loose_of_;
    std::vector<std::uint32_t> order_;
    int columns_ = 0;
    int rows_ = 0;
};

}  // namespace

Result<std::unique_ptr<Renderer>> make_raster_renderer(const RendererSetup& setup, const ObjectSet& scene,
                                                       InstructionSet set) {
    CHECK(setup.threads > 0u);
    return std::make_unique<RasterRenderer>(setup, scene, set);
}

}  // namespace swath
