#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

// The include graph of the source tree, and the rules that it must obey. Paths are relative to the root, with
// '/'.
namespace swath::architecture {

inline constexpr std::string_view kTopFolders[] = {"common", "client", "server", "display", "sim", "tests"};

// The includes of every source file, in order: ours as paths from the root, others as written.
using IncludeGraph = std::map<std::string, std::vector<std::string>>;

// The names in a source's include lines, both "..." and <...>, in order.
std::vector<std::string> includes_of(std::string_view source);

// Reads all .h and .cpp files under the top folders of `root`. Includes relative to the file's own folder
// become paths from the root. Throws std::filesystem::filesystem_error.
IncludeGraph scan(const std::filesystem::path& root);

// "common/wire" for common/wire/framing.h, "client" for client/main.cpp.
std::string folder_of(std::string_view path);

// Each returns a line per offence, which names the arrow or the whole cycle; empty if the rule holds.
std::vector<std::string> file_cycles(const IncludeGraph& graph);
std::vector<std::string> folder_cycles(const IncludeGraph& graph);  // all folders but those of tests
std::vector<std::string> forbidden_arrows(
    const IncludeGraph& graph);  // between top folders and within common
std::vector<std::string> forbidden_headers(
    const IncludeGraph& graph);  // protobuf, Asio and Beast outside their folders

}  // namespace swath::architecture
