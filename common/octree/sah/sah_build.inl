// The SAH octree builder for the backend that Thrust is compiled for, TBB or CUDA. One source of each
// includes it and says whether it runs on the host (kOnHost) and how many references a thread works on at
// once (kChunk).
#include <thrust/copy.h>
#include <thrust/device_malloc_allocator.h>
#include <thrust/device_vector.h>
#include <thrust/execution_policy.h>
#include <thrust/for_each.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/scan.h>
#include <thrust/transform_reduce.h>

#include <algorithm>
#include <array>
#include <string>
#if defined(__SANITIZE_THREAD__)
#include <thread>
#endif
#include <utility>
#include <vector>

#include "common/octree/sah/sah_build.h"
#include "common/octree/sah/sah_stages.h"

namespace swath {
namespace {

// A worker that builds subtrees has scratch space for so many lists of `grain` references.
constexpr std::uint32_t kScratchLists = 8;

// Leaves device memory uninitialised: most of it is written before it is read, and some is never used.
template <class T>
struct UninitialisedAllocator : thrust::device_malloc_allocator<T> {
    using Base = thrust::device_malloc_allocator<T>;
    template <class U>
    struct rebind {
        using other = UninitialisedAllocator<U>;
    };
    UninitialisedAllocator() = default;
    template <class U>
    SWATH_BOTH UninitialisedAllocator(const UninitialisedAllocator<U>& other) : Base(other) {}
    SWATH_BOTH void construct(T*) {}
};
template <class T>
using Array = thrust::device_vector<T, UninitialisedAllocator<T>>;
// Thrust's algorithms get raw pointers: its own iterators to device memory bind references to null on
// threads.
template <class T>
T* raw(Array<T>& array) {
    return thrust::raw_pointer_cast(array.data());
}

// Calls work(i) for every i below count, in parallel.
template <class Work>
void for_all(std::size_t count, const Work& work) {
#if defined(__SANITIZE_THREAD__)
    // TBB is built without the sanitizer, which therefore does not see its threads wait for one another and
    // takes each hand-over for a race. Threads that it knows do the work, so that it still checks ours.
    constexpr std::size_t kThreads = 4;
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < kThreads; ++t)
        threads.emplace_back([=] {
            for (std::size_t i = count * t / kThreads; i < count * (t + 1) / kThreads; ++i)
                work(static_cast<std::uint32_t>(i));
        });
#else
    thrust::for_each(thrust::device, thrust::counting_iterator<std::uint32_t>(0),
                     thrust::counting_iterator<std::uint32_t>(static_cast<std::uint32_t>(count)), work);
#endif
}

// Does one build after another and keeps its memory for the next.
class ThrustBuild {
  public:
    // At most `max_workers` build subtrees at once; each needs scratch space.
    explicit ThrustBuild(std::uint32_t max_workers) : max_workers_(max_workers) {}

    SahOutcome build(const SahTriangles& input, const SahSettings& settings) {
        const bool used_before = bytes_ > 0;
        SahOutcome outcome = build_with_what_is_there(input, settings);
        // A build that was too large has freed what earlier builds took: without that it may fit.
        if (bytes_ == 0 && used_before && !outcome.error.empty())
            outcome = build_with_what_is_there(input, settings);
        return outcome;
    }

  private:
    SahOutcome build_with_what_is_there(const SahTriangles& input, const SahSettings& settings) {
        settings_ = settings;
        opens_.clear();
        subtrees_.clear();
        const auto count = static_cast<std::uint32_t>(input.count());
        try {
            SahTree tree;
            SahBox box;
            if (!make_references(input, box))
                return {{},
                        "a triangle has a coordinate that is not a number or is beyond 1e18, or a corner "
                        "that is not there"};
            for (int axis = 0; axis < 3; ++axis) {
                tree.box.min[axis] = box.low[axis];
                tree.box.max[axis] = box.high[axis];
            }
            grow(tree, 1, 0);
            add_child({box, 0, count, count * settings.max_duplication, 0, 0, 0, 0});
            build_subtrees(tree);
            while (!opens_.empty()) {
                cut_level(tree);
                std::swap(references_, scattered_);
                build_subtrees(tree);
            }
            return {std::move(tree), {}};
        } catch (const TooLarge& too_large) {
            // Frees the memory, which the next, smaller build may need.
            *this = ThrustBuild(max_workers_);
            return {{},
                    "a tree over " + std::to_string(count) + " triangles takes more than the " +
                        std::to_string(settings.max_bytes) + " bytes that it may have (" +
                        std::to_string(too_large.bytes) + " for " + too_large.what + ")"};
        }
    }

