# xr3_together(<variable> <name> <source>...): the sources to compile for <source>..., which are absolute
# paths below the project. With XR3_TOGETHER these are files that include up to XR3_MOST_TOGETHER neighbouring sources
# each, except those with a comment `Compiled alone:`, so that the compiler parses the headers of many files
# once (docs/decisions/0018-compile-together.md). CMake's own UNITY_BUILD writes absolute paths into such files, and
# ccache then shares nothing between two checkouts.
option(XR3_TOGETHER "Compile the sources of a library together" ON)
set(XR3_MOST_TOGETHER 12)
if(XR3_TOGETHER AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ takes an included source for a header, in which it warns of types from anonymous namespaces.
  add_compile_options(-Wno-subobject-linkage)
endif()

function(xr3_together variable name)
  if(NOT XR3_TOGETHER)
    set(${variable} ${ARGN} PARENT_SCOPE)
    return()
  endif()
  cmake_path(GET CMAKE_CURRENT_FUNCTION_LIST_DIR PARENT_PATH root)
  foreach(source ${ARGN})
    file(STRINGS "${source}" mark REGEX "^// Compiled alone:" LIMIT_COUNT 1)
    if(mark)
      list(APPEND files "${source}")
      list(REMOVE_ITEM ARGN "${source}")
    endif()
  endforeach()
  list(LENGTH ARGN total)
  # Groups of nearly one size: the last one is not a small one.
  math(EXPR groups "(${total} + ${XR3_MOST_TOGETHER} - 1) / ${XR3_MOST_TOGETHER}")
  foreach(number RANGE 1 ${groups})
    math(EXPR first "${total} * (${number} - 1) / ${groups}")
    math(EXPR count "${total} * ${number} / ${groups} - ${first}")
    list(SUBLIST ARGN ${first} ${count} group)
    set(text "")
    foreach(source ${group})
      cmake_path(RELATIVE_PATH source BASE_DIRECTORY "${root}")
      string(APPEND text "#include \"${source}\"\n")
    endforeach()
    set(file "${CMAKE_CURRENT_BINARY_DIR}/together/${name}_${number}.cpp")
    file(CONFIGURE OUTPUT "${file}" CONTENT "${text}" @ONLY)
    list(APPEND files "${file}")
  endforeach()
  set(${variable} ${files} PARENT_SCOPE)
endfunction()

# xr3_precompile(<target> <header>...): with XR3_PRECOMPILE, the target parses these headers once. It saves a third of
# the processor time in protocol and its tests, and nothing in server, whose termios.h breaks pty/pseudo_terminal.
set(XR3_PRECOMPILED <algorithm> <array> <cmath> <functional> <map> <memory> <optional> <string> <string_view>
  <utility> <variant> <vector> <Eigen/Geometry>)
function(xr3_precompile target)
  if(XR3_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${XR3_PRECOMPILED} ${ARGN})
  endif()
endfunction()

# xr3_library(<folder> [<regex>]): the static library xr3_<folder> of every .cpp below the calling folder but
# main.cpp. With XR3_FUZZ also without those that match: no fuzzer uses them, but libFuzzer looks at the counters of
# all linked code after each input. Why the folder is globbed: docs/decisions/0006-globbed-folders.md.
function(xr3_library folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  if(XR3_FUZZ AND ARGN)
    list(FILTER sources EXCLUDE REGEX "${ARGN}")
  endif()
  xr3_together(sources ${folder} ${sources})
  add_library(xr3_${folder} STATIC ${sources})
endfunction()
