# SPDX-License-Identifier: Apache-2.0
# verification/cases/list.def is the one registration: each line `SCREE_CASE(name)` stands for a folder
# verification/cases/<name>/ with case.toml, exact.hpp, expect.toml and README.md. Its two TOML files become texts in the
# program, so that an installed scree needs no files to verify itself. All cases are one unit: what they include takes
# longer to compile than they do.

set(SCREE_CASE_LIST "${CMAKE_SOURCE_DIR}/verification/cases/list.def")
set(SCREE_CASES "")
set(case_includes "")
set(case_functions "")

set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${SCREE_CASE_LIST}")
file(STRINGS "${SCREE_CASE_LIST}" lines REGEX "^[ \t]*SCREE_CASE\\(")
foreach(line IN LISTS lines)
  if(NOT line MATCHES "^[ \t]*SCREE_CASE\\([ \t]*([a-z0-9_]+)[ \t]*\\)")
    message(FATAL_ERROR "verification/cases/list.def: cannot read '${line}'; write SCREE_CASE(folder_name)")
  endif()
  set(case ${CMAKE_MATCH_1})
  set(folder "${CMAKE_SOURCE_DIR}/verification/cases/${case}")
  foreach(file case.toml exact.hpp expect.toml README.md)
    if(NOT EXISTS "${folder}/${file}")
      message(FATAL_ERROR "verification/cases/list.def names ${case}, but ${folder}/${file} does not exist")
    endif()
  endforeach()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${folder}/case.toml" "${folder}/expect.toml")
  file(READ "${folder}/case.toml" case_deck)
  file(READ "${folder}/expect.toml" case_expect)
  list(APPEND SCREE_CASES ${case})
  string(APPEND case_includes "#include \"verification/cases/${case}/exact.hpp\"\n")
  string(APPEND case_functions "CaseCode case_${case}();\nCaseCode case_${case}() {\n"
                               "  return code_of<cases::${case}::Case>(\"${case}\", R\"scree_case(${case_deck})scree_case\",\n"
                               "R\"scree_case(${case_expect})scree_case\");\n}\n\n")
endforeach()

set(SCREE_CASE_UNIT "${CMAKE_BINARY_DIR}/generated/cases.cpp")
configure_file("${CMAKE_SOURCE_DIR}/cmake/cases.cpp.in" "${SCREE_CASE_UNIT}" @ONLY)
