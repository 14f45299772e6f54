#include "tests/architecture/include_graph.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

namespace swath::architecture {
namespace {

namespace fs = std::filesystem;

// The folders that each folder of common may include besides itself. A new folder needs a line here and one
// in common/README.md.
const std::map<std::string_view, std::set<std::string_view>> kCommonLayers = {
    {"common/base", {}},
    {"common/geometry", {"common/base"}},
    {"common/octree", {"common/base", "common/geometry"}},
    {"common/scene", {"common/base", "common/geometry", "common/octree"}},
    // A plan names objects by id: it knows nothing of the model.
    {"common/plan", {"common/base", "common/geometry"}},
    {"common/image", {"common/base", "common/geometry"}},
    {"common/timeline", {"common/base"}},
    {"common/cull", {"common/base", "common/geometry", "common/scene"}},
    // Its own cullers, orders and trees, beside the interfaces of ours. It knows nothing of meshes.
    {"common/published", {"common/base", "common/geometry", "common/octree", "common/cull"}},
    // Makes what implements the interface in cull.
    {"common/cullers", {"common/base", "common/geometry", "common/scene", "common/cull", "common/published"}},
    // Its settings say how a server culls, too.
    {"common/render", {"common/base", "common/geometry", "common/scene", "common/image", "common/cull"}},
    {"common/raster", {"common/base", "common/geometry", "common/scene", "common/image", "common/render"}},
    {"common/raycast",
     {"common/base", "common/geometry", "common/scene", "common/octree", "common/image", "common/render"}},
    // It makes the implementations of the interface in render.
    {"common/renderers",
     {"common/base", "common/scene", "common/octree", "common/render", "common/raster", "common/raycast"}},
    // Messages carry values of the layers below.
    {"common/wire",
     {"common/base", "common/geometry", "common/scene", "common/plan", "common/image", "common/timeline",
      "common/render", "common/cull"}},
    // The mains share this.
    {"common/program", {"common/base", "common/image", "common/wire"}},
};

// Decision code of the programs, which the simulator drives too.
const std::set<std::string_view> kDecisionFolders = {"client/partition", "client/cost", "client/predict",
                                                     "client/director",  "client/path", "server/swap",
                                                     "display/assemble"};

// Networking folders may include <boost/asio.hpp>, as every main.cpp and tests may.
const std::set<std::string_view> kAsioFolders = {"common/wire",     "common/program", "client/cluster",
                                                 "client/machines", "client/launch",  "server/session",
                                                 "display/session", "display/view"};

// Only these may include Boost.Beast, which compiles the slowest of all.
const std::set<std::string_view> kBeastFolders = {"display/view", "tests/support"};

std::string_view top_of(std::string_view path) { return path.substr(0, path.find('/')); }

bool is_ours(std::string_view path) {
    return path.find('/') != std::string_view::npos && std::ranges::count(kTopFolders, top_of(path)) > 0;
}

std::string arrow(std::string_view from, std::string_view to, std::string_view why) {
    return fmt::format("{} -> {}: {}", from, to, why);
}

// Finds cycles by a depth-first walk: an arrow to a node that is still being visited closes a cycle. Reports
// at least one cycle of every knot, not each of its possibly many.
class CycleFinder {
  public:
    explicit CycleFinder(const IncludeGraph& graph) : graph_(graph) {}

    std::vector<std::string> run() {
        for (const auto& [node, targets] : graph_) visit(node);
        return std::move(cycles_);
    }

  private:
    void visit(const std::string& node) {
        if (const auto open = std::ranges::find(path_, node); open != path_.end()) {
            cycles_.push_back(fmt::format("{} -> {}", fmt::join(open, path_.end(), " -> "), node));
            return;
        }
        if (!visited_.insert(node).second) return;
        const auto found = graph_.find(node);
        if (found == graph_.end()) return;  // not ours
        path_.push_back(node);
        for (const std::string& target : found->second) visit(target);
        path_.pop_back();
    }

