# xr3_library(<folder>): the static library xr3_<folder> of every .cpp below the calling folder but
# main.cpp. Why the folder is globbed: docs/decisions/0006-globbed-folders.md.
function(xr3_library folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  add_library(xr3_${folder} STATIC ${sources})
endfunction()
