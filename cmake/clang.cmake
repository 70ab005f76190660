# The toolchain file of the presets that build with clang. It takes the first of these compilers that
# is installed. scripts/setup chooses its packages in the same order: tested versions come first
# (docs/decisions/0010-two-debians.md). To use another compiler, run
# cmake --preset dev -D CMAKE_CXX_COMPILER=clang++-18 in a new build folder.
find_program(CMAKE_CXX_COMPILER NAMES
  clang++-16 clang++-19 clang++-22 clang++-21 clang++-20 clang++-18 clang++-17 clang++)
if(NOT CMAKE_CXX_COMPILER)
  message(FATAL_ERROR "No clang is installed. scripts/setup installs one; xr3 needs clang 16 or newer.")
endif()
