# Usage: nao_embed_texts(TARGET NAME VARIABLE FILES...)
# Data of the program itself: the header NAME, for the sources of TARGET, has the texts of the files as nao::VARIABLE, by
# their names without ending.
function(nao_embed_texts target name variable)
  set(texts)
  foreach(file IN LISTS ARGN)
    file(READ ${file} text)
    get_filename_component(key ${file} NAME_WE)
    string(APPEND texts "    {\"${key}\", R\"~(${text})~\"},\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endforeach()
  string(CONCAT header "#pragma once\n\n#include <map>\n#include <string_view>\n\nnamespace nao {\n"
         "inline const std::map<std::string_view, std::string_view> ${variable}{\n${texts}};\n}\n")
  file(CONFIGURE OUTPUT generated/${name} CONTENT "\@header\@" @ONLY)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/generated)
endfunction()
