# Precompiled headers: one for programs and libraries, one for tests. Every source reads the same
# standard, Eigen and GoogleTest headers, which cost more than most of the sources themselves.

function(nao_add_precompiled name header)
  add_library(${name} STATIC ${CMAKE_SOURCE_DIR}/cmake/precompiled/empty.cpp)
  target_precompile_headers(${name} PRIVATE ${header})
  target_link_libraries(${name} PRIVATE Eigen3::Eigen ${ARGN})
  if(CCACHE_PROGRAM AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(sum ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${name}.dir/cmake_pch.hxx.gch.sum)
    add_custom_command(TARGET ${name} POST_BUILD
      COMMAND ${CMAKE_SOURCE_DIR}/cmake/precompiled/identify.sh ${sum} VERBATIM)
  endif()
endfunction()

# Lets every target that compiles the same C++ read them.
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
    if(libraries MATCHES "GTest::")
      target_precompile_headers(${target} REUSE_FROM nao_precompiled_test)
    else()
      target_precompile_headers(${target} REUSE_FROM nao_precompiled)
    endif()
  endforeach()
endfunction()

nao_add_precompiled(nao_precompiled ${CMAKE_SOURCE_DIR}/cmake/precompiled/standard.h)
if(GTest_FOUND)
  nao_add_precompiled(nao_precompiled_test ${CMAKE_SOURCE_DIR}/cmake/precompiled/test.h GTest::gmock)
endif()
nao_use_precompiled()
