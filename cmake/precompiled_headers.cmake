# Precompiled headers. Every source reads the same standard, Eigen and GoogleTest headers, which cost
# more than most of the sources themselves; those of the gateway also protobuf.

# nao_add_precompiled(NAME HEADER [LIBRARIES ...] [OPTIONS ...] [IDENTIFIED_BY FILE...])
# OPTIONS: of the compiler, for whatever reads these headers too; its optimisation level among them, for GCC takes that
# of the precompiled header.
# IDENTIFIED_BY: sources of what the header includes and cmake/precompiled does not hold.
function(nao_add_precompiled name header)
  cmake_parse_arguments(arg "" "" "LIBRARIES;OPTIONS;IDENTIFIED_BY" ${ARGN})
  add_library(${name} STATIC ${CMAKE_SOURCE_DIR}/cmake/precompiled/empty.cpp)
  target_precompile_headers(${name} PRIVATE ${CMAKE_SOURCE_DIR}/cmake/precompiled/${header})
  target_link_libraries(${name} PRIVATE Eigen3::Eigen ${arg_LIBRARIES})
  target_compile_options(${name} PRIVATE ${arg_OPTIONS})
  # Not through ccache: where a precompiled header exists already, it takes that one's sum for the sources.
  set_target_properties(${name} PROPERTIES CXX_COMPILER_LAUNCHER "")
  if(CCACHE_PROGRAM AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Before the header is compiled, and so before anything that uses it.
    set(sum ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${name}.dir/cmake_pch.hxx.gch.sum)
    set(identify ${CMAKE_SOURCE_DIR}/cmake/precompiled/identify.sh)
    file(GLOB headers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/cmake/precompiled/*.h)
    add_custom_command(OUTPUT ${sum}
      COMMAND ${identify} ${sum} ${arg_IDENTIFIED_BY}
      DEPENDS ${identify} ${headers} ${arg_IDENTIFIED_BY} VERBATIM)
    add_custom_target(${name}_sum DEPENDS ${sum})
    add_dependencies(${name} ${name}_sum)
  endif()
endfunction()

# Lets every target that compiles the same C++ read them: those that the target's property
# NAO_PRECOMPILED names (NONE: none), or the one for tests, or the standard one. A target with an optimisation level of its
# own reads none.
function(nao_use_precompiled)
  nao_targets_below(${CMAKE_SOURCE_DIR} targets)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    get_target_property(standard ${target} CXX_STANDARD)
    if(NOT type MATCHES "^(EXECUTABLE|STATIC_LIBRARY|OBJECT_LIBRARY)$" OR NOT standard EQUAL CMAKE_CXX_STANDARD
       OR target MATCHES "^nao_precompiled")
      continue()
    endif()
    get_target_property(libraries ${target} LINK_LIBRARIES)
    get_target_property(precompiled ${target} NAO_PRECOMPILED)
    get_target_property(options ${target} COMPILE_OPTIONS)
    if(precompiled STREQUAL "NONE" OR options MATCHES "(^|;)-O")
      continue()
    elseif(libraries MATCHES "GTest::")
      set(precompiled nao_precompiled_test)
    elseif(NOT precompiled)
      set(precompiled nao_precompiled)
    endif()
    get_target_property(options ${precompiled} COMPILE_OPTIONS)
    if(options)
      target_compile_options(${target} PRIVATE ${options})
    endif()
    target_precompile_headers(${target} REUSE_FROM ${precompiled})
  endforeach()
endfunction()

nao_add_precompiled(nao_precompiled standard.h)

# For what is compiled more often than its speed matters: tests (what they test is in the libraries), and programs that wait
# for people or for the bus, or compute in other libraries. -Og needs 0.7 of the compiler's time for -O2 and 0.8 of that for -O1,
# measured on 14 translation units; -O0 needs more than -Og, and its code is slow. The Debian package is optimised throughout.
# Not for what is linked before physics or motion: of an inline function that both contain the linker keeps the first copy, and
# a sprint of nao-trial took 1.3 times as long.
set(light_options)
if(NOT CMAKE_BUILD_TYPE STREQUAL "Release")
  set(light_options -Og)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 reports values as uninitialized at -Og that are not.
    list(APPEND light_options -Wno-maybe-uninitialized)
  endif()
endif()
nao_add_precompiled(nao_precompiled_light standard.h OPTIONS ${light_options})

if(GTest_FOUND)
  set(test_options ${light_options})
  if(NAO_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Use of a test's own variables after their scope is not checked, which takes a tenth of the compiler's time; that
    # of the libraries' is.
    list(APPEND test_options -fno-sanitize-address-use-after-scope)
  endif()
  nao_add_precompiled(nao_precompiled_test test.h LIBRARIES GTest::gmock OPTIONS ${test_options})
endif()
if(TARGET nao_phone_protocol)
  # The gateway's time goes to system calls: with 32 clients it takes as much with -O1 as with -O2, and the compiler 0.7.
  set(protocol_options)
  if(CMAKE_BUILD_TYPE STREQUAL "RelWithDebInfo")
    set(protocol_options -O1)
  endif()
  nao_add_precompiled(nao_precompiled_protocol protocol.h
    LIBRARIES nao_phone_protocol OPTIONS ${protocol_options}
    IDENTIFIED_BY ${CMAKE_SOURCE_DIR}/phone-gateway/protocol/remote.proto)
endif()
nao_use_precompiled()
