// SPDX-License-Identifier: Apache-2.0
#include "postproc/project/grid_file.hpp"

#include <vtkCellArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>

#include "postproc/project/active_cells.hpp"
#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"

namespace scree {
namespace {

/// Adds an array with the values of these nodes.
void add_array(vtkPointData& data, const std::string& name, const std::vector<double>& values,
               int components, const std::vector<std::int64_t>& nodes) {
  static constexpr std::array<const char*, 9> tensor = {"XX", "XY", "XZ", "YX", "YY",
                                                        "YZ", "ZX", "ZY", "ZZ"};
  static constexpr std::array<const char*, 3> vector = {"X", "Y", "Z"};
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(nodes.size()));
  for (int c = 0; c < components; ++c) {
    if (components == 3) array->SetComponentName(c, vector[static_cast<std::size_t>(c)]);
    if (components == 9) array->SetComponentName(c, tensor[static_cast<std::size_t>(c)]);
  }
  double* out = array->GetPointer(0);
  for (const std::int64_t node : nodes) {
    out = std::copy_n(&values[static_cast<std::size_t>(node * components)], components, out);
  }
  data.AddArray(array);
}

void add_arrays(vtkDataSet& data, const Projection& projection, double time,
                const std::vector<std::int64_t>& nodes) {
  for (const SnapshotField& field : projection.fields) {
    add_array(*data.GetPointData(), field.name, field.values, field.components, nodes);
  }
  add_array(*data.GetPointData(), "volume", projection.volume, 1, nodes);
  vtkNew<vtkDoubleArray> time_value;
  time_value->SetName("TimeValue");
  time_value->InsertNextValue(time);
  data.GetFieldData()->AddArray(time_value);
}

/// By way of memory: on a full disk VTK's writers of unstructured grids free what they have not
/// made.
void write(vtkXMLWriter& writer, vtkDataSet& data, const std::string& path) {
  writer.WriteToOutputStringOn();
  writer.SetInputDataObject(&data);
  writer.SetDataModeToBinary();  // as the frames: readable by every ParaView
  writer.SetCompressorTypeToNone();
  writer.SetHeaderTypeToUInt64();
  if (writer.Write() == 0) throw RunFault(write_failure(path, 0));
  replace_file(path, writer.GetOutputString());
}

void write_image(const std::string& path, const Projection& projection, double time) {
  const Lattice& lattice = projection.lattice;
  vtkNew<vtkImageData> image;
  image->SetOrigin(lattice.origin.data());
  image->SetSpacing(lattice.spacing, lattice.spacing, lattice.spacing);
  image->SetDimensions(static_cast<int>(lattice.nodes(0)), static_cast<int>(lattice.nodes(1)),
                       static_cast<int>(lattice.nodes(2)));
  std::vector<std::int64_t> nodes(static_cast<std::size_t>(lattice.node_count()));
  vtkNew<vtkUnsignedCharArray> hidden;
  hidden->SetName(vtkDataSetAttributes::GhostArrayName());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    nodes[n] = static_cast<std::int64_t>(n);
    hidden->InsertNextValue(projection.volume[n] > 0 ? 0 : vtkDataSetAttributes::HIDDENPOINT);
  }
  add_arrays(*image, projection, time, nodes);
  image->GetPointData()->AddArray(hidden);
  vtkNew<vtkXMLImageDataWriter> writer;
  write(*writer, *image, path);
}

void write_cells(const std::string& path, const Projection& projection, double time) {
  const ActiveCells active = active_cells(projection);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t p = 0; p < active.points.size(); p += 3)
    points->InsertNextPoint(&active.points[p]);
  vtkNew<vtkCellArray> cells;
  for (std::size_t c = 0; c < active.corner.size(); ++c) {
    if (c % active.corners == 0) cells->InsertNextCell(static_cast<int>(active.corners));
    cells->InsertCellPoint(static_cast<vtkIdType>(active.corner[c]));
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->SetCells(projection.lattice.dimension == 3 ? VTK_VOXEL : VTK_PIXEL, cells);
  add_arrays(*grid, projection, time, active.nodes);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  write(*writer, *grid, path);
}

}  // namespace

void write_grid_file(const std::string& path, const Projection& projection, double time) {
  if (path.ends_with(".vtu")) {
    write_cells(path, projection, time);
  } else if (path.ends_with(".xdmf")) {
    write_xdmf_grid(path, projection, time);
  } else {
    write_image(path, projection, time);
  }
}

}  // namespace scree