    struct TooLarge {
        std::size_t bytes;
        const char* what;
    };
    void charge(std::size_t before, std::size_t now, const char* what) {
        bytes_ = bytes_ - before + now;
        if (bytes_ > settings_.max_bytes) throw TooLarge{now, what};
    }
    // Room for `size` elements, uninitialised. An array never shrinks: the next build is often as large.
    template <class T>
    T* room(Array<T>& array, std::size_t size, const char* what) {
        if (array.size() < size) {
            charge(sizeof(T) * array.size(), sizeof(T) * size, what);
            Array<T>().swap(array);
            array.resize(size);
        }
        return raw(array);
    }
    template <class T>
    const T* upload(Array<T>& array, const std::vector<T>& values, const char* what) {
        room(array, values.size(), what);
        thrust::copy(values.begin(), values.end(), array.begin());
        return raw(array);
    }
    template <class T>
    std::vector<T> download(const Array<T>& array, std::size_t size) {
        std::vector<T> values(size);
        thrust::copy(array.begin(), array.begin() + static_cast<std::ptrdiff_t>(size), values.begin());
        return values;
    }
    // The tree goes to the caller, so its bytes count for this build only and not in bytes_.
    void grow(SahTree& tree, std::size_t nodes, std::size_t triangles) {
        const std::size_t bytes = nodes * sizeof(SahNode) + triangles * sizeof(std::uint32_t);
        if (nodes > kMaxSahNodes || bytes_ + bytes > settings_.max_bytes) throw TooLarge{bytes, "the tree"};
        tree.nodes.resize(nodes);
        tree.triangles.resize(triangles);
    }

    // Returns false if a triangle lacks a corner or has a coordinate that is not allowed.
    bool make_references(const SahTriangles& input, SahBox& box) {
        const auto count = static_cast<std::uint32_t>(input.count());
        MakeReferences make{};
        make.stride = input.stride;
        make.position_count = static_cast<std::uint32_t>(input.position_count);
        if constexpr (kOnHost) {
            make.positions = reinterpret_cast<const unsigned char*>(input.positions);
            make.indices = input.indices.data();
        } else {
            const auto* from = reinterpret_cast<const unsigned char*>(input.positions);
            // The memory behind the last position's three floats is not ours to read.
            const std::size_t bytes = input.stride * (input.position_count - 1) + 3 * sizeof(float);
            make.positions = room(positions_, bytes, "the positions");
            thrust::copy(from, from + bytes, positions_.begin());
            make.indices = room(indices_, input.indices.size(), "the indices");
            thrust::copy(input.indices.begin(), input.indices.end(), indices_.begin());
        }
        make.references = room(references_, count, "the references");
        for_all(count, make);
        box = thrust::transform_reduce(thrust::device, raw(references_), raw(references_) + count, BoxOf{},
                                       SahBox{{kHuge, kHuge, kHuge}, {-kHuge, -kHuge, -kHuge}}, Bounding{});
        float size = 0.0f;
        for (int axis = 0; axis < 3; ++axis) size = higher(size, higher(-box.low[axis], box.high[axis]));
        return size <= kMaxSahCoordinate;
    }

    void add_child(const Open& child) {
        if (child.count > settings_.grain)
            opens_.push_back(child);
        else
            subtrees_.push_back({child, 0, 0});
    }

