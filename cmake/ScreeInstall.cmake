# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts where, beside the program: the picture tool (as scree-render), example decks and documents.

if(EXISTS "${CMAKE_SOURCE_DIR}/postproc/render")
  install(PROGRAMS "${CMAKE_SOURCE_DIR}/postproc/render" TYPE BIN RENAME scree-render)
endif()

foreach(folder inputs docs)
  if(IS_DIRECTORY "${CMAKE_SOURCE_DIR}/${folder}")
    install(DIRECTORY "${CMAKE_SOURCE_DIR}/${folder}" DESTINATION "${CMAKE_INSTALL_DATADIR}/scree")
  endif()
endforeach()
foreach(document README.md LICENSE CITATION.cff CHANGELOG.md)
  if(EXISTS "${CMAKE_SOURCE_DIR}/${document}")
    install(FILES "${CMAKE_SOURCE_DIR}/${document}" DESTINATION "${CMAKE_INSTALL_DATADIR}/scree")
  endif()
endforeach()
