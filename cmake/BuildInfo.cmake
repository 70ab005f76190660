# Writes build_info.cpp, which names the commit and the compiler. Runs at every build, and changes the
# file only if its text changes: cmake -D SOURCE=… -D OUTPUT=… -D COMPILER=… -P BuildInfo.cmake
#
# The commit is the last one that changed the program; `+` says that the files differ from it. Thus a
# commit that changes only docs or tests does not link the program again. XR3_COMMIT, in the environment,
# is for a build without the repository. An archive of git has the commit in cmake/commit.txt.
set(parts core protocol cell service tools wasm server cli data cmake clients/web CMakeLists.txt CMakePresets.json)

set(commit "$ENV{XR3_COMMIT}")
if(NOT commit AND EXISTS "${SOURCE}/.git")
  execute_process(COMMAND git -C "${SOURCE}" log -1 --abbrev=12 --format=%h -- ${parts}
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND git -C "${SOURCE}" --no-optional-locks diff --quiet HEAD -- ${parts}
    RESULT_VARIABLE differs OUTPUT_QUIET ERROR_QUIET)
  if(commit AND differs)
    string(APPEND commit "+")
  endif()
endif()
if(NOT commit)
  file(READ "${SOURCE}/cmake/commit.txt" commit)
  string(STRIP "${commit}" commit)
endif()
if(NOT commit MATCHES "^[0-9a-f]+[+]?$")
  set(commit unknown)
endif()

set(text "#include \"cli/build_info.hpp\"

namespace xr3 {
const char* const kBuildInfo = \" (commit ${commit}, ${COMPILER})\";
}  // namespace xr3
")
set(old "")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" old)
endif()
if(NOT old STREQUAL text)
  file(WRITE "${OUTPUT}" "${text}")
endif()
