# What every target is compiled with. Options that only some targets need stay with those targets.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
# Sources of programs as those of libraries: all share their precompiled headers.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_COMPILE_OPTIONS_PIE -fPIC)
add_compile_options(-pthread)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "" FORCE)
endif()

# Never -DNDEBUG: Debian's Simbody is compiled without it, and the layout of SimTK::State differs.
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1")
# Not -Og, which compiles faster: with sanitizers the simulation then takes 1.3 times as long.
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g1")
# Lower levels for some targets, chosen by their precompiled headers (cmake/precompiled_headers.cmake). The Debian package is
# optimised throughout.
set(NAO_LIGHT_OPTIONS)
set(NAO_GATEWAY_OPTIONS)
if(NOT CMAKE_BUILD_TYPE STREQUAL "Release")
  # For what is compiled more often than its speed matters: tests (what they test is in the libraries), and programs that wait
  # for people or for the bus, or compute in other libraries. -Og needs 0.7 of the compiler's time for -O2 and 0.8 of that for
  # -O1, measured on 14 translation units; -O0 needs more than -Og, and its code is slow. Not for what is linked before physics
  # or motion: of an inline function that both contain the linker keeps the first copy, and a sprint of nao-trial took 1.3 times
  # as long.
  set(NAO_LIGHT_OPTIONS -Og)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 reports values as uninitialized at -Og that are not.
    list(APPEND NAO_LIGHT_OPTIONS -Wno-maybe-uninitialized)
  endif()
  # The gateway's time goes to system calls: with 32 clients it takes as much with -O1 as with -O2, and the compiler 0.7.
  set(NAO_GATEWAY_OPTIONS -O1)
endif()
# The same sources give the same bits on every x86-64: no fused multiply-add behind our back.
add_compile_options(-ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Where headers are precompiled, GCC 12 reports the small buffer of std::string as too short.
  add_compile_options(-fpch-preprocess -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  # GCC collects garbage only above 1 GiB of memory: collections took a tenth of its time. The largest source
  # then needs 1.4 GB; scripts/lib.sh allows 1.5 GB for each compiler.
  add_compile_options(--param=ggc-min-heapsize=1048576)
endif()

# Several sources of a library in one translation unit: their common headers are read and their common
# templates compiled once, which halves the compiler's time. clang-tidy and editors read single sources:
# they use a build folder without it.
option(NAO_UNITY_BUILD "Compile up to 32 sources of a library together" ON)
set(CMAKE_UNITY_BUILD ${NAO_UNITY_BUILD})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 32)

# GNU gold, which comes with GNU ld, links these programs in a third of its time.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=gold NAO_HAS_GOLD)
  if(NAO_HAS_GOLD)
    add_link_options(-fuse-ld=gold)
  endif()
endif()

option(NAO_WARNINGS_AS_ERRORS "Treat compiler warnings as errors" OFF)

add_compile_options(-Wall -Wextra -Wpedantic)
if(NAO_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  # What it asks for where headers are precompiled; -fpch-preprocess above is for it too.
  set(CMAKE_CXX_COMPILER_LAUNCHER env
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
    CCACHE_PCH_EXTSUM=1 ${CCACHE_PROGRAM})
endif()
