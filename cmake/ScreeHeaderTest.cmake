# SPDX-License-Identifier: Apache-2.0
# The object library scree_header_test compiles one unit for each header that has no source of its own, which includes that header
# alone and twice. A header with a source is the first thing that its source includes (a rule of check_sources.cmake): each build shows
# that it needs nothing before it.

file(GLOB_RECURSE headers RELATIVE "${CMAKE_SOURCE_DIR}" CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/solver/*.hpp"
     "${CMAKE_SOURCE_DIR}/materials/*.hpp" "${CMAKE_SOURCE_DIR}/postproc/*.hpp" "${CMAKE_SOURCE_DIR}/app/*.hpp"
     "${CMAKE_SOURCE_DIR}/verification/*.hpp")
# Headers that name CUDA are compiled by nvcc, with the kernels.
list(FILTER headers EXCLUDE REGEX "/cuda_[a-z_]*\\.hpp$")

if(NOT benchmark_FOUND)
  list(FILTER headers EXCLUDE REGEX "^verification/benchmark/")
endif()

set(units "")
foreach(header IN LISTS headers)
  string(REGEX REPLACE "\\.hpp$" ".cpp" unit "${header}")
  if(EXISTS "${CMAKE_SOURCE_DIR}/${unit}")
    continue()
  endif()
  set(unit "${CMAKE_BINARY_DIR}/generated/header_test/${unit}")
  configure_file("${CMAKE_SOURCE_DIR}/cmake/header_test.cpp.in" "${unit}" @ONLY)
  list(APPEND units "${unit}")
endforeach()

if(units)
  add_library(scree_header_test OBJECT EXCLUDE_FROM_ALL ${units})
  scree_compile_options(scree_header_test)
  target_link_libraries(scree_header_test PRIVATE fmt::fmt GTest::gtest Eigen3::Eigen)
  if(benchmark_FOUND)
    target_link_libraries(scree_header_test PRIVATE benchmark::benchmark)
  endif()
  # The test asks whether the headers compile, not for code: no optimisation, which halves the time.
  target_compile_options(scree_header_test PRIVATE -O0 -g0 -Werror)
  add_test(NAME sources.self_contained_headers COMMAND "${CMAKE_COMMAND}" --build "${CMAKE_BINARY_DIR}" --target
                                                       scree_header_test)
  set_tests_properties(sources.self_contained_headers PROPERTIES LABELS sources TIMEOUT 1800 RUN_SERIAL ON)
endif()
