# Tests of whole processes, in Python or JavaScript. Each has a network namespace of its own, so that they run beside each other.
#
# PROCESSORS of all tests counts quarters of a core, as measured in use: most of these tests wait for their programs and take
# less than one quarter, a browser that draws in software three, and what only computes NAO_ONE_CORE. scripts/test offers five
# for each core, since most take less than they reserve. COST is how long a test takes alone, s: the longest begin first.
set(NAO_ONE_CORE 4)

# nao_add_system_test(NAME COMMAND ... [PROCESSORS QUARTERS] [COST s] [TIMEOUT s] [ENVIRONMENT NAME=VALUE...] [NEEDS_NETWORK])
# NEEDS_NETWORK: it fetches packages, and runs in the network of the host.
function(nao_add_system_test name)
  cmake_parse_arguments(arg "NEEDS_NETWORK" "PROCESSORS;COST;TIMEOUT" "COMMAND;ENVIRONMENT" ${ARGN})
  if(NOT arg_PROCESSORS)
    set(arg_PROCESSORS 1)
  endif()
  if(NOT arg_COST)
    set(arg_COST 20)
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 900)
  endif()
  set(isolated ${CMAKE_SOURCE_DIR}/test/support/isolated)
  if(arg_NEEDS_NETWORK)
    set(isolated)
  endif()
  add_test(NAME ${name} COMMAND ${isolated} ${arg_COMMAND})
  set_tests_properties(${name} PROPERTIES
    LABELS system PROCESSORS ${arg_PROCESSORS} COST ${arg_COST} TIMEOUT ${arg_TIMEOUT} SKIP_RETURN_CODE 77
    ENVIRONMENT "NAO_BIN_DIR=${CMAKE_RUNTIME_OUTPUT_DIRECTORY};PYTHONPATH=${CMAKE_SOURCE_DIR}/test/support;PYTHONDONTWRITEBYTECODE=1;${arg_ENVIRONMENT}")
endfunction()
