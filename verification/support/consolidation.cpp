// SPDX-License-Identifier: Apache-2.0
#include "verification/support/consolidation.hpp"

namespace scree::testing {

SimulationSetup column_setup(const SoilColumn& column, bool drained) {
  const double dx = column.cell(), spacing = dx / column.particles;
  const int axis = 1, width = 2;
  SimulationSetup setup =
      make_setup(column.dimension, column.method, dx, {width, column.cells + 3, width});
  for (int a = 0; a < column.dimension; ++a) {
    setup.faces[std::size_t(a)][0] = FaceType::symmetry;
    if (a != axis) setup.faces[std::size_t(a)][1] = FaceType::symmetry;
  }
  const Vector upper(width * dx, column.height, width * dx);
  const auto points = lattice(Vector::Zero(), upper, spacing, column.dimension);
  const Jelly jelly{column.youngs_modulus, column.poissons_ratio, column.density};
  BodySetup& body = add_jelly(setup, points, spacing, jelly, "soil");
  body.pores = column.pores;
  setup.coupling = column.coupling;
  const double area = std::pow(spacing, column.dimension - 1);
  TractionSetup load;
  load.spec.name = "load";
  load.spec.pressure.text = std::to_string(column.load);
  DrainageSetup top;
  top.name = "top";
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points[p][axis] < column.height - spacing) continue;
    load.patch.particle.push_back(std::int64_t(p));
    load.patch.area_vector.insert(load.patch.area_vector.end(), {0, area, 0});
    load.patch.area.push_back(area);
    top.faces.push_back({std::int64_t(p), {0, area, 0}, {0, 0.5 * spacing, 0}});
  }
  if (column.load != 0) setup.tractions.push_back(load);
  if (drained) setup.coupling->drainage.push_back(top);
  return setup;
}

DrainageSetup drained_top(const std::vector<Vector>& points, double height, double spacing,
                          int dimension) {
  DrainageSetup top;
  top.name = "top";
  const double area = std::pow(spacing, dimension - 1);
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points[p][1] < height - spacing) continue;
    top.faces.push_back({std::int64_t(p), {0, area, 0}, {0, spacing / 2, 0}});
  }
  return top;
}

}  // namespace scree::testing
