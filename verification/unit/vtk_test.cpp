// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <limits>

#include "solver/base/error.hpp"
#include "solver/io/vtk_frame.hpp"
#include "verification/support/file_size_limit.hpp"
#include "verification/support/sample_snapshot.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

template <class Reader>
auto read(Reader& reader, const std::filesystem::path& path) {
  EXPECT_TRUE(reader.CanReadFile(path.c_str()));
  reader.SetFileName(path.c_str());
  reader.Update();
  return reader.GetOutput();
}

void expect_fields(vtkPointData& data, const std::vector<SnapshotField>& fields, bool single) {
  for (const SnapshotField& field : fields) {
    vtkDataArray* array = data.GetArray(field.name.c_str());
    ASSERT_NE(array, nullptr) << field.name;
    ASSERT_EQ(array->GetNumberOfComponents(), field.components);
    EXPECT_EQ(array->GetDataType(), single ? VTK_FLOAT : VTK_DOUBLE);
    for (std::size_t i = 0; i < field.values.size(); ++i) {
      const auto p = static_cast<vtkIdType>(i) / field.components;
      const auto c = static_cast<int>(static_cast<vtkIdType>(i) % field.components);
      const double expected = single ? double(float(field.values[i])) : field.values[i];
      ASSERT_EQ(array->GetComponent(p, c), expected) << field.name << " " << p << " " << c;
    }
  }
}

TEST(VtkParticles, DoubleFrameComesBackExactly) {
  const TemporaryFolder folder;
  const ParticleSnapshot snapshot = sample_particles(10, 0.1);
  write_particle_frame(folder / "p.vtu", snapshot, FramePrecision::double_);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  vtkUnstructuredGrid* grid = read(*reader, folder / "p.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), 10);
  ASSERT_EQ(grid->GetNumberOfCells(), 10);
  vtkPointData& data = *grid->GetPointData();
  for (vtkIdType p = 0; p < 10; ++p) {
    const auto i = static_cast<std::size_t>(p);
    EXPECT_EQ(grid->GetCellType(p), VTK_VERTEX);
    EXPECT_EQ(grid->GetCell(p)->GetPointId(0), p);
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(grid->GetPoint(p)[c], snapshot.position[3 * i + std::size_t(c)]);
    EXPECT_EQ(data.GetArray("id")->GetTuple1(p), double(snapshot.id[i]));  // below 2^53
    EXPECT_EQ(data.GetArray("material")->GetTuple1(p), snapshot.material[i]);
    EXPECT_EQ(data.GetArray("body")->GetTuple1(p), snapshot.body[i]);
  }
  expect_fields(data, snapshot.fields, false);
  EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.1);
  EXPECT_EQ(grid->GetFieldData()->GetArray("step")->GetTuple1(0), 17);
  EXPECT_STREQ(data.GetArray("stress")->GetComponentName(5), "YZ");
  EXPECT_STREQ(data.GetVectors()->GetName(), "velocity");
}

TEST(VtkParticles, SingleFrameRoundsToNearest) {
  const TemporaryFolder folder;
  ParticleSnapshot snapshot = sample_particles(4, 0.0, 2);
  snapshot.fields[2].values[1] = 1e300;  // beyond float: infinite, and no floating-point trap
  write_particle_frame(folder / "p.vtu", snapshot, FramePrecision::single_);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  vtkUnstructuredGrid* grid = read(*reader, folder / "p.vtu");
  EXPECT_EQ(grid->GetPointData()->GetArray("pressure")->GetTuple1(1),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(grid->GetPoint(3)[2], 0.0);
  snapshot.fields.pop_back();
  expect_fields(*grid->GetPointData(), snapshot.fields, true);
}

/// A metric map projection has northings of millions of metres; floats are half a metre apart
/// there.
TEST(VtkParticles, SingleFramesKeepTheDigitsOfPositions) {
  const TemporaryFolder folder;
  ParticleSnapshot snapshot = sample_particles(4, 0.0, 2);
  for (double& x : snapshot.position) x = 4e6 + x / 3;
  write_particle_frame(folder / "p.vtu", snapshot, FramePrecision::single_);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  vtkUnstructuredGrid* grid = read(*reader, folder / "p.vtu");
  for (vtkIdType p = 0; p < 4; ++p) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(grid->GetPoint(p)[c], snapshot.position[3 * std::size_t(p) + std::size_t(c)]);
    }
  }
}

