# SPDX-License-Identifier: Apache-2.0
# What `cmake --install` puts where, beside the program: the scripts of `scree post`, example decks and documents.

set(scree_scripts "${CMAKE_INSTALL_DATADIR}/scree/postproc")
install(PROGRAMS "${CMAKE_SOURCE_DIR}/postproc/render" "${CMAKE_SOURCE_DIR}/postproc/convert" DESTINATION "${scree_scripts}")
install(DIRECTORY "${CMAKE_SOURCE_DIR}/postproc/picture" DESTINATION "${scree_scripts}" FILES_MATCHING PATTERN "*.py")

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
