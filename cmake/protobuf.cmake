# Usage: nao_generate_protobuf(NAME)
# C++ of NAME.proto in this folder: ${GENERATED_DIR}/NAME.pb.cc and NAME.pb.h. After find_package(Protobuf).
function(nao_generate_protobuf name)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/generated)
  set(proto ${CMAKE_CURRENT_SOURCE_DIR}/${name}.proto)
  add_custom_command(
    OUTPUT ${folder}/${name}.pb.cc ${folder}/${name}.pb.h
    COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
    COMMAND ${Protobuf_PROTOC_EXECUTABLE} --cpp_out=${folder} --proto_path=${CMAKE_CURRENT_SOURCE_DIR} ${proto}
    DEPENDS ${proto}
    COMMENT "Generating C++ for ${name}.proto" VERBATIM)
  set_source_files_properties(${folder}/${name}.pb.cc PROPERTIES COMPILE_OPTIONS "-w")
  set(GENERATED_DIR ${folder} PARENT_SCOPE)
endfunction()
