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
