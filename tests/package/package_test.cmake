# Run with -P; the arguments are in CMakeLists.txt beside this file.
file(REMOVE_RECURSE "${SCRATCH}")

function(run)
  execute_process(COMMAND ${ARGN}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGN}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(configure "${CMAKE_COMMAND}" -S "${SOURCE}/tests/package/consumer"
  -B "${SCRATCH}/build" -G Ninja "-DCMAKE_CXX_COMPILER=${COMPILER}"
  "-DCMAKE_CXX_FLAGS=${FLAGS}")

if(WAY STREQUAL installed)
  run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${SCRATCH}/prefix")
  run(${configure} "-DCMAKE_PREFIX_PATH=${SCRATCH}/prefix")
  run("${CMAKE_COMMAND}" --build "${SCRATCH}/build")
  run("${SCRATCH}/build/consumer")
  if(NOT output MATCHES "^emmy [0-9]+\\.[0-9]+\\.[0-9]+\n$")
    message(FATAL_ERROR "the consumer prints: ${output}")
  endif()
else()
  # Configuring is enough: what is built is the same. A subfolder must not ask
  # for what only tests and verification need, nor define their targets.
  run(${configure} "-DEMMY_SUBFOLDER=${SOURCE}"
    -DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON
    -DCMAKE_DISABLE_FIND_PACKAGE_CLI11=ON
    -DCMAKE_DISABLE_FIND_PACKAGE_Boost=ON
    -DCMAKE_DISABLE_FIND_PACKAGE_benchmark=ON)
  run("${CMAKE_COMMAND}" --build "${SCRATCH}/build" --target help)
  if(output MATCHES "emmy_verification|emmy_base_test|emmy_program")
    message(FATAL_ERROR "a subfolder builds more than the library: ${CMAKE_MATCH_0}")
  endif()
endif()
file(REMOVE_RECURSE "${SCRATCH}")
