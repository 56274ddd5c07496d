include(GoogleTest)

# GoogleTest and Eigen take three seconds to read; compiled once, they cost
# each test file one. Off, a test that forgets an #include is found.
option(EMMY_PRECOMPILE_TEST_HEADERS "Read the headers of the tests once" ON)

# What every test is built with; the precompiled headers have to agree.
function(_emmy_set_up_test target)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${target} PRIVATE
    emmy emmy_warnings nlohmann_json::nlohmann_json GTest::gmock_main)
  # -Wextra asks to name every field of a designated initialiser; a test that
  # sets only the field it is about is clearer.
  target_compile_options(${target} PRIVATE -Wno-missing-field-initializers)
  target_compile_definitions(${target} PRIVATE
    EMMY_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    EMMY_PROGRAM="${PROJECT_BINARY_DIR}/bin/emmy")
endfunction()

if(EMMY_PRECOMPILE_TEST_HEADERS)
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/test_headers.cc" CONTENT "")
  add_library(emmy_test_headers OBJECT "${PROJECT_BINARY_DIR}/test_headers.cc")
  _emmy_set_up_test(emmy_test_headers)
  target_precompile_headers(emmy_test_headers PRIVATE
    <gmock/gmock.h> <gtest/gtest.h> <Eigen/Dense>)
endif()

# emmy_add_test(<name> <source>... [LABELS <label>...] [LIBRARIES <target>...]
#               [TIMEOUT <seconds>] [ARGUMENTS <argument>...]
#               [SEPARATE <source>...]
#               [WITHOUT_VERIFICATION | LIBRARY_ONLY])
#
# One GoogleTest program from all tests of one folder, because linking costs
# more than compiling a further file. Without sources nothing is built, so a
# folder may be added before its first test. `ctest -N` lists each test as
# <name without emmy_ and _test>/<Suite>.<Test>; ctest -L selects by label.
#
# WITHOUT_VERIFICATION: the test is not linked to emmy_verification, which then
# need not be built: half of the time where every line is instrumented, or
# where another compiler runs only this test.
#
# LIBRARY_ONLY: likewise, and the test is of lib alone. emmy_library_tests builds
# all of these, `ctest -L library` runs them.
#
# SEPARATE: sources that give a helper the name of another file's, and so are
# compiled on their own where CMAKE_UNITY_BUILD joins the others.
add_custom_target(emmy_library_tests)
function(emmy_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "LIBRARY_ONLY;WITHOUT_VERIFICATION"
    "TIMEOUT" "LABELS;LIBRARIES;ARGUMENTS;SEPARATE")
  list(APPEND arg_UNPARSED_ARGUMENTS ${arg_SEPARATE})
  if(NOT arg_UNPARSED_ARGUMENTS)
    return()
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  string(REGEX REPLACE "^emmy_(.*)_test$" "\\1" folder "${name}")
  list(APPEND arg_LABELS ${folder})
  if(arg_LIBRARY_ONLY)
    list(APPEND arg_LABELS library)
  endif()
  list(REMOVE_DUPLICATES arg_LABELS)

  add_executable(${name} ${arg_UNPARSED_ARGUMENTS})
  set_source_files_properties(${arg_SEPARATE}
    PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  _emmy_set_up_test(${name})
  if(arg_LIBRARY_ONLY)
    add_dependencies(emmy_library_tests ${name})
  elseif(NOT arg_WITHOUT_VERIFICATION)
    list(APPEND arg_LIBRARIES emmy_verification)
  endif()
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES})
  if(EMMY_PRECOMPILE_TEST_HEADERS)
    target_precompile_headers(${name} REUSE_FROM emmy_test_headers)
  endif()
  # Discovered when ctest runs: a build does not start every program.
  gtest_discover_tests(${name}
    TEST_PREFIX "${folder}/"
    DISCOVERY_MODE PRE_TEST
    DISCOVERY_TIMEOUT 60
    NO_PRETTY_VALUES
    EXTRA_ARGS ${arg_ARGUMENTS}
    PROPERTIES TIMEOUT ${arg_TIMEOUT})
  # Separately, since a list among PROPERTIES arrives as its first entry only.
  set(labels_file "${CMAKE_CURRENT_BINARY_DIR}/${name}_labels.cmake")
  file(CONFIGURE OUTPUT "${labels_file}" @ONLY CONTENT
"if(@name@_TESTS)
  set_tests_properties(\${@name@_TESTS} PROPERTIES LABELS \"@arg_LABELS@\")
endif()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${labels_file}")
endfunction()
