# The libraries xr3 itself stands on; scripts/setup installs them, and
# docs/decisions/0002-dependencies.md says why each is here. Test libraries are found in tests/.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(Boost 1.81 REQUIRED CONFIG)
find_package(spdlog 1.10 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(PNG 1.6 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(NETTLE REQUIRED IMPORTED_TARGET nettle)
pkg_check_modules(NCURSES REQUIRED IMPORTED_TARGET ncursesw)
# (its own CMake package also asks for the web server and client of parts that we leave alone)
pkg_check_modules(PROMETHEUS REQUIRED IMPORTED_TARGET prometheus-cpp-core)
