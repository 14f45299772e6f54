# cmake -D FILES=a.html;b.js -D OUT=embedded.cpp -P embed.cmake, in the folder of the files: writes a source file that
# holds them, for assets.h.
set(type_html "text/html; charset=utf-8")
set(type_css "text/css; charset=utf-8")
set(type_js "text/javascript; charset=utf-8")
set(type_svg "image/svg+xml")
set(type_png "image/png")
set(type_ico "image/x-icon")

set(arrays "")
set(table "")
set(index 0)
foreach(file IN LISTS FILES)
  get_filename_component(kind ${file} LAST_EXT)
  string(SUBSTRING "${kind}" 1 -1 kind)
  if(NOT DEFINED type_${kind})
    message(FATAL_ERROR "${file}: no content type is known for '${kind}'; add it to embed.cmake")
  endif()
  file(READ ${file} hex HEX)
  if(hex STREQUAL "")
    message(FATAL_ERROR "${file} is empty")
  endif()
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
  string(REGEX REPLACE "(................................................................................)" "\\1\n" bytes "${bytes}")
  string(APPEND arrays "constexpr std::uint8_t kFile${index}[] = {\n${bytes}};\n")
  string(APPEND table "    {\"/${file}\", \"${type_${kind}}\", kFile${index}},\n")
  math(EXPR index "${index} + 1")
endforeach()

file(WRITE ${OUT} "// Made by embed.cmake from the files of display/web.
#include \"display/web/assets.h\"

namespace swath {
namespace {
${arrays}
constexpr Asset kAssets[] = {
${table}};

}  // namespace

std::span<const Asset> assets() { return kAssets; }

}  // namespace swath
")
