# find_package(emmy [COMPONENTS static|shared]) gives the target emmy::emmy.
#
# Without a component: the shared library if BUILD_SHARED_LIBS is on, else the
# static one.
include(CMakeFindDependencyMacro)
list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")
find_dependency(Eigen3 3.4)
find_dependency(absl)
find_dependency(CHOLMOD)
find_dependency(hwy)
find_dependency(Threads)
list(REMOVE_ITEM CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")

include("${CMAKE_CURRENT_LIST_DIR}/emmyTargets.cmake")

set(_emmy_kind "${emmy_FIND_COMPONENTS}")
if(NOT _emmy_kind)
  if(BUILD_SHARED_LIBS)
    set(_emmy_kind shared)
  else()
    set(_emmy_kind static)
  endif()
endif()
if(NOT TARGET "emmy::emmy_${_emmy_kind}")
  set(emmy_FOUND FALSE)
  set(emmy_NOT_FOUND_MESSAGE
    "\"${_emmy_kind}\" is not one of the components: static or shared")
elseif(NOT TARGET emmy::emmy)
  add_library(emmy::emmy ALIAS "emmy::emmy_${_emmy_kind}")
endif()
unset(_emmy_kind)
