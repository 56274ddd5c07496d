# `cmake --install`: library, headers, and a package for find_package(emmy).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(_emmy_package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/emmy")
install(TARGETS emmy emmy_arithmetic EXPORT emmyTargets
  INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/lib/emmy"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  FILES_MATCHING PATTERN "*.h")
install(EXPORT emmyTargets NAMESPACE emmy:: DESTINATION "${_emmy_package_folder}")

write_basic_package_version_file("${PROJECT_BINARY_DIR}/emmyConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_SOURCE_DIR}/cmake/emmyConfig.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindCHOLMOD.cmake"
  "${PROJECT_BINARY_DIR}/emmyConfigVersion.cmake"
  DESTINATION "${_emmy_package_folder}")
