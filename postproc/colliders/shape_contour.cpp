// SPDX-License-Identifier: Apache-2.0
// Outlines and surfaces of shapes that are known by their signed distance alone.
#include <vtkCell.h>
#include <vtkContourFilter.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>

#include "postproc/colliders/shape_surface.hpp"
#include "postproc/project/lattice.hpp"

namespace scree {
namespace {

using Point = SurfaceMesh::Point;

/// Over the box and a cell beyond it.
Lattice lattice_over(const Box& box, int dimension, int cells) {
  Lattice lattice;
  lattice.dimension = dimension;
  double longest = 0;
  const auto axes = static_cast<std::size_t>(dimension);
  for (std::size_t a = 0; a < axes; ++a) longest = std::max(longest, box.upper[a] - box.lower[a]);
  lattice.spacing = longest / cells;
  for (std::size_t a = 0; a < axes; ++a) {
    const double size = box.upper[a] - box.lower[a];
    lattice.cells[a] = static_cast<std::int64_t>(std::ceil(size / lattice.spacing - 1e-9)) + 2;
    lattice.origin[a] = box.lower[a] - lattice.spacing;
  }
  return lattice;
}

Point place_of(const Lattice& lattice, const std::array<std::int64_t, 3>& at) {
  Point x{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(lattice.dimension); ++a)
    x[a] = lattice.origin[a] + lattice.spacing * static_cast<double>(at[a]);
  return x;
}

std::vector<double> distances(const Shape& shape, const Lattice& lattice) {
  std::vector<double> result(static_cast<std::size_t>(lattice.node_count()));
  for (std::int64_t n = 0; n < lattice.node_count(); ++n) {
    const Point x = place_of(lattice, lattice.node_place(n));
    result[static_cast<std::size_t>(n)] = shape.signed_distance(x.data());
  }
  return result;
}

/// A corner of a cell and the distance there.
struct Corner {
  Point x;
  double d;
};

/// The part of a cell within the shape, and the piece of outline in it.
void add_cell(SurfaceMesh& mesh, const std::array<Corner, 4>& cell) {
  std::vector<Point> inside, outline;
  for (std::size_t i = 0; i < 4; ++i) {
    const Corner &here = cell[i], &next = cell[(i + 1) % 4];
    if (here.d <= 0) inside.push_back(here.x);
    if ((here.d <= 0) == (next.d <= 0)) continue;
    Point crossing{};
    const double share = here.d / (here.d - next.d);
    for (std::size_t a = 0; a < 3; ++a) crossing[a] = here.x[a] + share * (next.x[a] - here.x[a]);
    inside.push_back(crossing);
    outline.push_back(crossing);
  }
  if (inside.size() < 3) return;
  const std::int64_t first = mesh.add(inside);
  SurfaceMesh::Cell polygon;
  for (std::size_t i = 0; i < inside.size(); ++i)
    polygon.push_back(first + static_cast<std::int64_t>(i));
  mesh.polygons.push_back(polygon);
  for (std::size_t i = 0; i + 1 < outline.size(); i += 2) {
    const std::int64_t piece = mesh.add({outline[i], outline[i + 1]});
    mesh.lines.push_back({piece, piece + 1});
  }
}

}  // namespace

SurfaceMesh contour_2d(const Shape& shape, const Box& box, int cells) {
  const Lattice lattice = lattice_over(box, 2, cells);
  const std::vector<double> distance = distances(shape, lattice);
  const auto corner = [&](std::int64_t i, std::int64_t j) {
    const std::array<std::int64_t, 3> at{i, j, 0};
    return Corner{place_of(lattice, at), distance[static_cast<std::size_t>(lattice.node(at))]};
  };
  SurfaceMesh mesh;
  for (std::int64_t j = 0; j < lattice.cells[1]; ++j) {
    // Cells within the shape side by side become one.
    std::int64_t begin = 0;
    const auto full = [&](std::int64_t i) {
      return i < lattice.cells[0] && corner(i, j).d <= 0 && corner(i + 1, j).d <= 0 &&
             corner(i + 1, j + 1).d <= 0 && corner(i, j + 1).d <= 0;
    };
    for (std::int64_t i = 0; i < lattice.cells[0]; ++i) {
      if (!full(i)) begin = i + 1;
      if (full(i) && full(i + 1)) continue;
      const std::int64_t from = full(i) ? begin : i;
      add_cell(mesh,
               {corner(from, j), corner(i + 1, j), corner(i + 1, j + 1), corner(from, j + 1)});
    }
  }
  return mesh;
}

SurfaceMesh contour_3d(const Shape& shape, const Box& box, int cells) {
  const Lattice lattice = lattice_over(box, 3, cells);
  vtkNew<vtkImageData> image;
  image->SetOrigin(lattice.origin.data());
  image->SetSpacing(lattice.spacing, lattice.spacing, lattice.spacing);
  image->SetDimensions(static_cast<int>(lattice.nodes(0)), static_cast<int>(lattice.nodes(1)),
                       static_cast<int>(lattice.nodes(2)));
  vtkNew<vtkDoubleArray> values;
  for (const double d : distances(shape, lattice)) values->InsertNextValue(d);
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->Update();
  vtkPolyData& surface = *contour->GetOutput();
  SurfaceMesh mesh;
  for (vtkIdType p = 0; p < surface.GetNumberOfPoints(); ++p) {
    Point x;
    surface.GetPoint(p, x.data());
    mesh.points.push_back(x);
  }
  for (vtkIdType c = 0; c < surface.GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    surface.GetCellPoints(c, count, points);
    mesh.polygons.emplace_back(points, points + count);
  }
  return mesh;
}

}  // namespace scree
