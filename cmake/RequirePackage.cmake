# Finding what the build needs, with an error that says how to get it.
#
#   emmy_require_package(<name> DEBIAN <package>... [VERSION <v>]
#                        [ARGS <find_package arguments>...] [TARGETS <t>...])
#
# Looks for one dependency. Nothing is reported yet, so that one run of CMake
# names everything that is missing and not only the first.
#
#   emmy_report_missing_packages()
#
# Stops with the whole list and one line that installs it.

set(_emmy_package_list "${CMAKE_CURRENT_LIST_DIR}/../tools/lib/packages.txt")

# What `package` is for, as tools/lib/packages.txt says it.
function(_emmy_package_purpose package result)
  file(STRINGS "${_emmy_package_list}" lines REGEX "^[a-z]+ +[^ ]+ +")
  foreach(line IN LISTS lines)
    if(line MATCHES "^[a-z]+ +([^ ]+) +(.+)$" AND CMAKE_MATCH_1 STREQUAL package)
      set(${result} "${CMAKE_MATCH_2}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "${package} is not listed in tools/lib/packages.txt")
endfunction()

function(emmy_require_package name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "VERSION" "DEBIAN;ARGS;TARGETS")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_DEBIAN)
    message(FATAL_ERROR "emmy_require_package(${name}): wrong arguments")
  endif()
  list(GET arg_DEBIAN 0 first_package)
  _emmy_package_purpose(${first_package} purpose)

  find_package(${name} ${arg_VERSION} QUIET ${arg_ARGS})
  set(missing FALSE)
  if(NOT ${name}_FOUND)
    set(missing TRUE)
  endif()
  foreach(target IN LISTS arg_TARGETS)
    if(NOT TARGET ${target})
      set(missing TRUE)
    endif()
  endforeach()
  if(missing)
    set_property(GLOBAL APPEND_STRING PROPERTY EMMY_MISSING_TEXT
      "  ${name} ${arg_VERSION} - needed for: ${purpose}; Debian: ${arg_DEBIAN}\n")
    set_property(GLOBAL APPEND PROPERTY EMMY_MISSING_DEBIAN ${arg_DEBIAN})
  endif()
endfunction()

function(emmy_report_missing_packages)
  get_property(text GLOBAL PROPERTY EMMY_MISSING_TEXT)
  if(NOT text)
    return()
  endif()
  get_property(packages GLOBAL PROPERTY EMMY_MISSING_DEBIAN)
  list(REMOVE_DUPLICATES packages)
  list(JOIN packages " " packages)
  # A leading blank on each line keeps CMake from rewrapping the command.
  message(FATAL_ERROR
    "Emmy cannot be built, this is missing:\n${text}"
    "On Debian and Ubuntu:\n"
    "  apt-get install -y --no-install-recommends ${packages}\n")
endfunction()
