# SPDX-License-Identifier: Apache-2.0
# Compile flags and the functions that declare libraries and tests.

# Flags every target of scree carries.
add_library(scree_flags INTERFACE)
target_compile_features(scree_flags INTERFACE cxx_std_20)
target_include_directories(scree_flags INTERFACE "${CMAKE_SOURCE_DIR}" "${CMAKE_BINARY_DIR}/generated")
target_compile_options(
  scree_flags
  INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall>
    $<$<COMPILE_LANGUAGE:CXX>:-Wextra>
    $<$<COMPILE_LANGUAGE:CXX>:-Wpedantic>
    # Lanes are 64 bytes on every machine; GCC notes that their calling convention depends on -march. All units share one.
    $<$<COMPILE_LANGUAGE:CXX>:-Wno-psabi>
    # GCC 12 misjudges string concatenation (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:$<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict>>
    # Fused multiply-add is wanted; errno after sqrt is not read. No -ffast-math: NaN, infinity and the order of sums matter.
    $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=fast>
    $<$<COMPILE_LANGUAGE:CXX>:-fno-math-errno>)
foreach(flag IN LISTS SCREE_MARCH_FLAGS)
  target_compile_options(scree_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:${flag}>)
endforeach()

if(SCREE_WERROR)
  target_compile_options(scree_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
endif()
if(SCREE_SANITIZE)
  target_compile_options(
    scree_flags
    INTERFACE
      $<$<COMPILE_LANGUAGE:CXX>:-fsanitize=${SCREE_SANITIZE}>
      $<$<COMPILE_LANGUAGE:CXX>:-fno-omit-frame-pointer>
      # GCC documents false alarms of this warning in instrumented code; the release build keeps it.
      $<$<COMPILE_LANGUAGE:CXX>:-Wno-maybe-uninitialized>)
  if(NOT SCREE_SANITIZE MATCHES "thread")
    # A null pointer and a too small object are the address sanitizer's to find; asking twice costs build time.
    target_compile_options(scree_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-fno-sanitize-recover=all>
                                                 $<$<COMPILE_LANGUAGE:CXX>:-fno-sanitize=null,object-size>)
  endif()
  target_link_options(scree_flags INTERFACE -fsanitize=${SCREE_SANITIZE})
endif()
if(SCREE_STRICT)
  target_compile_definitions(scree_flags INTERFACE SCREE_STRICT=1)
endif()
if(SCREE_FP_TRAPS)
  target_compile_definitions(scree_flags INTERFACE SCREE_FP_TRAPS=1)
endif()
if(SCREE_ASSERTIONS)
  target_compile_definitions(scree_flags INTERFACE SCREE_ASSERTIONS=1 _GLIBCXX_ASSERTIONS=1)
  target_compile_options(scree_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-UNDEBUG>)
endif()

# What `scree info` prints about this build.
set(SCREE_COMMIT "")
find_package(Git QUIET)
if(Git_FOUND)
  execute_process(
    COMMAND "${GIT_EXECUTABLE}" rev-parse --short=12 HEAD
    WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}"
    OUTPUT_VARIABLE SCREE_COMMIT
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
configure_file("${CMAKE_SOURCE_DIR}/cmake/build_info.hpp.in" "${CMAKE_BINARY_DIR}/generated/generated/build_info.hpp" @ONLY)

function(scree_compile_options target)
  target_link_libraries(${target} PUBLIC scree_flags)
endfunction()

# Flags behind all others for code without particle loops (deck, files, commands, tests of these): what it takes to run is
# nothing beside what it takes to compile optimised. The sanitizer builds leave it unoptimised.
set(cold_flags "")
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  set(cold_flags "-O1")
endif()
set(SCREE_COLD_FLAGS "${cold_flags}" CACHE STRING "Additional compile flags for code without particle loops")
function(scree_cold_sources)
  set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS ${SCREE_COLD_FLAGS})
endfunction()

# scree_sources(<variable> <folder>... [EXCLUDE <path>...]): all .cpp files below the folders.
function(scree_sources result)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "EXCLUDE")
  set(found "")
  foreach(folder IN LISTS arg_UNPARSED_ARGUMENTS)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/${folder}/*.cpp")
    list(APPEND found ${sources})
  endforeach()
  foreach(path IN LISTS arg_EXCLUDE)
    list(FILTER found EXCLUDE REGEX "^${CMAKE_SOURCE_DIR}/${path}(/|$)")
  endforeach()
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

# scree_add_library(<name> GLOB <folder>... [EXCLUDE <path>...]): a static library of all .cpp files of some rooms.
function(scree_add_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "GLOB;EXCLUDE")
  scree_sources(sources ${arg_GLOB} EXCLUDE ${arg_EXCLUDE})
  if(NOT sources)
    set(sources "${CMAKE_BINARY_DIR}/generated/${name}_empty.cpp")
    file(CONFIGURE OUTPUT "${sources}" CONTENT "namespace { [[maybe_unused]] constexpr int empty_room = 0; }\n")
  endif()
  add_library(${name} STATIC ${sources})
  scree_compile_options(${name})
endfunction()
