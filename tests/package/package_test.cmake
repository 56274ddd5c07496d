# Run with -P; the arguments are in CMakeLists.txt beside this file.
file(REMOVE_RECURSE "${SCRATCH}")
file(MAKE_DIRECTORY "${SCRATCH}")
set(prefix "${SCRATCH}/prefix")
string(REGEX MATCH "^[0-9]+\\.[0-9]+" series "${VERSION}")
set(case "${SOURCE}/examples/paper_box.json")

function(run)
  execute_process(COMMAND ${ARGN}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGN}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# The command must fail, and say `text`.
function(expect_failure text)
  execute_process(COMMAND ${ARGN}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(FIND "${output}" "${text}" place)
  if(status EQUAL 0 OR place EQUAL -1)
    message(FATAL_ERROR
      "expected the error \"${text}\", status ${status}: ${ARGN}\n${output}")
  endif()
endfunction()

function(run_program)
  run(${ARGN})
  string(FIND "${output}" "emmy ${VERSION}\n" place)
  if(NOT place EQUAL 0)
    message(FATAL_ERROR "${ARGN} prints: ${output}")
  endif()
endfunction()

# The installed files may not refer to where they were made.
function(check_installed_files)
  file(GLOB_RECURSE found "${prefix}/lib*/*")
  list(FILTER found INCLUDE REGEX "/(emmy.pc|emmy[A-Za-z-]*\\.cmake)$")
  list(LENGTH found count)
  if(count LESS 5)
    message(FATAL_ERROR "expected five files for CMake and pkg-config: ${found}")
  endif()
  foreach(file IN LISTS found)
    file(READ "${file}" text)
    foreach(folder IN ITEMS "${SOURCE}" "${BUILD}" "${prefix}")
      string(FIND "${text}" "${folder}/" place)
      if(NOT place EQUAL -1)
        message(FATAL_ERROR "${file} refers to ${folder}")
      endif()
    endforeach()
  endforeach()
endfunction()

# Nor may the programs; what debuggers and sanitizers are told is not meant.
function(check_installed_programs)
  if(NOT TYPE STREQUAL "Release" OR FLAGS MATCHES "-g|-fsanitize")
    return()
  endif()
  file(GLOB found "${prefix}/bin/emmy" "${prefix}/lib*/libemmy.*"
    "${prefix}/lib*/*/libemmy.*")
  foreach(file IN LISTS found)
    foreach(folder IN ITEMS lib verification tools)
      execute_process(COMMAND grep -aoF "${SOURCE}/${folder}/" "${file}"
        OUTPUT_VARIABLE output)
      if(output)
        message(FATAL_ERROR "${file} names files in ${SOURCE}/${folder}")
      endif()
    endforeach()
  endforeach()
endfunction()

set(configure "${CMAKE_COMMAND}" -S "${SOURCE}/tests/package/consumer"
  -B "${SCRATCH}/build" -G Ninja "-DCMAKE_CXX_COMPILER=${COMPILER}"
  "-DCMAKE_CXX_FLAGS=${FLAGS}")
# Flags with which Eigen aligns vectors otherwise than by default.
set(other_alignment "")
if(PROCESSOR MATCHES "^(x86_64|AMD64)$" AND NOT EIGEN_DEFINITIONS)
  set(other_alignment -mavx2)
endif()
# A subfolder must not ask for what only tests and verification need.
set(subfolder_arguments
  -DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_CLI11=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_Boost=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_benchmark=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_Python=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_pybind11=ON)

if(WAY MATCHES "^(static|shared)$")
  run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${prefix}")
  check_installed_files()
  check_installed_programs()
  foreach(file IN ITEMS bin/emmy share/emmy/case.schema.json include/emmy/emmy.h
      share/doc/emmy/LICENSE)
    if(NOT EXISTS "${prefix}/${file}")
      message(FATAL_ERROR "${file} is not installed")
    endif()
  endforeach()
  run_program("${prefix}/bin/emmy" --version)
  # Files that were moved after installation still work.
  file(RENAME "${prefix}" "${SCRATCH}/moved")
  run(${configure} "-DCMAKE_PREFIX_PATH=${SCRATCH}/moved" "-DEMMY_KIND=${WAY}"
    "-DEMMY_VERSION=${series}")
  run("${CMAKE_COMMAND}" --build "${SCRATCH}/build")
  run_program("${SCRATCH}/build/consumer" "${case}")
  run(ldd "${SCRATCH}/build/consumer")
  if(WAY STREQUAL shared AND NOT output MATCHES "${SCRATCH}/moved/[^ ]*libemmy\\.so")
    message(FATAL_ERROR "the consumer is not linked to the shared library: ${output}")
  elseif(WAY STREQUAL static AND output MATCHES "libemmy")
    message(FATAL_ERROR "the consumer is not linked to the static library: ${output}")
  endif()
  # A program that Eigen gives another layout of vectors is refused.
  if(other_alignment)
    run(${configure} "-DEMMY_PARENT_OPTIONS=${other_alignment}")
    expect_failure("Eigen aligns vectors otherwise here than in the library Emmy"
      "${CMAKE_COMMAND}" --build "${SCRATCH}/build")
    run(${configure}
      -DEMMY_PARENT_OPTIONS=-DEIGEN_MALLOC_ALREADY_ALIGNED=0)
    expect_failure("Eigen takes memory otherwise here than in the library Emmy"
      "${CMAKE_COMMAND}" --build "${SCRATCH}/build")
  endif()
elseif(WAY STREQUAL pkg_config)
  find_program(pkg_config NAMES pkg-config pkgconf REQUIRED)
  run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${prefix}"
    --component development)
  run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${prefix}"
    --component library)
  file(GLOB_RECURSE pc "${prefix}/*/emmy.pc")
  get_filename_component(folder "${pc}" DIRECTORY)
  set(ENV{PKG_CONFIG_PATH} "${folder}")
  run("${pkg_config}" --cflags --libs emmy)
  string(STRIP "${output}" options)
  separate_arguments(options UNIX_COMMAND "${options} ${FLAGS}")
  get_filename_component(library "${folder}" DIRECTORY)
  run("${COMPILER}" -std=c++20 "${SOURCE}/tests/package/consumer/consumer.cc"
    ${options} "-Wl,-rpath,${library}" -o "${SCRATCH}/consumer")
  run_program("${SCRATCH}/consumer" "${case}")
  run("${pkg_config}" --exists --print-errors "emmy = ${VERSION}")
