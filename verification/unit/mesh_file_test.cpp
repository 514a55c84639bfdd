// SPDX-License-Identifier: Apache-2.0
#include "solver/geometry/mesh_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "solver/geometry/mesh_solid.hpp"
#include "verification/support/meshes.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

using testing::box_mesh;

class MeshFile : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    write_text(folder_ / name, text);
    return (folder_ / name).string();
  }
  double volume(const std::string& name, const std::string& text, const std::string& region = "") {
    return MeshSolid(read_mesh_file(write(name, text), region)).volume();
  }
  /// "key message" of the fault, without the folder's name.
  std::string fault(const std::string& name, const std::string& text,
                    const std::string& region = "") {
    try {
      read_mesh_file(write(name, text), region);
    } catch (const GeometryFault& fault) {
      return fault.key() + " " + fault.what();
    }
    return "none";
  }
  TemporaryFolder folder_;
};

const TriangleMesh brick = box_mesh({0, 0, 0}, {1, 2, 0.5});  // all exact in single precision

TEST_F(MeshFile, EveryFormatGivesTheSameSolid) {
  EXPECT_EQ(volume("a.stl", testing::ascii_stl(brick)), 1);
  EXPECT_EQ(volume("b.STL", testing::binary_stl(brick)), 1);
  EXPECT_EQ(volume("a.obj", testing::obj_text(brick)), 1);
  EXPECT_EQ(volume("a.ply", testing::ply_text(brick)), 1);
}

TEST_F(MeshFile, ABinaryHeaderMayBeginWithSolid) {
  EXPECT_EQ(volume("a.stl", testing::binary_stl(brick, "solid exported by a CAD program\n")), 1);
}

TEST_F(MeshFile, StlTextMayBeWrittenInCapitals) {
  std::string text = testing::ascii_stl(brick);
  for (char& c : text) c = char(std::toupper(c));
  EXPECT_EQ(volume("a.stl", text), 1);
}

TEST_F(MeshFile, SolidsOfAnStlTextAreRegions) {
  const std::string text = testing::ascii_stl(brick, "brick") +
                           testing::ascii_stl(box_mesh({5, 0, 0}, {6, 1, 1.5}), "left post");
  EXPECT_EQ(volume("a.stl", text), 2.5);
  EXPECT_EQ(volume("a.stl", text, "left post"), 1.5);
  EXPECT_EQ(fault("a.stl", text, "brik"),
            "region is not in the file, which has brick, left post; did you mean \"brick\"?");
  EXPECT_EQ(fault("b.stl", testing::binary_stl(brick), "brick"),
            "region the file names no regions; remove this key");
}

TEST_F(MeshFile, BrokenStlNamesTheLine) {
  std::string text = testing::ascii_stl(brick);
  text.replace(text.find("vertex"), 6, "vortex");
  EXPECT_EQ(fault("a.stl", text),
            "file is no STL file that can be read: line 4: \"vortex\" stands where \"vertex\" is "
            "expected");
  const std::string bytes = testing::binary_stl(brick);
  EXPECT_EQ(fault("a.stl", bytes.substr(0, bytes.size() - 7)),
            "file is no whole STL file: it announces 12 triangles, which take 684 bytes, and has "
            "677");  // 84 + 12 * 50
  EXPECT_EQ(fault("a.stl", ""), "file is no STL file: 0 bytes");
}

TEST_F(MeshFile, ObjPolygonsAndNegativeNumbers) {
  // The unit square with a notch, extruded: concave faces of five corners.
  const std::string text =
      "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 1 0\nv 0 2 0\nv 0 0 1\nv 2 0 1\nv 2 2 1\nv 1 1 1\nv 0 2 1\n"
      "g ends\nf 5 4 3 2 1\nf -5 -4 -3 -2 -1\n"
      "g sides\nf 1 2 7 6\nf 2 3 8 7\nf 3 4 9 8\nf 4 5 10 9\nf 5 1 6 10\n";
  EXPECT_NEAR(volume("a.obj", text), 3, 1e-15);
  EXPECT_EQ(read_mesh_file(write("a.obj", text), "sides").triangles.size(), 10u);
  EXPECT_EQ(fault("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n"),
            "file is no OBJ file that can be read: line 3: \"3\" is none of the 2 vertices so far");
  EXPECT_EQ(fault("a.obj", "v 0 0 here\n"),
            "file is no OBJ file that can be read: line 1: \"here\" is no coordinate");
}

