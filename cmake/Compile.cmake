# Compiler settings and output folders that all builds share. Settings that differ between builds
# (optimisation, sanitizers, warnings as errors) are in CMakePresets.json.
set(least_of_GNU 12)
set(least_of_Clang 16)
set(least "${least_of_${CMAKE_CXX_COMPILER_ID}}")
if(least AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS least)
  message(FATAL_ERROR "${CMAKE_CXX_COMPILER} is version ${CMAKE_CXX_COMPILER_VERSION}; "
    "xr3 needs g++ 12 or clang 16, or newer.")
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}")

include_directories("${PROJECT_SOURCE_DIR}")  # includes name the folder, as in "core/step.hpp"
add_compile_options(-Wall -Wextra -Wpedantic -Wconversion -Wshadow)

# Equal arithmetic on every machine (docs/decisions/0004-integers-decide.md). The linker needs the
# option too, because with link-time optimisation the linker generates the code.
add_compile_options(-ffp-contract=off)
add_link_options(-ffp-contract=off)

# Options that end the program where a fault of memory would go on unseen. (glibc takes level 2 of _FORTIFY_SOURCE where
# the compiler has no level 3. The linker needs those that change code, as above.)
option(XR3_HARDENED "Check stack, buffers, containers and jumps while the program runs" OFF)
if(XR3_HARDENED)
  set(hardening -fstack-protector-strong -fstack-clash-protection)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|i.86")
    list(APPEND hardening -fcf-protection)
  endif()
  add_compile_options(${hardening} -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3 -D_GLIBCXX_ASSERTIONS)
  add_link_options(${hardening} -Wl,-z,relro,-z,now)
endif()

if(XR3_PORTABLE)  # no path of this machine, so that the same commit gives the same bytes
  add_compile_options("-ffile-prefix-map=${PROJECT_SOURCE_DIR}=.")
  add_link_options("-ffile-prefix-map=${PROJECT_SOURCE_DIR}=.")
endif()

# The path is relative to the build folder, in which Ninja starts the compiler, so that ccache shares objects
# between checkouts. The macro stands for the content, which neither Ninja nor ccache looks at.
option(XR3_UNINSTRUMENTED "Leave the headers of libraries uninstrumented by the sanitizers" OFF)
if(XR3_UNINSTRUMENTED)
  set(headers "${PROJECT_SOURCE_DIR}/cmake/uninstrumented.txt")
  file(SHA256 "${headers}" digest)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${headers}")
  cmake_path(RELATIVE_PATH headers BASE_DIRECTORY "${CMAKE_BINARY_DIR}")
  add_compile_options("-fsanitize-ignorelist=${headers}" "-DXR3_UNINSTRUMENTED=\"${digest}\"")
endif()

# ccache caches what uses a precompiled header only with these settings and, for clang, without the time in it.
option(XR3_PRECOMPILE "Compile headers of other libraries once for each target" OFF)
find_program(XR3_CCACHE ccache)
if(XR3_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${XR3_CCACHE}")
  if(XR3_PRECOMPILE)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}"
      "CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime" "${XR3_CCACHE}")
    add_compile_options("SHELL:-Xclang -fno-pch-timestamp")
  endif()
endif()

find_program(XR3_MOLD mold)
if(XR3_MOLD AND NOT CMAKE_CROSSCOMPILING)  # Debian's cross compilers do not find it
  add_link_options(-fuse-ld=mold)
endif()

if(XR3_LTO)
  include(CheckIPOSupported)
  check_ipo_supported(RESULT lto_works OUTPUT lto_output LANGUAGES CXX)
  set(CMAKE_INTERPROCEDURAL_OPTIMIZATION ${lto_works})
endif()
