# find_package(emmy) gives the target emmy::emmy.
include(CMakeFindDependencyMacro)
list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")
find_dependency(Eigen3 3.4)
find_dependency(absl)
find_dependency(CHOLMOD)
find_dependency(hwy)
list(REMOVE_ITEM CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")

include("${CMAKE_CURRENT_LIST_DIR}/emmyTargets.cmake")
