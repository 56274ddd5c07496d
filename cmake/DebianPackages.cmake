# `cpack` in the build folder: emmy, libemmy with its version in
# the name, and libemmy-dev as .deb files.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME emmy)
set(CPACK_PACKAGE_VENDOR Emmy)
# Who commits to the project; the address receives no mail.
set(CPACK_PACKAGE_CONTACT
  "Seed 34fffed1 maintainers <maintainers@users.noreply.h-seed-34fffed1.example>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_COMPONENTS_ALL program library development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME emmy)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "${PROJECT_DESCRIPTION}\nThe program emmy and the schema of its case files.")

string(REGEX MATCH "^[0-9]+\\.[0-9]+" _emmy_series "${PROJECT_VERSION}")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME "libemmy${_emmy_series}")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA
  "${PROJECT_SOURCE_DIR}/cmake/debian/triggers"
  "${PROJECT_SOURCE_DIR}/cmake/debian/postinst"
  "${PROJECT_SOURCE_DIR}/cmake/debian/postrm")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
  "${PROJECT_DESCRIPTION}\nThe shared library.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libemmy-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# What its headers include, and what the static library is linked with.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libemmy${_emmy_series} (= ${PROJECT_VERSION}-1), libeigen3-dev, libabsl-dev, libsuitesparse-dev, libhwy-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "${PROJECT_DESCRIPTION}\nHeaders, the static library, and files for CMake and pkg-config.")

# Each package has the licence where Debian looks for it; outside packages there
# is one copy, that of the component `licence`.
foreach(_emmy_component IN ITEMS PROGRAM LIBRARY DEVELOPMENT)
  string(TOLOWER "${_emmy_component}" _emmy_component_name)
  install(FILES "${PROJECT_SOURCE_DIR}/cmake/debian/copyright"
    DESTINATION
      "${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${_emmy_component}_PACKAGE_NAME}"
    COMPONENT ${_emmy_component_name} EXCLUDE_FROM_ALL)
endforeach()

set(CPACK_OUTPUT_FILE_PREFIX "${PROJECT_BINARY_DIR}/packages")
include(CPack)
