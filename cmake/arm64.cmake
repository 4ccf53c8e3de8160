# Builds for arm64 (Raspberry Pi, Jetson) with Debian's cross compiler, on libraries of scripts/setup --with arm64.

set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
# Never this machine's own libraries.
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig)
# Tests, and the lists of them that CMake asks test programs for.
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64)
# As dpkg calls it (CPack otherwise takes this machine's).
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)
