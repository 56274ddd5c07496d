# `cmake --install`: libraries, headers, the program, the schema of case files,
# the licence, a package for find_package(emmy), and emmy.pc for pkg-config.
#
# Components: `program`, `library` (what programs need that are linked to the
# shared library), `development`, `licence`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(_emmy_package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/emmy")
install(TARGETS emmy emmy_shared emmy_arithmetic EXPORT emmyTargets
  ARCHIVE COMPONENT development
  LIBRARY COMPONENT library NAMELINK_COMPONENT development
  INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
# Only io itself includes the headers that show the JSON library.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/lib/emmy"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT development
  FILES_MATCHING PATTERN "*.h"
  PATTERN "json_*.h" EXCLUDE
  PATTERN "case_reader.h" EXCLUDE
  PATTERN "case_keys.h" EXCLUDE)
install(EXPORT emmyTargets NAMESPACE emmy:: COMPONENT development
  DESTINATION "${_emmy_package_folder}")

write_basic_package_version_file("${PROJECT_BINARY_DIR}/emmyConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_SOURCE_DIR}/cmake/emmyConfig.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindCHOLMOD.cmake"
  "${PROJECT_BINARY_DIR}/emmyConfigVersion.cmake"
  DESTINATION "${_emmy_package_folder}" COMPONENT development)

set(_emmy_pc_folder "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
# Relative to where the file is, as far as the folders are relative.
if(IS_ABSOLUTE "${_emmy_pc_folder}")
  set(_emmy_pc_prefix "${CMAKE_INSTALL_PREFIX}")
else()
  file(RELATIVE_PATH _emmy_pc_prefix "/${_emmy_pc_folder}" "/")
  string(REGEX REPLACE "/$" "" _emmy_pc_prefix "\${pcfiledir}/${_emmy_pc_prefix}")
endif()
foreach(_emmy_folder IN ITEMS LIBDIR INCLUDEDIR)
  set(_emmy_pc_${_emmy_folder} "${CMAKE_INSTALL_${_emmy_folder}}")
  if(NOT IS_ABSOLUTE "${_emmy_pc_${_emmy_folder}}")
    string(PREPEND _emmy_pc_${_emmy_folder} "\${prefix}/")
  endif()
endforeach()
list(TRANSFORM EMMY_EIGEN_DEFINITIONS PREPEND " -D"
  OUTPUT_VARIABLE _emmy_pc_definitions)
list(JOIN _emmy_pc_definitions "" _emmy_pc_definitions)
configure_file("${PROJECT_SOURCE_DIR}/cmake/emmy.pc.in"
  "${PROJECT_BINARY_DIR}/emmy.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/emmy.pc"
  DESTINATION "${_emmy_pc_folder}" COMPONENT development)

if(EMMY_BUILD_VERIFICATION)
  install(TARGETS emmy_program RUNTIME COMPONENT program)
endif()
install(FILES "${PROJECT_SOURCE_DIR}/lib/emmy/io/case.schema.json"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/emmy" COMPONENT program)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE"
  DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT licence)
