# SPDX-License-Identifier: Apache-2.0
# Every choice a builder has, in one place. Presets (CMakePresets.json) are only combinations of these.

option(SCREE_CUDA "Compile the CUDA kernels (needs nvcc 12 or newer)" OFF)
option(SCREE_WERROR "Treat compiler warnings as errors" OFF)
option(SCREE_STRICT "Run the blocks on the strict test backend (shuffled order, poisoned arenas)" OFF)
option(SCREE_FP_TRAPS "Stop at the first division by zero, overflow or invalid floating-point operation" OFF)
option(SCREE_ASSERTIONS "Keep assertions of scree and of the standard library, in any build type" OFF)
set(SCREE_SANITIZE "" CACHE STRING "Sanitizers, e.g. address,undefined or thread; empty for none")
set(SCREE_MARCH "native" CACHE STRING
    "Instruction set: native (this machine), portable (x86-64-v2 on PCs, machines since about 2009), or a value of -march")
set(SCREE_BENCHMARKS "auto" CACHE STRING
    "Micro-benchmarks: auto (where Google Benchmark is installed, not with sanitizers), ON (it must be there), OFF")
set(SCREE_DISPATCH "" CACHE STRING
    "Instruction sets of a build for many machines, e.g. x86-64-v2;x86-64-v3;x86-64-v4; empty for one program (SCREE_MARCH)")
set(SCREE_EMULATED "fixed_corotated;drucker_prager" CACHE STRING
    "Materials whose CUDA kernels the tests run on the processor (those compiled at all), separated by ';'; all for every one")
set(SCREE_MATERIALS "all" CACHE STRING "Materials to compile, by name, separated by ';'; all for every one")

get_property(scree_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(NOT scree_multi_config AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo" FORCE)
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# One -march for every unit: SIMD lanes cross function boundaries, so units must agree on the vector ABI.
if(SCREE_MARCH STREQUAL "portable")
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(SCREE_MARCH_FLAGS -march=x86-64-v2 -mtune=generic)
  else()
    set(SCREE_MARCH_FLAGS "")
  endif()
elseif(SCREE_MARCH STREQUAL "native" AND CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  set(SCREE_MARCH_FLAGS -mcpu=native)
elseif(SCREE_MARCH)
  set(SCREE_MARCH_FLAGS -march=${SCREE_MARCH})
endif()
# Lanes are moved as whole registers: halves would defeat store forwarding. (Some -march choose 32 bytes on AVX-512.)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT SCREE_MARCH STREQUAL "portable")
  include(CheckCXXCompilerFlag)
  check_cxx_compiler_flag("-mprefer-vector-width=512 -mmove-max=512 -mstore-max=512" SCREE_HAS_WHOLE_MOVES)
  if(SCREE_HAS_WHOLE_MOVES)
    list(APPEND SCREE_MARCH_FLAGS -mprefer-vector-width=512 -mmove-max=512 -mstore-max=512)
  endif()
endif()
