# SPDX-License-Identifier: Apache-2.0
# The library scree_emulation: the CUDA units of solver/device and the laws of SCREE_EMULATED, compiled as C++ over fibers
# (solver/emulation). Only tests link it.

find_package(Boost 1.74 REQUIRED COMPONENTS context)

set(emulated_units "")
set(entries "// Written by CMake from materials/list.def and SCREE_EMULATED.\n")
foreach(header Type IN ZIP_LISTS SCREE_MATERIAL_HEADERS SCREE_MATERIAL_TYPES)
  if(NOT SCREE_EMULATED STREQUAL "all" AND NOT header IN_LIST SCREE_EMULATED)
    continue()
  endif()
  string(APPEND entries "SCREE_MATERIAL(${header}, ${Type})\n")
  foreach(D 2 3)
    foreach(real double float)
      set(unit "${CMAKE_BINARY_DIR}/generated/emulated/${header}_${D}d_${real}.cpp")
      configure_file("${CMAKE_SOURCE_DIR}/cmake/material_device.cu.in" "${unit}" @ONLY)
      list(APPEND emulated_units "${unit}")
    endforeach()
  endforeach()
endforeach()
scree_write("${CMAKE_BINARY_DIR}/generated/generated/emulated.def" "${entries}")

# Units that only a GPU has.
set(cuda_only "cuda_device")
file(GLOB kernels CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/solver/device/*.cu")
foreach(kernel IN LISTS kernels)
  get_filename_component(name "${kernel}" NAME_WE)
  if(NOT name IN_LIST cuda_only)
    set(unit "${CMAKE_BINARY_DIR}/generated/emulated/${name}.cpp")
    scree_write("${unit}" "// Written by CMake: a CUDA unit as C++.\n#include \"solver/device/${name}.cu\"\n")
    list(APPEND emulated_units "${unit}")
  endif()
endforeach()

file(GLOB emulation_sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/solver/emulation/*.cpp")
add_library(scree_emulation STATIC ${emulation_sources} ${emulated_units})
scree_compile_options(scree_emulation)
# Fibers, not arithmetic, set the speed.
set_property(SOURCE ${emulated_units} APPEND PROPERTY COMPILE_OPTIONS ${SCREE_COLD_FLAGS})
target_link_libraries(scree_emulation PUBLIC scree_core PRIVATE Boost::context)
