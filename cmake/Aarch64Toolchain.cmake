# Compiles for 64-bit Arm with Debian's cross compiler, against the packages
# that tools/golden_aarch64 unpacks, and starts programs by qemu-user.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

# The folder that holds usr/include and usr/lib/aarch64-linux-gnu.
set(EMMY_AARCH64_SYSROOT
  "${CMAKE_CURRENT_LIST_DIR}/../build/aarch64_sysroot" CACHE PATH
  "Unpacked arm64 packages")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES EMMY_AARCH64_SYSROOT)
file(REAL_PATH "${EMMY_AARCH64_SYSROOT}" CMAKE_SYSROOT)

# Tools of this machine; headers, libraries and packages of the other.
set(CMAKE_FIND_ROOT_PATH "${CMAKE_SYSROOT}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

set(CMAKE_CROSSCOMPILING_EMULATOR "qemu-aarch64;-L;${CMAKE_SYSROOT}")