/// Two hexahedra side by side with the integers 7 and 9 on them.
const char* const vtu = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="12" NumberOfCells="2"><Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 3 0 0 0 1 0 1 1 0 3 1 0 0 0 1 1 0 1 3 0 1 0 1 1 1 1 1 3 1 1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">
0 1 4 3 6 7 10 9 1 2 5 4 7 8 11 10</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">8 16</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">12 12</DataArray></Cells>
<CellData><DataArray type="Int32" Name="layer" format="ascii">7 9</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>
)";

TEST_F(MeshFile, CellsOfSpaceCountAsTheirSurface) {
  EXPECT_EQ(volume("a.vtu", vtu), 3);
  EXPECT_EQ(volume("a.vtu", vtu, "layer=7"), 1);
  EXPECT_EQ(volume("a.vtu", vtu, "9"), 2);
  EXPECT_EQ(fault("a.vtu", vtu, "layer=8"),
            "region is not in the file, which has layer=7, layer=9; did you mean \"layer=7\"?");
  EXPECT_EQ(fault("b.vtu", "no XML").rfind("file cannot be read by VTK", 0), 0u);
}

/// Gmsh 2.2: two tetrahedra with the physical groups "soil" and "rock".
const char* const msh = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
3 1 "soil"
3 2 "rock"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 0 0 -2
$EndNodes
$Elements
2
1 4 2 1 1 1 2 3 4
2 4 2 2 2 1 3 2 5
$EndElements
)";

TEST_F(MeshFile, MeshioReadsTheRest) {
  if (std::system("/usr/bin/python3 -c 'import meshio' 2>/dev/null") != 0)
    GTEST_SKIP() << "python3-meshio is not installed";
  EXPECT_NEAR(volume("a.msh", msh), 0.5, 1e-15);  // (1 + 2)/6
  EXPECT_NEAR(volume("a.msh", msh, "soil"), 1 / 6., 1e-15);
  EXPECT_NEAR(volume("a.msh", msh, "rock"), 2 / 6., 1e-15);
  EXPECT_NEAR(volume("a.msh", msh, "2"), 2 / 6., 1e-15);
  EXPECT_EQ(fault("a.msh", msh, "sol"),
            "region is not in the file, which has 1, 2, rock, soil; did you mean \"soil\"?");
  const std::string inp =
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 0, 0, -2\n"
      "*ELEMENT, TYPE=C3D4, ELSET=SOIL\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=C3D4, ELSET=ROCK\n2, 1, 3, "
      "2, "
      "5\n";
  EXPECT_NEAR(volume("a.inp", inp), 0.5, 1e-15);
  EXPECT_EQ(fault("a.msh", "nonsense").rfind("file cannot be read by meshio: ", 0), 0u)
      << fault("a.msh", "nonsense");
}

// A module of that name which cannot be imported stands in for one that is not installed.
TEST_F(MeshFile, WithoutMeshioTheRepairIsNamed) {
  write("meshio.py", "raise ImportError(\"No module named 'meshio'\")\n");
  setenv("PYTHONPATH", folder_.path().c_str(), 1);
  const std::string message = fault("a.msh", msh);
  unsetenv("PYTHONPATH");
  EXPECT_EQ(message,
            "file needs meshio to be read, which /usr/bin/python3 does not find (No module named "
            "'meshio'); install the package python3-meshio, or save the surface as STL, OBJ, PLY, "
            "VTP or VTU");
}

TEST_F(MeshFile, AFileThatIsNotThere) {
  try {
    read_mesh_file("/nowhere/a.stl", "");
    FAIL();
  } catch (const GeometryFault& fault) {
    EXPECT_STREQ(
        fault.what(),
        "cannot be read: /nowhere/a.stl: No such file or directory; relative paths start at "
        "the deck's folder");
  }
}

TEST(Placement, ScalesThenTurnsThenShifts) {
  const Placement place{0.001, {0, 0, 2}, std::acos(0.0), {1, 2, 3}};
  const auto x = place({1000, 500, 250});
  EXPECT_NEAR(x[0], 1 - 0.5, 1e-15);
  EXPECT_NEAR(x[1], 2 + 1, 1e-15);
  EXPECT_NEAR(x[2], 3.25, 1e-15);
}

}  // namespace
}  // namespace scree
