# The toolchain file of the preset package-arm64: Debian's cross compiler, with the libraries of an arm64
# system in XR3_SYSROOT, which scripts/sysroot makes. QEMU runs the program for its manual pages.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES XR3_SYSROOT)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_OBJDUMP aarch64-linux-gnu-objdump)
set(CMAKE_STRIP aarch64-linux-gnu-strip)
set(CMAKE_SYSROOT "${XR3_SYSROOT}")
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static -L "${XR3_SYSROOT}")
set(ENV{PKG_CONFIG_SYSROOT_DIR} "${XR3_SYSROOT}")
set(ENV{PKG_CONFIG_LIBDIR}
  "${XR3_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${XR3_SYSROOT}/usr/share/pkgconfig")