    // Cuts the nodes of opens_, whose references are in references_. Their children become opens_ and
    // subtrees_, the children's references go to scattered_.
    void cut_level(SahTree& tree) {
        std::vector<Chunk> chunks;
        for (std::size_t i = 0; i < opens_.size(); ++i) {
            Open& open = opens_[i];
            open.first_chunk = static_cast<std::uint32_t>(chunks.size());
            open.chunks = (open.count + kChunk - 1) / kChunk;
            for (std::uint32_t begin = 0; begin < open.count; begin += kChunk)
                chunks.push_back({static_cast<std::uint32_t>(i), open.first + begin,
                                  std::min<std::uint32_t>(kChunk, open.count - begin)});
        }
        const Open* opens = upload(d_opens_, opens_, "nodes");
        const Chunk* d_chunks = upload(d_chunks_, chunks, "chunks");
        const SahReference* references = raw(references_);
        std::uint32_t* bins = room(bins_, bin_words() * chunks.size(), "bins");
        SahSample* samples = room(samples_, 3 * opens_.size(), "samples");
        SahNearest* nears = room(nears_, chunks.size(), "samples");
        SahCut* cuts = room(d_cuts_, opens_.size(), "cuts");
        for_all(chunks.size(), BinChunk{opens, d_chunks, references, bins, settings_});
        for_all(3 * opens_.size(), FindSample{opens, bins, samples, settings_});
        for_all(chunks.size(), FindNearest{d_chunks, references, samples, nears, settings_.refine});
        for_all(opens_.size(), FindCut{opens, samples, nears, cuts, settings_});
        std::vector<SahCut> found = download(d_cuts_, opens_.size());

        const std::size_t counted = 8 * chunks.size();
        std::uint32_t* counts = room(counts_, counted + 1, "counts");
        unsigned char* children = room(children_, references_.size(), "counts");
        room(begins_, counted + 1, "counts");
        std::vector<std::uint32_t> begins;
        // Where triangles would stand in too many children, counts again, at most twice: with the best plane
        // only, then with none.
        for (bool again = true; again;) {
            again = false;
            for_all(chunks.size(), CountChildren{opens, d_chunks, cuts, references, children, counts});
            thrust::exclusive_scan(thrust::device, raw(counts_), raw(counts_) + counted + 1, raw(begins_));
            begins = download(begins_, counted + 1);
            for (std::size_t i = 0; i < opens_.size(); ++i) {
                const std::uint32_t axes = axes_of(found[i]);
                if (axes == 0 || needed_by(opens_[i], axes, begins) <= opens_[i].allowed) continue;
                again = true;
                keep_best(found[i]);
            }
            if (again) thrust::copy(found.begin(), found.end(), d_cuts_.begin());
        }
        SahReference* parts = room(scattered_, begins[counted], "the references");
        for_all(chunks.size(), Scatter{opens, d_chunks, cuts, references, children, raw(begins_), parts});

        std::vector<Open> parents;
        parents.swap(opens_);
        for (std::size_t i = 0; i < parents.size(); ++i) add_children(parents[i], found[i], begins, tree);
    }

    // The least number of triangles that the node's leaves have, an empty child counting as one.
    static std::uint32_t needed_by(const Open& open, std::uint32_t axes,
                                   const std::vector<std::uint32_t>& begins) {
        std::uint32_t needed = 0;
        for (std::uint32_t child = 0; child < 8; ++child)
            if ((child & ~axes) == 0)
                needed += std::max(begin_of(open, child + 1, begins) - begin_of(open, child, begins), 1u);
        return needed;
    }
    static std::uint32_t begin_of(const Open& open, std::uint32_t child,
                                  const std::vector<std::uint32_t>& begins) {
        return begins[std::size_t{8} * open.first_chunk + std::size_t{child} * open.chunks];
    }

