# SPDX-License-Identifier: Apache-2.0
# A build for many machines (preset dist): the whole program once for each instruction set of SCREE_DISPATCH, and a small
# `scree` that starts the best one the machine can run (app/launcher).
#
# Whole programs, each linked by itself: inline functions compiled for different instruction sets must never meet in one
# link, since the linker keeps a single copy of each and it might be one that the machine cannot execute.

include(ExternalProject)
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  message(FATAL_ERROR "SCREE_DISPATCH is for x86-64 machines; this is ${CMAKE_SYSTEM_PROCESSOR}: leave it empty")
endif()

string(REPLACE ";" "|" dispatch_materials "${SCREE_MATERIALS}")
set(dispatch_programs "${CMAKE_BINARY_DIR}/libexec/scree")
foreach(target IN LISTS SCREE_DISPATCH)
  if(NOT target MATCHES "^x86-64-v[234]$")
    message(FATAL_ERROR "SCREE_DISPATCH: ${target} is unknown; allowed: x86-64-v2, x86-64-v3, x86-64-v4")
  endif()
  ExternalProject_Add(
    scree-${target}
    SOURCE_DIR "${CMAKE_SOURCE_DIR}"
    BINARY_DIR "${CMAKE_BINARY_DIR}/${target}"
    LIST_SEPARATOR |
    CMAKE_ARGS
      -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}
      -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
      -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
      -DSCREE_MARCH=${target}
      -DSCREE_DISPATCH=
      -DSCREE_MATERIALS=${dispatch_materials}
      -DSCREE_WERROR=${SCREE_WERROR}
      -DBUILD_TESTING=OFF
    BUILD_ALWAYS ON
    USES_TERMINAL_BUILD ON
    INSTALL_COMMAND "${CMAKE_COMMAND}" -E make_directory "${dispatch_programs}"
    COMMAND "${CMAKE_COMMAND}" -E copy "${CMAKE_BINARY_DIR}/${target}/bin/scree" "${dispatch_programs}/scree-${target}")
  install(PROGRAMS "${dispatch_programs}/scree-${target}" DESTINATION "libexec/scree")
endforeach()

add_executable(scree app/launcher/main.cpp)
target_compile_features(scree PRIVATE cxx_std_20)
target_compile_options(scree PRIVATE -Wall -Wextra -Wpedantic $<$<BOOL:${SCREE_WERROR}>:-Werror>)
target_link_options(scree PRIVATE -static-libstdc++ -static-libgcc)
set_target_properties(scree PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
install(TARGETS scree RUNTIME)

include(CTest)
if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  include(GoogleTest)
  list(JOIN SCREE_DISPATCH "," dispatch_targets) # a semicolon would part the definition
  add_executable(scree_dispatch_tests verification/dispatch/targets_test.cpp verification/support/process.cpp)
  target_compile_features(scree_dispatch_tests PRIVATE cxx_std_20)
  target_include_directories(scree_dispatch_tests PRIVATE "${CMAKE_SOURCE_DIR}")
  target_compile_definitions(scree_dispatch_tests PRIVATE SCREE_SOURCE_DIR="${CMAKE_SOURCE_DIR}" SCREE_TARGETS="${dispatch_targets}"
                                                          SCREE_EXECUTABLE="$<TARGET_FILE:scree>")
  target_link_libraries(scree_dispatch_tests PRIVATE GTest::gtest GTest::gtest_main)
  gtest_discover_tests(scree_dispatch_tests TEST_PREFIX "dispatch." DISCOVERY_MODE PRE_TEST PROPERTIES LABELS dispatch TIMEOUT 900)
endif()
