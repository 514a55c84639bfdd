# SPDX-License-Identifier: Apache-2.0
# Libraries of the distribution; nothing is downloaded.

find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(toml11 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(muparser REQUIRED)

# The MPI build of HDF5, which PETSc also links: two HDF5 libraries in one process lock files against each other.
find_package(PkgConfig REQUIRED)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-openmpi)

# Components must be listed: without a list VTK demands Qt.
find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel CommonExecutionModel IOXML IOPLY IOImage RenderingFreeType)
set(SCREE_VTK_WRITE VTK::CommonCore VTK::CommonDataModel VTK::CommonExecutionModel VTK::IOXML)
# Meshes that decks name as shapes.
set(SCREE_VTK_MESHES VTK::IOXML VTK::IOPLY)
# Pictures with lettering, drawn in memory: no screen and no OpenGL.
set(SCREE_VTK_PICTURES VTK::IOImage VTK::RenderingFreeType)
