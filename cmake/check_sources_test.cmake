# SPDX-License-Identifier: Apache-2.0
# Tests check_sources.cmake itself: a small tree with one breach of each kind must fail with exactly those sentences, and a tree
# without a breach must pass. Run as  cmake -DWORK=<empty folder> -P cmake/check_sources_test.cmake
cmake_minimum_required(VERSION 3.25)

set(spdx "// SPDX-License-Identifier: Apache-2.0\n")
set(head "${spdx}#pragma once\n")

function(run_check root status output)
  execute_process(
    COMMAND "${CMAKE_COMMAND}" -DROOT=${root} -P "${CMAKE_CURRENT_LIST_DIR}/check_sources.cmake"
    RESULT_VARIABLE code
    OUTPUT_VARIABLE out
    ERROR_VARIABLE err)
  set(${status} ${code} PARENT_SCOPE)
  set(${output} "${out}${err}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK}/good" "${WORK}/bad")

# A tree that keeps every rule, with the permitted neighbours of each.
file(WRITE "${WORK}/good/solver/base/a.hpp" "${head}#include <vector>\n")
file(WRITE "${WORK}/good/materials/material.hpp" "${head}#include \"solver/base/a.hpp\"\n")
file(WRITE "${WORK}/good/solver/step/b.hpp" "${head}#include \"materials/material.hpp\"\n")
file(WRITE "${WORK}/good/solver/step/list.cpp" "${spdx}#include \"generated/materials.hpp\"\n")
file(WRITE "${WORK}/good/solver/io/c.cpp" "${spdx}#include <hdf5.h>\n#include <vtkPoints.h>\n")
file(WRITE "${WORK}/good/postproc/d.cpp" "${spdx}#include \"solver/io/c.hpp\"\n")
file(WRITE "${WORK}/good/app/e.cpp" "${spdx}#include <CLI/CLI.hpp>\n#include \"postproc/d.hpp\"\n")
file(WRITE "${WORK}/good/solver/base/f.hpp" "${head}")
file(WRITE "${WORK}/good/solver/base/f.cpp" "${spdx}// Words.\n#include \"solver/base/f.hpp\"\n\n#include <vector>\n")
run_check("${WORK}/good" status output)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "a tree without a breach was rejected:\n${output}")
endif()

# One breach a file; the second entry is what the report must contain.
string(REPEAT "\n" 400 many_lines)
set(cases
    "solver/base/up.hpp|${head}#include \"solver/step/b.hpp\"\n|solver/base/up.hpp:3: base must not include solver/step/b.hpp"
    "materials/up.hpp|${head}#include \"solver/step/b.hpp\"\n|materials/up.hpp:3: materials must not include"
    "solver/step/concrete.hpp|${head}\n  #  include \"materials/sand.hpp\"\n|solver/step/concrete.hpp:4: solver must not include materials/sand.hpp"
    "solver/grid/list.cpp|${spdx}#include \"generated/materials.def\"\n|solver/grid/list.cpp:2: solver must not include generated/materials.def"
    "solver/step/up.cpp|${spdx}#include \"app/e.hpp\"\n|solver/step/up.cpp:2: solver must not include app/e.hpp"
    "postproc/inside.cpp|${spdx}#include \"solver/grid/g.hpp\"\n|postproc/inside.cpp:2: postproc must not include solver/grid/g.hpp"
    "app/relative.cpp|${spdx}#include \"../solver/base/a.hpp\"\n|app/relative.cpp:2: \"../solver/base/a.hpp\" is not a path"
    "app/library.cpp|${spdx}#include <toml.hpp>\n|app/library.cpp:2: <toml.hpp> belongs to toml11"
    "solver/deck/header.hpp|${head}#include <muParser.h>\n|solver/deck/header.hpp:3: <muParser.h> belongs to muparser"
    "solver/grid/files.cpp|${spdx}#include <hdf5.h>\n|solver/grid/files.cpp:2: <hdf5.h> belongs to HDF5"
    "solver/grid/vtk.cpp|${spdx}#include <vtkPoints.h>\n|solver/grid/vtk.cpp:2: <vtkPoints.h> belongs to VTK"
    "solver/grid/ranks.cpp|${spdx}#include <mpi.h>\n|solver/grid/ranks.cpp:2: <mpi.h> belongs to MPI"
    "solver/grid/matrix.cpp|${spdx}#include <petscksp.h>\n|solver/grid/matrix.cpp:2: <petscksp.h> belongs to PETSc"
    "solver/grid/device.cpp|${spdx}#include <cuda_runtime.h>\n|solver/grid/device.cpp:2: <cuda_runtime.h> belongs to CUDA"
    "solver/grid/command.cpp|${spdx}#include <CLI/CLI.hpp>\n|solver/grid/command.cpp:2: <CLI/CLI.hpp> belongs to CLI11"
    "verification/unit/rate.cpp|${spdx}#include <benchmark/benchmark.h>\n|verification/unit/rate.cpp:2: <benchmark/benchmark.h> belongs to GoogleBenchmark"
    "solver/grid/license.cpp|#define A 0\n|solver/grid/license.cpp:1: the first line must be"
    "solver/grid/twice.hpp|${spdx}#define A 0\n|solver/grid/twice.hpp:1: a header needs #pragma once"
    "solver/base/late.hpp|${spdx}#define A 0\n|solver/base/late.hpp:1: a header needs #pragma once"
    "solver/base/late.cpp|${spdx}#include <vector>\n#include \"solver/base/late.hpp\"\n|solver/base/late.cpp:1: the first include must be \"solver/base/late.hpp\""
    "solver/grid/long.cpp|${spdx}${many_lines}|solver/grid/long.cpp:401: 401 lines")
foreach(case IN LISTS cases)
  string(REPLACE "|" ";" parts "${case}")
  list(GET parts 0 path)
  list(GET parts 1 text)
  file(WRITE "${WORK}/bad/${path}" "${text}")
endforeach()
run_check("${WORK}/bad" status output)
if(status EQUAL 0)
  message(FATAL_ERROR "a tree with breaches was accepted:\n${output}")
endif()
foreach(case IN LISTS cases)
  string(REPLACE "|" ";" parts "${case}")
  list(GET parts 2 sentence)
  string(FIND "${output}" "${sentence}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "not reported: ${sentence}\n${output}")
  endif()
endforeach()
list(LENGTH cases number)
string(FIND "${output}" "${number} breaches in ${number} files" place)
if(place EQUAL -1)
  message(FATAL_ERROR "expected exactly ${number} breaches:\n${output}")
endif()
message("all ${number} breaches were found, and nothing else")
