# The sanitizer build, and the fuzzers, which are part of it.

option(NAO_SANITIZE "Build with address and undefined-behaviour sanitizers, and the fuzzers" OFF)

if(NOT NAO_SANITIZE)
  return()
endif()

# libFuzzer comes with clang's runtime. Here GCC compiles what it tests, as the rest of this build: another compiler would
# compile most of the libraries once more.
file(GLOB archives /usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.fuzzer-${CMAKE_SYSTEM_PROCESSOR}.a)
if(archives AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(GET archives -1 archive)
  add_library(nao_coverage STATIC ${CMAKE_CURRENT_LIST_DIR}/sanitizers/coverage.cpp)
  add_library(nao_fuzzer_options OBJECT ${CMAKE_CURRENT_LIST_DIR}/sanitizers/fuzzer_options.cpp)
  set_target_properties(nao_coverage nao_fuzzer_options PROPERTIES NAO_PRECOMPILED NONE)
  # Its own __sanitizer_cov_trace_pc only says that it does not support it.
  set(NAO_LIBFUZZER ${CMAKE_BINARY_DIR}/libfuzzer.a)
  add_custom_command(OUTPUT ${NAO_LIBFUZZER}
    COMMAND ${CMAKE_OBJCOPY} --localize-symbol=__sanitizer_cov_trace_pc ${archive} ${NAO_LIBFUZZER}
    DEPENDS ${archive} VERBATIM)
  add_custom_target(nao_libfuzzer DEPENDS ${NAO_LIBFUZZER})
  add_custom_target(fuzzers)
  # Every program links it: nao_add_fuzzer compiles libraries with NAO_COVERAGE, and tests use them too.
  link_libraries(nao_coverage)
  set(NAO_COVERAGE -fsanitize-coverage=trace-pc,trace-cmp)
else()
  message(STATUS "Without fuzzers: they need GCC and libFuzzer (scripts/setup --with optional)")
endif()

# Instrumented code gives GCC false reports: warnings are errors in the other builds only.
# Not vptr: it stops at every message, inside LCM's own header, on an object that is sound. Not null, object-size and
# pointer-overflow: the address sanitizer stops at the access, if one follows. Not alignment: x86-64 reads unaligned
# values, or stops by itself. These checks took a quarter of the compiler's time.
add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined
                    -fno-sanitize=vptr,null,object-size,pointer-overflow,alignment -fno-omit-frame-pointer)
add_link_options(-fsanitize=address,undefined)
# A call for each check of an address instead of inlined code: the same checks, and up to a sixth less to compile.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(--param=asan-instrumentation-with-call-threshold=0)
endif()
