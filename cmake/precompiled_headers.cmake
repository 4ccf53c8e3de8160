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
nao_add_precompiled(nao_precompiled_light standard.h OPTIONS ${NAO_LIGHT_OPTIONS})
if(GTest_FOUND)
  set(test_options ${NAO_LIGHT_OPTIONS})
  if(NAO_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Use of a test's own variables after their scope is not checked, which takes a tenth of the compiler's time; that
    # of the libraries' is.
    list(APPEND test_options -fno-sanitize-address-use-after-scope)
  endif()
  nao_add_precompiled(nao_precompiled_test test.h LIBRARIES GTest::gmock OPTIONS ${test_options})
endif()
if(TARGET nao_phone_protocol)
  nao_add_precompiled(nao_precompiled_protocol protocol.h
    LIBRARIES nao_phone_protocol OPTIONS ${NAO_GATEWAY_OPTIONS}
    IDENTIFIED_BY ${CMAKE_SOURCE_DIR}/phone-gateway/protocol/remote.proto)
endif()
nao_use_precompiled()
