# What CMake says where it cannot go on: names the dependency, what it is for
# and how to get it; all missing ones at once. Run with -P and
# -DSOURCE=… -DSCRATCH=… -DCOMPILER=….

function(expect_error description)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ARGUMENTS;TEXTS")
  file(REMOVE_RECURSE "${SCRATCH}")
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${SCRATCH}" -G Ninja
      "-DCMAKE_CXX_COMPILER=${COMPILER}" ${arg_ARGUMENTS}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(status EQUAL 0)
    message(SEND_ERROR "${description}: configuring succeeded, expected an error")
  endif()
  # CMake wraps its messages.
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  foreach(text IN LISTS arg_TEXTS)
    string(FIND "${output}" "${text}" position)
    if(position EQUAL -1)
      message(SEND_ERROR "${description}: no \"${text}\" in\n${output}")
    endif()
  endforeach()
  file(REMOVE_RECURSE "${SCRATCH}")
endfunction()

expect_error("one missing dependency"
  ARGUMENTS -DCMAKE_DISABLE_FIND_PACKAGE_CLI11=ON
  TEXTS "CLI11 - needed for: command line of emmy; Debian: libcli11-dev"
        "apt-get install -y --no-install-recommends libcli11-dev")

expect_error("two missing dependencies are named together"
  ARGUMENTS -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON
            -DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON
  TEXTS "Eigen3 3.4 - needed for: matrices and vectors in every layer"
        "apt-get install -y --no-install-recommends libeigen3-dev libgtest-dev libgmock-dev")

expect_error("flags that change values"
  ARGUMENTS -DCMAKE_CXX_FLAGS=-ffast-math
  TEXTS "CMAKE_CXX_FLAGS contains -ffast-math")
