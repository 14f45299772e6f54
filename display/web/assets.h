#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace swath {

// A file of the viewer's page. It is part of the program, and lives as long.
struct Asset {
    std::string_view path;          // as a browser asks for it: "/main.js"
    std::string_view content_type;  // with the charset, for texts
    std::span<const std::uint8_t> bytes;
};

// All files, in the order of CMakeLists.txt; "/index.html" is the page. Any thread.
std::span<const Asset> assets();

}  // namespace swath
