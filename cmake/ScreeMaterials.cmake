# SPDX-License-Identifier: Apache-2.0
# materials/list.def is the one registration: each line `SCREE_MATERIAL(header, Type)` gives
#   generated/materials.hpp   the includes of all chosen materials,
#   generated/materials.def   the chosen lines, an X-macro list,
#   one translation unit for each material, dimension and precision (so they build in parallel),
#   two translation units for each material: its type-erased point (materials/material_point.hpp) and the calls that show
#   what it costs (materials/material_cost.hpp).

set(SCREE_MATERIAL_LIST "${CMAKE_SOURCE_DIR}/materials/list.def")
set(SCREE_MATERIAL_HEADERS "")
set(SCREE_MATERIAL_TYPES "")
set(SCREE_MATERIAL_INSTANCES "")

# Writes a file only when its text changes, so that a new configure run rebuilds nothing.
function(scree_write path text)
  file(CONFIGURE OUTPUT "${path}" CONTENT "${text}" @ONLY)
endfunction()

if(EXISTS "${SCREE_MATERIAL_LIST}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${SCREE_MATERIAL_LIST}")
  file(STRINGS "${SCREE_MATERIAL_LIST}" lines REGEX "^[ \t]*SCREE_MATERIAL\\(")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^[ \t]*SCREE_MATERIAL\\([ \t]*([a-z0-9_]+)[ \t]*,[ \t]*([A-Za-z0-9_]+)[ \t]*\\)")
      message(FATAL_ERROR "materials/list.def: cannot read '${line}'; write SCREE_MATERIAL(header_name, TypeName)")
    endif()
    set(header ${CMAKE_MATCH_1})
    set(type ${CMAKE_MATCH_2})
    if(NOT EXISTS "${CMAKE_SOURCE_DIR}/materials/${header}.hpp")
      message(FATAL_ERROR "materials/list.def names ${header}, but materials/${header}.hpp does not exist")
    endif()
    list(APPEND known ${header})
    if(SCREE_MATERIALS STREQUAL "all" OR header IN_LIST SCREE_MATERIALS)
      list(APPEND SCREE_MATERIAL_HEADERS ${header})
      list(APPEND SCREE_MATERIAL_TYPES ${type})
    endif()
  endforeach()
  if(NOT SCREE_MATERIALS STREQUAL "all")
    foreach(name IN LISTS SCREE_MATERIALS)
      if(NOT name IN_LIST known)
        message(FATAL_ERROR "SCREE_MATERIALS names ${name}; materials/list.def has ${known}")
      endif()
    endforeach()
  endif()
endif()

set(includes "// Written by CMake from materials/list.def.\n#pragma once\n\n")
set(entries "// Written by CMake from materials/list.def.\n")
foreach(header type IN ZIP_LISTS SCREE_MATERIAL_HEADERS SCREE_MATERIAL_TYPES)
  string(APPEND includes "#include \"materials/${header}.hpp\"\n")
  string(APPEND entries "SCREE_MATERIAL(${header}, ${type})\n")
endforeach()
scree_write("${CMAKE_BINARY_DIR}/generated/generated/materials.hpp" "${includes}")
scree_write("${CMAKE_BINARY_DIR}/generated/generated/materials.def" "${entries}")

# scree_material_units(<variable> <template> <suffix>): one unit for each material, dimension and precision.
function(scree_material_units result template suffix)
  set(units "")
  foreach(header Type IN ZIP_LISTS SCREE_MATERIAL_HEADERS SCREE_MATERIAL_TYPES)
    foreach(D 2 3)
      foreach(real double float)
        set(unit "${CMAKE_BINARY_DIR}/generated/instances/${header}_${D}d_${real}.${suffix}")
        configure_file("${CMAKE_SOURCE_DIR}/cmake/${template}" "${unit}" @ONLY)
        list(APPEND units "${unit}")
      endforeach()
    endforeach()
  endforeach()
  set(${result} "${units}" PARENT_SCOPE)
endfunction()

if(EXISTS "${CMAKE_SOURCE_DIR}/solver/step/instance.hpp")
  scree_material_units(SCREE_MATERIAL_INSTANCES material_instance.cpp.in cpp)
endif()

set(SCREE_MATERIAL_POINTS "")
foreach(header Type IN ZIP_LISTS SCREE_MATERIAL_HEADERS SCREE_MATERIAL_TYPES)
  set(unit "${CMAKE_BINARY_DIR}/generated/points/${header}.cpp")
  configure_file("${CMAKE_SOURCE_DIR}/cmake/material_point.cpp.in" "${unit}" @ONLY)
  list(APPEND SCREE_MATERIAL_POINTS "${unit}")
  set(unit "${CMAKE_BINARY_DIR}/generated/calls/${header}.cpp")
  configure_file("${CMAKE_SOURCE_DIR}/cmake/material_calls.cpp.in" "${unit}" @ONLY)
  list(APPEND SCREE_MATERIAL_POINTS "${unit}")
endforeach()
