# Run by ctest, with the variables that Suites.cmake sets: adds the tests of one executable.
if(NOT EXISTS "${program}")
  add_test("${prefix}_NOT_BUILT" "${program}")
  return()
endif()
execute_process(COMMAND "${program}" --gtest_list_tests WORKING_DIRECTORY "${folder}"
  OUTPUT_VARIABLE listing RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${program} --gtest_list_tests ended with ${result}:\n${listing}")
endif()
# A suite is a line such as "Motor." or "Each/Motor.  # TypeParam = ..."; its cases follow, indented.
string(REGEX MATCHALL "(^|\n)[A-Za-z_][A-Za-z0-9_/]*\\.([ ]+#[^\n]*)?\n  " lines "${listing}")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^\n?([A-Za-z0-9_/]+)\\..*" "\\1" suite "${line}")
  add_test("${prefix}.${suite}" "${program}" "--gtest_filter=${suite}.*" --gtest_brief=1)
  set_tests_properties("${prefix}.${suite}" PROPERTIES
    WORKING_DIRECTORY "${folder}" LABELS unit TIMEOUT ${seconds})
endforeach()