    void add_children(const Open& parent, const SahCut& cut, const std::vector<std::uint32_t>& begins,
                      SahTree& tree) {
        const std::uint32_t axes = axes_of(cut);
        if (axes == 0) {
            Open leaf = parent;
            leaf.first = begin_of(parent, 0, begins);
            subtrees_.push_back({leaf, 0, 0});
            return;
        }
        std::array<float, 3> position{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (cut.planes[axis].any) position[axis] = cut.planes[axis].position;
        auto node = static_cast<std::uint32_t>(tree.nodes.size());
        tree.nodes[parent.node] = SahNode::inner(position, axes, node);
        grow(tree, tree.nodes.size() + (std::size_t{1} << std::popcount(axes)), tree.triangles.size());
        const std::uint32_t needed = needed_by(parent, axes, begins);
        for (std::uint32_t child = 0; child < 8; ++child) {
            if ((child & ~axes) != 0) continue;
            const std::uint32_t first = begin_of(parent, child, begins);
            const std::uint32_t count = begin_of(parent, child + 1, begins) - first;
            if (count > 0)
                add_child({box_of_child(parent.box, child, cut), first, count,
                           share_of(parent.allowed, needed, count), node, parent.depth + 1, 0, 0});
            ++node;
        }
    }

    // Builds all of subtrees_, whose references are in references_, and empties it.
    void build_subtrees(SahTree& tree) {
        const std::size_t count = subtrees_.size();
        if (count == 0) return;
        std::size_t node_room = 0;
        std::size_t triangle_room = 0;
        for (Subtree& subtree : subtrees_) {
            subtree.first_node = node_room;
            subtree.first_triangle = triangle_room;
            node_room += nodes_for(subtree.at.allowed);
            triangle_room += subtree.at.allowed;
        }
        BuildSubtrees build{};
        build.workers = static_cast<std::uint32_t>(std::min<std::size_t>(max_workers_, count));
        build.subtrees = upload(d_subtrees_, subtrees_, "subtrees");
        build.count = static_cast<std::uint32_t>(count);
        build.references = raw(references_);
        build.scratch_each = kScratchLists * settings_.grain;
        build.scratch = room(scratch_, std::size_t{build.workers} * build.scratch_each, "scratch");
        build.bins = room(scratch_bins_, bin_words() * build.workers, "scratch");
        build.nodes = room(nodes_, 4 * node_room, "nodes");
        build.triangles = room(triangles_, triangle_room, "leaves");
        build.sizes = room(sizes_, count, "subtrees");
        build.settings = settings_;
        for_all(build.workers, build);

        std::vector<SubtreeSizes> begins = download(sizes_, count);
        const std::size_t nodes_before = tree.nodes.size();
        const std::size_t triangles_before = tree.triangles.size();
        std::size_t nodes = nodes_before;
        std::size_t triangles = triangles_before;
        for (SubtreeSizes& begin : begins) {
            const SubtreeSizes size = begin;
            begin = {static_cast<std::uint32_t>(nodes), static_cast<std::uint32_t>(triangles)};
            nodes += size.nodes - 1;
            triangles += size.triangles;
        }
        grow(tree, nodes, triangles);
        std::vector<SahNode> roots(count);
        PlaceSubtree place{};
        place.subtrees = build.subtrees;
        place.sizes = build.sizes;
        place.begins = upload(d_begins_, begins, "subtrees");
        place.nodes = build.nodes;
        place.triangles = build.triangles;
        if constexpr (kOnHost) {
            place.roots = reinterpret_cast<std::uint32_t*>(roots.data());
            place.to_nodes = reinterpret_cast<std::uint32_t*>(tree.nodes.data() + nodes_before);
            place.to_triangles = tree.triangles.data() + triangles_before;
            for_all(count, place);
        } else {
            place.roots = room(roots_, 4 * count, "nodes");
            place.to_nodes = room(placed_nodes_, 4 * (nodes - nodes_before), "nodes");
            place.to_triangles = room(placed_triangles_, triangles - triangles_before, "leaves");
            for_all(count, place);
            const auto fetch = [](const Array<std::uint32_t>& from, std::size_t size, void* to) {
                thrust::copy(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(size),
                             static_cast<std::uint32_t*>(to));
            };
            fetch(roots_, 4 * count, roots.data());
            fetch(placed_nodes_, 4 * (nodes - nodes_before), tree.nodes.data() + nodes_before);
            fetch(placed_triangles_, triangles - triangles_before, tree.triangles.data() + triangles_before);
        }
        for (std::size_t i = 0; i < count; ++i) tree.nodes[subtrees_[i].at.node] = roots[i];
        subtrees_.clear();
    }

    std::size_t bin_words() const { return kBinWords * (std::size_t{settings_.max_bins} + 1); }

    std::uint32_t max_workers_;
    std::size_t bytes_ = 0;
    SahSettings settings_;
    std::vector<Open> opens_;
    std::vector<Subtree> subtrees_;
    Array<unsigned char> positions_;
    Array<std::uint32_t> indices_;
    Array<SahReference> references_;
    Array<SahReference> scattered_;
    Array<Open> d_opens_;
    Array<Chunk> d_chunks_;
    Array<SahSample> samples_;
    Array<SahNearest> nears_;
    Array<SahCut> d_cuts_;
    Array<std::uint32_t> bins_;
    Array<unsigned char> children_;  // of references_
    Array<std::uint32_t> counts_;
    Array<std::uint32_t> begins_;
    Array<Subtree> d_subtrees_;
    Array<SubtreeSizes> sizes_;
    Array<SubtreeSizes> d_begins_;
    Array<SahReference> scratch_;
    Array<std::uint32_t> scratch_bins_;
    Array<std::uint32_t> nodes_;
    Array<std::uint32_t> triangles_;
    Array<std::uint32_t> roots_;  // this and the next two are used on a GPU only
    Array<std::uint32_t> placed_nodes_;
    Array<std::uint32_t> placed_triangles_;
};

}  // namespace
}  // namespace swath
