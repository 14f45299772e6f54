#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace swath {

// A file of the viewer's page. It lives in the program itself, for as long as that runs.
struct Asset {
    std::string_view path;          // as a browser asks for it: "/main.js"
    std::string_view content_type;  // with the charset, for texts
    std::span<const std::uint8_t> bytes;
};

// All of them, in the order in which CMakeLists.txt lists them; "/index.html" is the page. Any thread.
std::span<const Asset> assets();

}  // namespace swath
