# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts where, beside the program: example decks and documents.

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
