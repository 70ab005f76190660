# xr3_add_suites(TARGET PREFIX FOLDER SECONDS): for each suite of a GoogleTest executable one test of ctest, named
# PREFIX.SUITE, that runs in FOLDER for at most SECONDS. (gtest_discover_tests() makes one for each case: starting a
# process with sanitizers takes longer than most cases run.)
function(xr3_add_suites target prefix folder seconds)
  set(include "${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake")
  file(GENERATE OUTPUT "${include}" CONTENT "
set(program \"$<TARGET_FILE:${target}>\")
set(prefix \"${prefix}\")
set(folder \"${folder}\")
set(seconds ${seconds})
include(\"${PROJECT_SOURCE_DIR}/cmake/SuitesOf.cmake\")
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${include}")
endfunction()