    const IncludeGraph& graph_;
    std::set<std::string> visited_;
    std::vector<std::string> path_;
    std::vector<std::string> cycles_;
};

// The reason why a file in `from` may not include one in `to`, or nothing. Both are folders of ours.
std::string_view objection(std::string_view from, std::string_view to) {
    const std::string_view top = top_of(from);
    const std::string_view target = top_of(to);
    if (top == "tests") return {};
    if (target == "tests") return "nobody includes tests";
    if (top == "common" && target != "common") return "common stands on nothing else";
    if (top == "common") {
        const auto layer = kCommonLayers.find(from);
        if (layer == kCommonLayers.end())
            return "the including folder is not in the table of common's layers";
        return from == to || layer->second.contains(to) ? "" : "not a lower layer of common";
    }
    if (to == "common/published") return "what only reproduces papers is for common/cullers and tests";
    if (target == "common" || target == top) return {};
    if (top != "sim") return "only sim includes another program's code";
    return kDecisionFolders.contains(to) ? "" : "sim includes only decision code of the programs";
}

}  // namespace

std::vector<std::string> includes_of(std::string_view source) {
    const auto skip_blanks = [](std::string_view& text) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    };
    std::vector<std::string> names;
    while (!source.empty()) {
        std::string_view line = source.substr(0, source.find('\n'));
        source.remove_prefix(std::min(line.size() + 1, source.size()));
        skip_blanks(line);
        if (!line.starts_with('#')) continue;
        line.remove_prefix(1);
        skip_blanks(line);
        if (!line.starts_with("include")) continue;
        line.remove_prefix(std::string_view("include").size());
        skip_blanks(line);
        if (!line.starts_with('"') && !line.starts_with('<')) continue;
        const std::size_t end = line.find(line[0] == '"' ? '"' : '>', 1);
        if (end != std::string_view::npos) names.emplace_back(line.substr(1, end - 1));
    }
    return names;
}

IncludeGraph scan(const fs::path& root) {
    IncludeGraph graph;
    for (const std::string_view top : kTopFolders) {
        if (!fs::is_directory(root / top)) continue;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
            const fs::path extension = entry.path().extension();
            if (!entry.is_regular_file() || (extension != ".h" && extension != ".cpp")) continue;
            std::ifstream in(entry.path(), std::ios::binary);
            const std::string source{std::istreambuf_iterator<char>(in), {}};
            std::vector<std::string> includes = includes_of(source);
            for (std::string& include : includes) {
                const fs::path beside = (entry.path().parent_path() / include).lexically_normal();
                if (!is_ours(include) && fs::is_regular_file(beside))
                    include = beside.lexically_relative(root).generic_string();
            }
            graph[entry.path().lexically_relative(root).generic_string()] = std::move(includes);
        }
    }
    return graph;
}

std::string folder_of(std::string_view path) {
    const std::size_t first = path.find('/');
    const std::size_t second = path.find('/', first + 1);
    return std::string(path.substr(0, second == std::string_view::npos ? first : second));
}

std::vector<std::string> file_cycles(const IncludeGraph& graph) { return CycleFinder(graph).run(); }

std::vector<std::string> folder_cycles(const IncludeGraph& graph) {
    IncludeGraph folders;
    for (const auto& [file, includes] : graph) {
        const std::string from = folder_of(file);
        if (top_of(from) == "tests") continue;
        std::vector<std::string>& targets = folders[from];
        for (const std::string& include : includes) {
            if (!is_ours(include)) continue;
            const std::string to = folder_of(include);
            if (to != from && std::ranges::find(targets, to) == targets.end()) targets.push_back(to);
        }
    }
    return CycleFinder(folders).run();
}

std::vector<std::string> forbidden_arrows(const IncludeGraph& graph) {
    std::vector<std::string> offences;
    for (const auto& [file, includes] : graph)
        for (const std::string& include : includes) {
            if (!is_ours(include)) continue;
            const std::string_view why = objection(folder_of(file), folder_of(include));
            if (!why.empty()) offences.push_back(arrow(file, include, why));
        }
    return offences;
}

std::vector<std::string> forbidden_headers(const IncludeGraph& graph) {
    std::vector<std::string> offences;
    for (const auto& [file, includes] : graph) {
        const std::string folder = folder_of(file);
        const bool is_test = top_of(file) == "tests";
        const bool may_asio = is_test || file.ends_with("/main.cpp") || kAsioFolders.contains(folder);
        for (const std::string& include : includes) {
            if (include.ends_with(".pb.h") && folder != "common/wire" &&
                !file.starts_with("tests/common/wire/"))
                offences.push_back(arrow(file, include, "protobuf stays in common/wire"));
            if ((include == "boost/asio.hpp" || include.starts_with("boost/asio/")) && !may_asio)
                offences.push_back(arrow(file, include, "Asio stays in the networking folders"));
            if ((include == "boost/beast.hpp" || include.starts_with("boost/beast/")) &&
                (!file.ends_with(".cpp") || !kBeastFolders.contains(folder)))
                offences.push_back(
                    arrow(file, include, "Beast stays in sources of display/view and tests/support"));
        }
    }
    return offences;
}

}  // namespace swath::architecture
