# emmy_arithmetic: what keeps floating point reproducible. Linked PUBLIC.
#
# Compilers may contract a*b + c into one fused operation when the target has
# it. The result is closer to the exact one but a different number, chosen
# expression by expression: compensated summation and the exact strain
# increment rely on the rounding that is written, and reference data must not
# depend on the processor. The flag is part of emmy's interface because the
# headers hold inline code: compiled without it elsewhere, the linker may keep
# that copy and silently change the library too.
#
# On 64-bit Arm, Eigen asks for fused operations by name, which that flag does
# not undo; it does so where a macro of the compiler says that they exist.
set(EMMY_ARITHMETIC_FLAGS -ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  list(APPEND EMMY_ARITHMETIC_FLAGS -U__ARM_FEATURE_FMA)
endif()
add_library(emmy_arithmetic INTERFACE)
target_compile_options(emmy_arithmetic INTERFACE ${EMMY_ARITHMETIC_FLAGS})
list(JOIN EMMY_ARITHMETIC_FLAGS " " EMMY_ARITHMETIC_FLAGS)

# Value-changing optimisations remove the compensation altogether. Options
# of a parent that hold in some cases only are left to lib/emmy/base/build_info.cc.
string(TOUPPER "${CMAKE_BUILD_TYPE}" _emmy_build_type)
get_directory_property(COMPILE_OPTIONS COMPILE_OPTIONS)
list(FILTER COMPILE_OPTIONS EXCLUDE REGEX "[$]<")
foreach(_emmy_flags IN ITEMS
    CMAKE_CXX_FLAGS CMAKE_CXX_FLAGS_${_emmy_build_type} COMPILE_OPTIONS)
  if("${${_emmy_flags}}" MATCHES
      "-Ofast|-ffast-math|-funsafe-math-optimizations|-fassociative-math|-freciprocal-math|-ffinite-math-only|-ffp-model=fast")
    message(FATAL_ERROR
      "${_emmy_flags} contains ${CMAKE_MATCH_0}: Emmy's conservation laws hold "
      "to round-off only if the compiler keeps floating-point semantics.")
  endif()
endforeach()

# emmy_optimized: for the library and what its speed is compared with. g++ 12
# inlines small fixed-size products only at -O3; a step of one body then takes
# two thirds of the time. No number changes. Linked PRIVATE.
add_library(emmy_optimized INTERFACE)
target_compile_options(emmy_optimized INTERFACE
  $<$<CONFIG:Release>:-O3>)

# emmy_lanes: for files that include Highway, linked PRIVATE. On 64-bit Arm only
# Neon, which all have: vectors of a length unknown to the compiler (SVE) cannot
# be members of a struct. Highway compiles its functions for the encryption
# extension too, by a pragma that g++ does not apply to constructors it writes
# itself; they could not inline those functions. No arithmetic uses it.
add_library(emmy_lanes INTERFACE)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  target_compile_definitions(emmy_lanes INTERFACE HWY_COMPILE_ONLY_STATIC)
  target_compile_options(emmy_lanes INTERFACE
    $<$<CXX_COMPILER_ID:GNU>:-march=armv8-a+crypto>)
endif()

# emmy_file_names: for what is installed or packed, linked PRIVATE. A failed
# EMMY_CHECK names its file from the project's folder on, so that a program does
# not show where it was built and is the same from any folder.
add_library(emmy_file_names INTERFACE)
target_compile_options(emmy_file_names INTERFACE
  "-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=")

# emmy_warnings: for our own files only, linked PRIVATE.
add_library(emmy_warnings INTERFACE)
target_compile_options(emmy_warnings INTERFACE
  -Wall -Wextra -Wpedantic
  -Wshadow -Wconversion -Wsign-conversion -Wdouble-promotion
  -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-qual -Wold-style-cast
  -Wformat=2 -Wimplicit-fallthrough -Wextra-semi -Wvla
  $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond -Wduplicated-branches -Wlogical-op>
  # These three depend on what the optimiser happens to see; g++ 12 reports
  # them inside fixed-size Eigen code that is correct.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow>
  $<$<BOOL:${EMMY_WARNINGS_AS_ERRORS}>:-Werror>)
