# SPDX-License-Identifier: Apache-2.0
# Runs every micro-benchmark for a moment and asks each for a finite rate and time. Run as
#   cmake -DPROGRAM=<scree_benchmarks> -P cmake/check_benchmarks.cmake
cmake_minimum_required(VERSION 3.25)

execute_process(
  COMMAND "${PROGRAM}" --benchmark_min_time=0.001 --benchmark_format=json
  RESULT_VARIABLE status
  OUTPUT_VARIABLE output
  ERROR_VARIABLE errors)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${status}:\n${errors}")
endif()

# Rates that are no numbers (NaN, Infinity) are no JSON, hence end here too.
string(JSON number ERROR_VARIABLE problem LENGTH "${output}" benchmarks)
if(problem)
  message(FATAL_ERROR "the output of ${PROGRAM} cannot be read: ${problem}")
endif()

set(groups gather_affine scatter_affine stage_in stage_out clear g2p2g_block kirchhoff to_records to_lanes eigen_symmetric
           eigen_symmetric_closed polar_rotation svd)
set(missing ${groups})
math(EXPR last "${number} - 1")
foreach(i RANGE ${last})
  string(JSON benchmark GET "${output}" benchmarks ${i})
  string(JSON name GET "${benchmark}" name)
  string(REGEX REPLACE "/.*" "" group "${name}")
  list(REMOVE_ITEM missing ${group})
  string(JSON failure ERROR_VARIABLE none GET "${benchmark}" error_message)
  if(NOT none)
    message(FATAL_ERROR "${name} failed: ${failure}")
  endif()
  string(JSON rate ERROR_VARIABLE absent GET "${benchmark}" items_per_second)
  if(absent OR NOT rate GREATER 0)
    message(FATAL_ERROR "${name}: items_per_second is ${rate}, must be above 0")
  endif()
endforeach()
if(missing)
  message(FATAL_ERROR "no benchmark of ${missing}")
endif()
message("${number} benchmarks have finite rates")
