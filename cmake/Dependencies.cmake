# The libraries that xr3 links. scripts/setup installs them, and docs/decisions/0002-dependencies.md
# gives the reason for each. tests/CMakeLists.txt finds the test libraries.
if(XR3_PORTABLE)
  set(CMAKE_FIND_LIBRARY_SUFFIXES .a .so)
endif()
find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED)  # without a version, because 3.4 would exclude Eigen 5, which Fedora 44 has
if(Eigen3_VERSION VERSION_LESS 3.4)
  message(FATAL_ERROR "xr3 needs Eigen 3.4 or newer; this is ${Eigen3_VERSION}.")
endif()
find_package(nlohmann_json 3.11 REQUIRED)
find_package(Boost 1.81 REQUIRED CONFIG)
find_package(spdlog 1.10 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(PNG 1.6 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(NETTLE REQUIRED IMPORTED_TARGET nettle)
pkg_check_modules(NCURSES REQUIRED IMPORTED_TARGET ncursesw)
# (pkg-config, because prometheus-cpp's CMake package also requires the libraries of components that
# xr3 does not use.)
pkg_check_modules(PROMETHEUS REQUIRED IMPORTED_TARGET prometheus-cpp-core)

# (Debian has spdlog and fmt as shared libraries, or as headers.)
add_library(xr3_spdlog INTERFACE)
if(XR3_PORTABLE)
  target_compile_definitions(xr3_spdlog INTERFACE SPDLOG_FMT_EXTERNAL FMT_HEADER_ONLY)
else()
  target_link_libraries(xr3_spdlog INTERFACE spdlog::spdlog)
endif()
