# Every outside library, in one place. All are packages of Debian 12, 13 and sid (script/bootstrap installs them).
find_package(Threads REQUIRED)
find_package(Boost 1.81 CONFIG REQUIRED)
find_package(Protobuf REQUIRED)
find_package(glm REQUIRED)
find_package(spdlog REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(PNG REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(assimp REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(TURBOJPEG REQUIRED IMPORTED_TARGET libturbojpeg)
# SAH octrees are built with Thrust, on TBB's threads.
find_package(TBB REQUIRED)
find_path(SWATH_THRUST_INCLUDE thrust/version.h REQUIRED)
if(SWATH_TESTS)
  find_package(GTest REQUIRED)
  # Benchmarks only.
  pkg_check_modules(BULLET REQUIRED IMPORTED_TARGET bullet)
  find_package(embree REQUIRED)  # 3 or 4
endif()

# tl::expected is one header.
find_path(SWATH_EXPECTED_INCLUDE tl/expected.hpp REQUIRED)

# And on CUDA devices, with the Thrust that comes with nvcc.
if(SWATH_CUDA)
  if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES)
    set(CMAKE_CUDA_ARCHITECTURES 75-virtual)  # compiled by the driver for whatever is there, at the first use
  endif()
  enable_language(CUDA)
  find_package(CUDAToolkit REQUIRED)
endif()