elseif(WAY STREQUAL debian)
  run(bash "${SOURCE}/tests/package/debian_test" "${BUILD}" "${SCRATCH}"
    "${case}" "${series}")
elseif(WAY STREQUAL cloned)
  # What is committed, and nothing else, built and run; by a parent that joins
  # its own sources.
  set(ENV{GIT_CONFIG_COUNT} 1)  # Whoever the folder belongs to.
  set(ENV{GIT_CONFIG_KEY_0} safe.directory)
  set(ENV{GIT_CONFIG_VALUE_0} *)
  run(git -C "${SOURCE}" rev-parse HEAD)
  string(STRIP "${output}" commit)
  run(${configure} ${subfolder_arguments} "-DCMAKE_BUILD_TYPE=${TYPE}"
    "-DEMMY_CLONED=file://${SOURCE}" "-DEMMY_COMMIT=${commit}"
    -DCMAKE_UNITY_BUILD=ON)
  run("${CMAKE_COMMAND}" --build "${SCRATCH}/build" --target consumer)
  run_program("${SCRATCH}/build/consumer" "${case}")
else()  # subfolder, fetched
  # Configuring is nearly enough: what is built is the same.
  if(WAY STREQUAL subfolder)
    set(folder emmy)
    list(APPEND configure "-DEMMY_SUBFOLDER=${SOURCE}")
    # A parent's flags may not change values in the library.
    expect_failure("COMPILE_OPTIONS contains -ffast-math"
      ${configure} ${subfolder_arguments} -DEMMY_PARENT_OPTIONS=-ffast-math)
    run(${configure} ${subfolder_arguments}
      "-DEMMY_PARENT_OPTIONS=$<$<COMPILE_LANGUAGE:CXX>:-ffast-math>")
    expect_failure("Emmy is compiled without -ffast-math"
      ninja -C "${SCRATCH}/build"
      emmy/lib/emmy/CMakeFiles/emmy.dir/base/build_info.cc.o)
    run(${configure} ${subfolder_arguments} -DEMMY_PARENT_OPTIONS=)
  else()
    set(folder _deps/emmy-build)
    list(APPEND configure "-DEMMY_FETCHED=${SOURCE}"
      -DFETCHCONTENT_FULLY_DISCONNECTED=ON)
  endif()
  run(${configure} ${subfolder_arguments})
  run("${CMAKE_COMMAND}" --build "${SCRATCH}/build" --target help)
  if(output MATCHES "emmy_verification|emmy_base_test|emmy_program|emmy_python|emmy_example")
    message(FATAL_ERROR "a subfolder builds more than the library: ${CMAKE_MATCH_0}")
  endif()
  # Nor is the shared library made for who asks for the static one; with
  # BUILD_SHARED_LIBS it is the one that is linked to.
  run(ninja -C "${SCRATCH}/build" -n consumer)
  if(output MATCHES "libemmy\\.so" OR NOT output MATCHES "libemmy\\.a")
    message(FATAL_ERROR "expected the static library:\n${output}")
  endif()
  run(${configure} ${subfolder_arguments} -DBUILD_SHARED_LIBS=ON)
  run(ninja -C "${SCRATCH}/build" -n consumer)
  if(NOT output MATCHES "libemmy\\.so")
    message(FATAL_ERROR "expected the shared library:\n${output}")
  endif()
  # Nothing of it is installed with its parent, unless that asks for it; then a
  # library that needs it can be exported.
  file(GLOB_RECURSE found "${SCRATCH}/build/*/emmyConfigVersion.cmake")
  if(found)
    message(FATAL_ERROR "a subfolder is installed unasked: ${found}")
  endif()
  run(${configure} ${subfolder_arguments} -DEMMY_INSTALL=ON)
  foreach(file IN ITEMS cmake_install.cmake ${folder}/cmake_install.cmake)
    file(READ "${SCRATCH}/build/${file}" text)
    string(APPEND installed "${text}")
  endforeach()
  foreach(file IN ITEMS libemmy.so libemmy.a emmyTargets.cmake emmyConfig.cmake)
    if(NOT installed MATCHES "/${file}\"")
      message(FATAL_ERROR "with EMMY_INSTALL ${file} is not installed")
    endif()
  endforeach()
  # Folders may be absolute, each by itself.
  function(expect_in_pc expected)
    run(${configure} ${subfolder_arguments} ${ARGN})
    file(READ "${SCRATCH}/build/${folder}/emmy.pc" text)
    if(NOT text MATCHES "${expected}")
      message(FATAL_ERROR "emmy.pc with ${ARGN}: ${text}")
    endif()
  endfunction()
  expect_in_pc(
    "^prefix=/opt/p\nlibdir=/opt/x/lib\nincludedir=\\\${prefix}/include\n"
    -DCMAKE_INSTALL_PREFIX=/opt/p -DCMAKE_INSTALL_LIBDIR=/opt/x/lib)
  expect_in_pc("libdir=\\\${prefix}/lib/here\nincludedir=/opt/x/include\n"
    -DCMAKE_INSTALL_LIBDIR=lib/here -DCMAKE_INSTALL_INCLUDEDIR=/opt/x/include)
  run(${configure} ${subfolder_arguments} -DEMMY_INSTALL=OFF)
  # Both are built with the parent's flags, and so agree.
  if(other_alignment)
    run(${configure} ${subfolder_arguments}
      -DEMMY_PARENT_OPTIONS=-march=sapphirerapids)
    run(ninja -C "${SCRATCH}/build" CMakeFiles/consumer.dir/consumer.cc.o
      ${folder}/lib/emmy/CMakeFiles/emmy.dir/numerics/panel_product.cc.o)
  endif()
endif()
file(REMOVE_RECURSE "${SCRATCH}")
