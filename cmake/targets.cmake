# Which precompiled headers a target reads, and with them its optimisation level (cmake/precompiled_headers.cmake). A folder
# sets the variable for all targets in it.
define_property(TARGET PROPERTY NAO_PRECOMPILED INITIALIZE_FROM_VARIABLE NAO_PRECOMPILED)

# Sets `result` to the targets of a folder and of all below it.
function(nao_targets_below folder result)
  get_property(found DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  get_property(subfolders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(subfolder IN LISTS subfolders)
    nao_targets_below(${subfolder} below)
    list(APPEND found ${below})
  endforeach()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

# nao_add_program(NAME LIBRARY): a program whose main() only calls LIBRARY, where its options are read.
function(nao_add_program name library)
  add_executable(${name} main.cpp)
  target_link_libraries(${name} PRIVATE ${library})
  set_target_properties(${name} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
  install(TARGETS ${name})
endfunction()

# nao_optimize_targets(TARGET...), nao_optimize_sources(SOURCE...): -O3 where it pays, and not in the sanitizer build. Without
# precompiled headers, from which GCC would take the level.
function(nao_optimize_targets)
  if(NOT NAO_SANITIZE)
    foreach(target IN LISTS ARGN)
      target_compile_options(${target} PRIVATE -O3)
    endforeach()
  endif()
endfunction()
function(nao_optimize_sources)
  if(NOT NAO_SANITIZE)
    set_source_files_properties(${ARGN} PROPERTIES
      COMPILE_OPTIONS -O3 SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()
