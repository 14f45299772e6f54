# cmake -D VERSION=0.1.0 -D SOURCE=FOLDER -D OUT=version.cpp -P version.cmake: writes the source file behind version.h,
# and touches it only where it would change.
set(commit "")
if(EXISTS ${SOURCE}/.git)
  execute_process(COMMAND git describe --always --abbrev=12 --exclude=* --dirty=+
    WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
file(CONFIGURE OUTPUT ${OUT} @ONLY CONTENT [[
// Made by version.cmake.
#include "common/program/version.h"

namespace swath {

std::string_view version() { return "@VERSION@"; }
std::string_view commit() { return "@commit@"; }

}  // namespace swath
]])
