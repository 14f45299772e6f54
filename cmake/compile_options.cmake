# What every target of ours is compiled with: `swath_options` carries it, `swath_library` applies it.
add_library(swath_options INTERFACE)
target_include_directories(swath_options INTERFACE ${PROJECT_SOURCE_DIR})
target_include_directories(swath_options SYSTEM INTERFACE ${SWATH_EXPECTED_INCLUDE})
target_compile_options(swath_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor
  # Floating point contraction would make depths and cull decisions depend on the compiler.
  -ffp-contract=off
  # A failed CHECK names a file of the tree, not the folder in which somebody built it.
  -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
target_compile_definitions(swath_options INTERFACE GLM_FORCE_CTOR_INIT GLM_ENABLE_EXPERIMENTAL
  # Checks that are dear (common/base/check.h).
  $<$<OR:$<CONFIG:Debug>,$<BOOL:${SWATH_SANITIZE}>>:SWATH_DCHECK>)
target_link_libraries(swath_options INTERFACE glm::glm fmt::fmt Threads::Threads)
if(SWATH_WERROR)
  target_compile_options(swath_options INTERFACE -Werror)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # What the optimiser believes to see differs from version to version: g++ 14 is wrong about the copy of a vector of one
    # element (array-bounds). The other two are of its kind. All three stay warnings.
    target_compile_options(swath_options INTERFACE
      -Wno-error=array-bounds -Wno-error=stringop-overflow -Wno-error=maybe-uninitialized)
  endif()
endif()
if(SWATH_SANITIZE)
  target_compile_options(swath_options INTERFACE -fsanitize=${SWATH_SANITIZE} -fno-omit-frame-pointer -g)
  target_link_options(swath_options INTERFACE -fsanitize=${SWATH_SANITIZE})
  if(SWATH_SANITIZE STREQUAL "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(swath_options INTERFACE -Wno-tsan)  # the fences in Asio, which matter to programs that run it on several threads
  endif()
  if(SWATH_SANITIZE STREQUAL "undefined")
    target_compile_options(swath_options INTERFACE -fno-sanitize-recover=all)
  endif()
endif()

# Functions that no program calls are left out, most of them from headers that are compiled once (Asio's, Beast's).
target_compile_options(swath_options INTERFACE -ffunction-sections)
target_link_options(swath_options INTERFACE -Wl,--gc-sections)

# swath_library(NAME SOURCES... ): a static library with the options above.
function(swath_library name)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PUBLIC swath_options)
endfunction()

# swath_reads_options(TARGET): most of its sources include CLI11, whose headers are full of code. Optimising that takes as
# long as reading it, and a program runs it once.
function(swath_reads_options target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Og>)
endfunction()

# swath_kernel(LIBRARY SOURCE [INSTRUCTION_SET...]): adds SOURCE to LIBRARY, compiled once for every processor
# (namespace `portable`) and once more for each instruction set named (`avx2`, `avx512`; on x86-64 only).
# SWATH_KERNEL is defined as that namespace. Such a source may include only headers without inline functions of
# linkage (no containers, no glm): the linker could give everybody the copy that few processors can run.
# common/base/instruction_set.h says at run time which one to call. tests/architecture looks at the objects, which the
# global property SWATH_KERNELS lists.
function(swath_kernel library source)
  set(flags_portable "")
  set(flags_avx2 -mavx2 -mfma -mbmi -mbmi2)
  set(flags_avx512 ${flags_avx2} -mavx512f -mavx512dq -mavx512bw -mavx512vl -mprefer-vector-width=512)
  set(sets portable)
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
    list(APPEND sets ${ARGN})
  endif()
  get_filename_component(stem ${source} NAME_WE)
  foreach(set IN LISTS sets)
    set(objects ${library}_${stem}_${set})
    add_library(${objects} OBJECT ${source})
    set_target_properties(${objects} PROPERTIES UNITY_BUILD OFF)
    target_link_libraries(${objects} PRIVATE swath_options)
    target_compile_definitions(${objects} PRIVATE SWATH_KERNEL=${set} SWATH_KERNEL_${set})
    target_compile_options(${objects} PRIVATE ${flags_${set}})
    target_sources(${library} PRIVATE $<TARGET_OBJECTS:${objects}>)
    set_property(GLOBAL APPEND PROPERTY SWATH_KERNELS $<TARGET_OBJECTS:${objects}>)
  endforeach()
endfunction()

# swath_test(NAME LABEL SOURCES...): a GoogleTest program; every TEST becomes a ctest test with LABEL.
include(GoogleTest)
function(swath_test name label)
  add_executable(${name} ${ARGN})
  target_link_libraries(${name} PRIVATE swath_options GTest::gmock GTest::gtest GTest::gtest_main)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${label} TIMEOUT 300)
endfunction()