TEST(VtkParticles, NoParticlesAreAValidFrame) {
  const TemporaryFolder folder;
  write_particle_frame(folder / "p.vtu", sample_particles(0, 1.0), FramePrecision::single_);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  EXPECT_EQ(read(*reader, folder / "p.vtu")->GetNumberOfPoints(), 0);
}

TEST(VtkParticles, BytesAParticle) {
  const TemporaryFolder folder;
  const std::size_t count = 10000;
  write_particle_frame(folder / "p.vtu", sample_particles(count, 0), FramePrecision::single_);
  // position 3 doubles, fields 13 floats; id 8, material 4, body 4; vertex cells: 2 indices of at
  // most 8 bytes and 1 for the type
  const double expected = 4.0 / 3.0 * (8.0 * 3 + 4.0 * 13 + 8 + 4 + 4 + 17);  // base64
  EXPECT_LE(double(std::filesystem::file_size(folder / "p.vtu")) / double(count), expected + 1.0);
}

/// An XML parser must be able to read the whole file: see write_aside_and_rename.
TEST(VtkFrames, AreTextThroughout) {
  const TemporaryFolder folder;
  write_particle_frame(folder / "p.vtu", sample_particles(100, 0.1), FramePrecision::double_);
  write_grid_frame(folder / "g.vti", sample_grid(4, 3, 2, 0.5, "minus"), FramePrecision::double_);
  for (const char* name : {"p.vtu", "g.vti"}) {
    const std::string text = read_text(folder / name);
    EXPECT_NE(text.find("format=\"binary\""), std::string::npos) << name;
    for (const char c : text) ASSERT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << name << int(c);
    EXPECT_EQ(text.find("AppendedData"), std::string::npos) << name;
  }
}

TEST(VtkGrid, LatticeComesBackExactly) {
  const TemporaryFolder folder;
  const GridSnapshot snapshot = sample_grid(4, 3, 2, 0.5, "minus");
  write_grid_frame(folder / "g.vti", snapshot, FramePrecision::double_);
  vtkNew<vtkXMLImageDataReader> reader;
  vtkImageData* image = read(*reader, folder / "g.vti");
  int dimensions[3];
  image->GetDimensions(dimensions);
  EXPECT_EQ(dimensions[0], 4);
  EXPECT_EQ(dimensions[1], 3);
  EXPECT_EQ(dimensions[2], 2);
  // node (i, j, k) = (3, 2, 1) has index (1 * 3 + 2) * 4 + 3
  const double* point = image->GetPoint((1 * 3 + 2) * 4 + 3);
  EXPECT_EQ(point[0], -1.0 + 3 * 0.25);
  EXPECT_EQ(point[1], 2 * 0.25);
  EXPECT_EQ(point[2], 1 * 0.25);
  expect_fields(*image->GetPointData(), snapshot.fields, false);
  EXPECT_EQ(image->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.5);
}

TEST(VtkParticles, FullDiskIsOneSentenceAndLeavesNothing) {
  const TemporaryFolder folder;
  const auto path = folder / "p.vtu";
  const ParticleSnapshot snapshot = sample_particles(2000, 0);
  write_particle_frame(path, snapshot, FramePrecision::double_);
  const auto whole = std::filesystem::file_size(path);
  std::filesystem::remove(path);
  // in the header, in the data, and in the last bytes, which only closing the file writes
  for (const auto bytes : {std::uintmax_t{0}, std::uintmax_t{1000}, whole / 2, whole - 1}) {
    const FileSizeLimit limit(bytes);
    try {
      write_particle_frame(path, snapshot, FramePrecision::double_);
      ADD_FAILURE() << "no fault at " << bytes;
    } catch (const RunFault& fault) {
      EXPECT_TRUE(std::string(fault.what()).starts_with("cannot write " + path.string()))
          << fault.what();
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
}

TEST(VtkParticles, MissingFolderIsOneSentence) {
  try {
    write_particle_frame("/nonexistent/p.vtu", sample_particles(1, 0), FramePrecision::single_);
    ADD_FAILURE() << "no fault";
  } catch (const RunFault& fault) {
    EXPECT_EQ(std::string(fault.what()),
              "cannot write /nonexistent/p.vtu: No such file or directory");
  }
}

}  // namespace
}  // namespace scree
