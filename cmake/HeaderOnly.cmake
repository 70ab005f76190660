# The header-only libraries for builds for other machines, as imported targets: /usr/include itself belongs to the C
# library of this machine, so links to the folders of the libraries alone go to the build folder.
file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/headers")
foreach(library Eigen3::Eigen:eigen3/Eigen nlohmann_json::nlohmann_json:nlohmann)
  string(REGEX MATCH "(.*):(.*)" unused "${library}")
  set(target "${CMAKE_MATCH_1}")
  set(folder "/usr/include/${CMAKE_MATCH_2}")
  cmake_path(GET folder FILENAME name)
  file(CREATE_LINK "${folder}" "${CMAKE_BINARY_DIR}/headers/${name}" SYMBOLIC)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} INTERFACE "${CMAKE_BINARY_DIR}/headers")
endforeach()
