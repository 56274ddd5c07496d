# How Eigen lays out vectors and takes memory with the flags in use, which
# whoever includes Emmy's headers has to agree with (emmy/base/types.h).
#
# EMMY_EIGEN_DEFINITIONS are the macros of that header that are other than its
# defaults, as they are with -mavx or g++'s -fsanitize=address. They belong to
# emmy's interface: whoever links to it is held to what it was built with.

# Compiles a file that holds the three numbers as text, instead of running a
# program: this works for another processor, too.
function(_emmy_find_eigen_layout result)
  # What holds in this folder and its parents, by add_compile_options.
  get_directory_property(options COMPILE_OPTIONS)
  get_directory_property(definitions COMPILE_DEFINITIONS)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  string(CONCAT key "${CMAKE_CXX_COMPILER};${CMAKE_CXX_FLAGS};"
    "${CMAKE_CXX_FLAGS_${type}};${options};${definitions};${Eigen3_DIR}")
  if(NOT "${EMMY_EIGEN_LAYOUT_KEY}" STREQUAL key)
    add_library(_emmy_flags_in_use INTERFACE IMPORTED)
    # Text cannot be read from what only the linker compiles.
    target_compile_options(_emmy_flags_in_use INTERFACE
      ${options} -fno-lto -w)
    target_compile_definitions(_emmy_flags_in_use INTERFACE ${definitions})
    set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
    set(CMAKE_TRY_COMPILE_CONFIGURATION "${CMAKE_BUILD_TYPE}")
    set(compiled "${PROJECT_BINARY_DIR}/CMakeFiles/eigen_layout.bin")
    try_compile(succeeded SOURCE_FROM_CONTENT eigen_layout.cc
"#include <Eigen/Core>
#define TEXT(x) #x
#define TEXT_OF(x) TEXT(x)
extern const char eigen_layout[];
const char eigen_layout[] = \"eigen_layout \" TEXT_OF(EIGEN_DEFAULT_ALIGN_BYTES)
    \" \" TEXT_OF(EIGEN_MAX_STATIC_ALIGN_BYTES)
    \" \" TEXT_OF(EIGEN_MALLOC_ALREADY_ALIGNED) \" end\";
"
      LINK_LIBRARIES Eigen3::Eigen _emmy_flags_in_use
      CXX_STANDARD 20
      CXX_STANDARD_REQUIRED ON
      OUTPUT_VARIABLE output
      COPY_FILE "${compiled}")
    if(NOT succeeded)
      message(FATAL_ERROR "A file that includes Eigen does not compile:\n${output}")
    endif()
    file(STRINGS "${compiled}" text
      REGEX "eigen_layout [0-9]+ [0-9]+ [0-9]+ end" LIMIT_COUNT 1)
    if(NOT text MATCHES "eigen_layout ([0-9]+) ([0-9]+) ([0-9]+) end")
      message(FATAL_ERROR "${compiled} does not say how Eigen aligns memory")
    endif()
    set(layout ${CMAKE_MATCH_1} ${CMAKE_MATCH_2} ${CMAKE_MATCH_3})
    set(EMMY_EIGEN_LAYOUT "${layout}" CACHE INTERNAL
      "Eigen's alignment of memory, of members, and whether malloc gives it")
    set(EMMY_EIGEN_LAYOUT_KEY "${key}" CACHE INTERNAL
      "What EMMY_EIGEN_LAYOUT holds for")
  endif()
  set(${result} "${EMMY_EIGEN_LAYOUT}" PARENT_SCOPE)
endfunction()

_emmy_find_eigen_layout(_emmy_layout)
set(_emmy_names EMMY_EIGEN_ALIGN_BYTES EMMY_EIGEN_STATIC_ALIGN_BYTES
  EMMY_EIGEN_PLAIN_MALLOC)
set(_emmy_defaults 16 16 1)
set(EMMY_EIGEN_DEFINITIONS "")
foreach(_emmy_name _emmy_value _emmy_default IN ZIP_LISTS
    _emmy_names _emmy_layout _emmy_defaults)
  if(NOT _emmy_value EQUAL _emmy_default)
    list(APPEND EMMY_EIGEN_DEFINITIONS "${_emmy_name}=${_emmy_value}")
  endif()
endforeach()
