// SPDX-License-Identifier: Apache-2.0
#include "postproc/colliders/surface_mesh.hpp"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <cerrno>
#include <filesystem>

#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"

namespace scree {
namespace {

using Point = SurfaceMesh::Point;

vtkNew<vtkCellArray> cell_array(const std::vector<SurfaceMesh::Cell>& cells) {
  vtkNew<vtkCellArray> result;
  for (const SurfaceMesh::Cell& cell : cells) {
    result->InsertNextCell(static_cast<int>(cell.size()));
    for (const std::int64_t point : cell) result->InsertCellPoint(static_cast<vtkIdType>(point));
  }
  return result;
}

}  // namespace

std::int64_t SurfaceMesh::add(const std::vector<Point>& more) {
  const auto first = static_cast<std::int64_t>(points.size());
  points.insert(points.end(), more.begin(), more.end());
  return first;
}

std::vector<Point> cut_polygon(const std::vector<Point>& polygon,
                               const std::array<double, 3>& point,
                               const std::array<double, 3>& outward) {
  const auto beyond = [&](const Point& x) {
    double sum = 0;
    for (std::size_t a = 0; a < 3; ++a) sum += (x[a] - point[a]) * outward[a];
    return sum;
  };
  std::vector<Point> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &here = polygon[i], &next = polygon[(i + 1) % polygon.size()];
    const double d = beyond(here), e = beyond(next);
    if (d <= 0) kept.push_back(here);
    if ((d < 0 && e > 0) || (d > 0 && e < 0)) {
      Point crossing;
      for (std::size_t a = 0; a < 3; ++a) crossing[a] = here[a] + d / (d - e) * (next[a] - here[a]);
      kept.push_back(crossing);
    }
  }
  return kept;
}

void write_mesh(const SurfaceMesh& mesh, const std::string& path) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Point& x : mesh.points) points->InsertNextPoint(x.data());
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cell_array(mesh.polygons));
  data->SetLines(cell_array(mesh.lines));
  write_poly_data(*data, path);
}

void write_poly_data(vtkPolyData& data, const std::string& path) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  const std::filesystem::path temporary = aside(path);
  writer->SetFileName(temporary.c_str());
  writer->SetInputData(&data);
  writer->SetDataModeToBinary();
  writer->SetCompressorTypeToNone();
  errno = 0;
  if (writer->Write() == 0 || writer->GetErrorCode() != 0) {
    const int error = errno;
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw RunFault(write_failure(path, error));
  }
  take_name(temporary, path);
}

}  // namespace scree
