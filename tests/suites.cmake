# Writes a file for ctest with one test for each suite of PROGRAM, called after both: two programs may have suites of one
# name.
get_filename_component(name ${PROGRAM} NAME_WE)
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ";" lines "${listing}")
set(tests "")
foreach(line IN LISTS lines)
  # "Suite." and "Suite.  # what it is about"; its tests are indented.
  if(NOT line MATCHES "^([^ ]+)\\.( |$)")
    continue()
  endif()
  set(suite ${CMAKE_MATCH_1})
  if(suite MATCHES "DISABLED_")
    continue()
  endif()
  string(APPEND tests
    "add_test([==[${name}/${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*]==])\n"
    "set_tests_properties([==[${name}/${suite}]==] PROPERTIES TIMEOUT ${TIMEOUT} FAIL_REGULAR_EXPRESSION \"Running 0 tests\")\n")
endforeach()
file(WRITE ${FILE} "${tests}")
