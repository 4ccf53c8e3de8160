# The YAML and ONNX files of the calling folder are data: a target named like `folder` copies them to where the programs look
# for them, and they are installed.
function(nao_data_files folder)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.yaml
       ${CMAKE_CURRENT_SOURCE_DIR}/*.onnx)
  set(copies)
  foreach(source IN LISTS sources)
    get_filename_component(name ${source} NAME)
    set(copy ${NAO_DATA_DIR}/${folder}/${name})
    add_custom_command(
      OUTPUT ${copy}
      COMMAND ${CMAKE_COMMAND} -E copy ${source} ${copy}
      DEPENDS ${source}
      COMMENT "Copying ${folder}/${name}" VERBATIM)
    list(APPEND copies ${copy})
  endforeach()
  add_custom_target(${folder} ALL DEPENDS ${copies})
  install(FILES ${sources} DESTINATION ${CMAKE_INSTALL_DATADIR}/nao-remote/${folder})
endfunction()
