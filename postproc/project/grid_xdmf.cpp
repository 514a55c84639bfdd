// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "postproc/project/active_cells.hpp"
#include "postproc/project/grid_file.hpp"
#include "solver/io/durable_file.hpp"
#include "solver/io/frame_file.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

std::string data_item(const FrameArray& array, const std::string& place) {
  return fmt::format(
      "<DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"8\" Dimensions=\"{}\">{}/{}"
      "</DataItem>",
      array.type == ElementType::float64 ? "Float" : "Int", fmt::join(array.size, " "), place,
      array.name);
}

/// The values at some of the nodes, in their order.
std::vector<double> values_at(const std::vector<std::int64_t>& nodes,
                              const std::vector<double>& values, int components) {
  std::vector<double> result;
  for (const std::int64_t node : nodes) {
    const double* first = &values[static_cast<std::size_t>(node * components)];
    result.insert(result.end(), first, first + components);
  }
  return result;
}

/// Round the cell, as XDMF wants it, instead of x fastest.
std::vector<std::int64_t> corners_around(const ActiveCells& active) {
  std::vector<std::int64_t> corner = active.corner;
  for (std::size_t face = 0; face < corner.size(); face += 4)
    std::swap(corner[face + 2], corner[face + 3]);
  return corner;
}

/// Writes the arrays aside of `file`; returns their group. Leaves nothing where it fails.
std::string write_arrays(const fs::path& file, double time, const std::vector<FrameArray>& arrays) {
  try {
    FrameFile out = FrameFile::create(aside(file), 1, false);
    return out.add(time, 0, arrays);
  } catch (...) {
    std::error_code ignored;
    fs::remove(aside(file), ignored);
    throw;
  }
}

}  // namespace

void write_xdmf_grid(const std::string& path, const Projection& projection, double time) {
  const ActiveCells active = active_cells(projection);
  const std::vector<std::int64_t> corner = corners_around(active);
  const std::size_t points = active.nodes.size(), cells = corner.size() / active.corners;
  std::vector<SnapshotField> fields = projection.fields;
  fields.push_back({"volume", "m^3", 1, projection.volume});
  for (SnapshotField& field : fields)
    field.values = values_at(active.nodes, field.values, field.components);
  std::vector<FrameArray> arrays{
      {"connectivity", "", {cells, active.corners}, ElementType::int64, corner.data()},
      {"position", "m", {points, 3}, ElementType::float64, active.points.data()}};
  for (const SnapshotField& field : fields) {
    FrameArray array{field.name, field.unit, {points}, ElementType::float64, field.values.data()};
    if (field.components > 1) array.size.push_back(static_cast<std::size_t>(field.components));
    arrays.push_back(std::move(array));
  }
  const fs::path file = fs::path(path).replace_extension(".h5");
  const std::string place = file.filename().string() + ":" + write_arrays(file, time, arrays);
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- t = {} s; meshio takes no Time of a single grid -->\n<Xdmf "
      "Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"projection\" GridType=\"Uniform\">\n"
      "      <Topology TopologyType=\"{}\" NumberOfElements=\"{}\">{}</Topology>\n"
      "      <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
      time, active.corners == 4 ? "Quadrilateral" : "Hexahedron", cells,
      data_item(arrays[0], place), data_item(arrays[1], place));
  for (std::size_t i = 2; i < arrays.size(); ++i) {
    const int components = fields[i - 2].components;
    text += fmt::format(
        "      <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n",
        arrays[i].name,
        components == 1   ? "Scalar"
        : components == 3 ? "Vector"
        : components == 9 ? "Tensor"
                          : "Matrix",
        data_item(arrays[i], place));
  }
  take_name(aside(file), file);
  replace_file(path, text + "    </Grid>\n  </Domain>\n</Xdmf>\n");
}

}  // namespace scree
