// SPDX-License-Identifier: Apache-2.0
#include <vtkCell.h>
#include <vtkContourFilter.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>

#include "postproc/colliders/surface_mesh.hpp"
#include "postproc/surface/level_set.hpp"

namespace scree {
namespace {

double distance(const double* a, const double* b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Length of a line's piece, area of a triangle (Heron).
double size_of(vtkPolyData& surface, vtkIdType cell) {
  vtkIdType count = 0;
  const vtkIdType* points = nullptr;
  surface.GetCellPoints(cell, count, points);
  double x[3][3] = {};
  for (vtkIdType i = 0; i < count && i < 3; ++i) surface.GetPoint(points[i], x[i]);
  if (count == 2) return distance(x[0], x[1]);
  const double a = distance(x[0], x[1]), b = distance(x[1], x[2]), c = distance(x[2], x[0]);
  const double s = 0.5 * (a + b + c);
  return std::sqrt(std::max(0.0, s * (s - a) * (s - b) * (s - c)));
}

}  // namespace

SurfaceMeasure write_surface(const LevelSet& level, const std::string& path) {
  const Lattice& lattice = level.lattice;
  vtkNew<vtkImageData> image;
  image->SetOrigin(lattice.origin.data());
  image->SetSpacing(lattice.spacing, lattice.spacing, lattice.spacing);
  image->SetDimensions(static_cast<int>(lattice.nodes(0)), static_cast<int>(lattice.nodes(1)),
                       static_cast<int>(lattice.nodes(2)));
  vtkNew<vtkDoubleArray> fraction;
  fraction->SetName("volume_fraction");
  for (const double value : level.fraction) fraction->InsertNextValue(value);
  image->GetPointData()->SetScalars(fraction);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.5);
  contour->Update();
  vtkPolyData& surface = *contour->GetOutput();
  SurfaceMeasure measure;
  measure.pieces = static_cast<std::size_t>(surface.GetNumberOfCells());
  for (vtkIdType c = 0; c < surface.GetNumberOfCells(); ++c) measure.size += size_of(surface, c);
  if (path.empty()) return measure;
  write_poly_data(surface, path);
  return measure;
}

}  // namespace scree
