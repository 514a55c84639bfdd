# SPDX-License-Identifier: Apache-2.0
# CUDA: the same block bodies, compiled by nvcc. The run-time library is linked statically, so that the
# binary also starts on machines without CUDA.

if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES)
  set(CMAKE_CUDA_ARCHITECTURES 80 90)
endif()
if(NOT CMAKE_CUDA_COMPILER AND NOT DEFINED ENV{CUDACXX})
  find_program(SCREE_NVCC nvcc HINTS /usr/local/cuda/bin)
  if(SCREE_NVCC)
    set(CMAKE_CUDA_COMPILER "${SCREE_NVCC}")
  endif()
endif()
enable_language(CUDA)
if(CMAKE_CUDA_COMPILER_VERSION VERSION_LESS 12)
  message(FATAL_ERROR "SCREE_CUDA needs nvcc 12 or newer for C++20; found ${CMAKE_CUDA_COMPILER_VERSION}")
endif()

# CMake 3.25 knows nvcc 13 only up to C++17; nvcc itself speaks C++20.
set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION "-std=c++20")
set(CMAKE_CUDA20_EXTENSION_COMPILE_OPTION "-std=c++20")
if(NOT "cuda_std_20" IN_LIST CMAKE_CUDA_COMPILE_FEATURES)
  list(APPEND CMAKE_CUDA_COMPILE_FEATURES cuda_std_20)
endif()
set(CMAKE_CUDA_STANDARD 20)
set(CMAKE_CUDA_STANDARD_REQUIRED ON)
set(CMAKE_CUDA_EXTENSIONS OFF)
set(CMAKE_CUDA_RUNTIME_LIBRARY Static)

# The target scree_cuda_kernels: generated instances and every .cu file of the solver.
function(scree_add_cuda_kernels)
  set(units "")
  scree_material_units(units material_device.cu.in cu)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/solver/*.cu")
  list(APPEND units ${sources})
  add_library(scree_cuda_kernels STATIC ${units})
  target_link_libraries(scree_cuda_kernels PUBLIC scree_flags)
  target_compile_options(
    scree_cuda_kernels PRIVATE $<$<COMPILE_LANGUAGE:CUDA>:--expt-relaxed-constexpr>
                               $<$<COMPILE_LANGUAGE:CUDA>:-Xcompiler=-Wall,-Wextra,-Wno-psabi>)
  if(SCREE_WERROR)
    target_compile_options(scree_cuda_kernels PRIVATE $<$<COMPILE_LANGUAGE:CUDA>:-Werror=all-warnings>)
  endif()
  target_link_libraries(scree_core PRIVATE scree_cuda_kernels)
  # The one unit of C++ that asks; a definition for all would make two builds of each unit.
  set_source_files_properties("${CMAKE_SOURCE_DIR}/solver/device/gpus.cpp" PROPERTIES COMPILE_DEFINITIONS SCREE_CUDA=1)
endfunction()
