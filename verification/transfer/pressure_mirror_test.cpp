// SPDX-License-Identifier: Apache-2.0
//
// A wet body against one or two mirror planes is a part of the whole body.
#include <gtest/gtest.h>

#include <cmath>

#include "verification/support/effort.hpp"
#include "verification/support/random.hpp"
#include "verification/support/scene.hpp"

namespace scree::testing {
namespace {

constexpr double dx = 0.1;

struct Case {
  int dimension;
  Method method;
  int planes;  ///< the first axes' faces
  int side;    ///< lower or upper faces
  bool drained;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.dimension << "d_" << c.method << (c.planes == 2 ? "_corner" : "")
             << (c.side == 0 ? "_lower" : "_upper") << (c.drained ? "_drained" : "_sealed");
}

/// Where the planes are, from the lower corner of the part's domain.
double plane(const Case& c) { return c.side == 0 ? 0 : 8 * dx; }

/// The point's image beyond the planes whose bits are set.
Vector image(const Case& c, Vector x, int copy) {
  for (int a = 0; a < c.planes; ++a) {
    if ((copy >> a & 1) != 0) x[a] = 2 * plane(c) - x[a];
  }
  return x;
}

Vector image_direction(Vector v, int copy) {
  for (int a = 0; a < 2; ++a) {
    if ((copy >> a & 1) != 0) v[a] = -v[a];
  }
  return v;
}

/// Particles next to the planes, so irregular that their boxes reach beyond these and each other's
/// cells.
std::vector<Vector> part_of_body(const Case& c) {
  const double between = dx / 2, reach = c.dimension == 2 ? 0.4 : 0.25;
  auto points = lattice(Vector(0, 0, 0.2), Vector(reach, reach, 0.45), between, c.dimension);
  Random random(5);
  for (Vector& x : points) {
    if (c.planes == 1) x[1] += 0.2;
    x += random.vector(0.3 * between, c.dimension);
    if (c.side == 1) {
      for (int a = 0; a < c.planes; ++a) x[a] = plane(c) - x[a];
    }
  }
  return points;
}

/// Faces of the particles farthest from the first plane.
DrainageSetup drain(const Case& c, const std::vector<Vector>& points, std::size_t copies) {
  DrainageSetup drain;
  drain.name = "far";
  const double between = dx / 2, area = std::pow(between, c.dimension - 1);
  const double far = c.dimension == 2 ? 0.35 : 0.2;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (std::abs(points[p][0] - plane(c)) < far) continue;
    for (std::size_t copy = 0; copy < copies; ++copy) {
      const double sign = ((copy & 1) != 0) == (c.side == 0) ? -1 : 1;
      DrainedFace face;
      face.particle = std::int64_t(copy * points.size() + p);
      face.area[0] = sign * area;
      face.offset[0] = sign * between / 2;
      drain.faces.push_back(face);
    }
  }
  return drain;
}

PoreSetup soil_pores() {
  PoreSetup pores;
  pores.porosity = 0.4;
  pores.fluid_modulus = 1e7;
  pores.biot = 0.9;
  pores.mobility = 2e-6;  // some cells in the time of the run
  pores.kozeny_carman = true;
  return pores;
}

/// A domain that ends at the planes, or goes on beyond them.
SimulationSetup domain(const Case& c, bool whole) {
  std::array<int, 3> cells{8, 8, 8};
  Vector lower = Vector::Zero();
  for (int a = 0; a < c.planes && whole; ++a) {
    cells[std::size_t(a)] = 16;
    if (c.side == 0) lower[a] = -8 * dx;
  }
  SimulationSetup setup = make_setup(c.dimension, c.method, dx, cells, lower);
  for (int a = 0; a < c.planes && !whole; ++a) {
    setup.faces[std::size_t(a)][std::size_t(c.side)] = FaceType::symmetry;
  }
  const int along = c.planes;  // in 2D nothing is along two planes
  if (along < c.dimension) {
    setup.gravity = [along](double) {
      std::array<double, 3> g{};
      g[std::size_t(along)] = -9.81;
      return g;
    };
  }
  setup.coupling.emplace();
  setup.coupling->pressure_spacing = 2;
  setup.coupling->tolerance = 1e-14;
  setup.coupling->preconditioner = "icc";
  set_steps(setup, effort(50), 4e-4);
  return setup;
}

struct Result {
  State state;
  std::vector<double> pressure, seepage;
};

Result result_of(const Case& c, bool whole) {
  const auto points = part_of_body(c);
  const std::size_t copies = whole ? std::size_t(1) << c.planes : 1;
  SimulationSetup setup = domain(c, whole);
  std::vector<Vector> all;
  for (std::size_t copy = 0; copy < copies; ++copy) {
    for (const Vector& x : points) all.push_back(image(c, x, int(copy)));
  }
  BodySetup& body = add_jelly(setup, all, dx / 2, {1e6, 0.3, 2000});
  body.pores = soil_pores();
  body.velocity.assign(3 * all.size(), 0.0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vector& x = points[i % points.size()];
    const double s = c.side == 0 ? 1 : -1;
    const Vector v(-s + x[1], 0.5 * s - 2 * x[0], c.dimension == 3 ? 0.3 * x[0] : 0);
    const Vector turned = image_direction(v, int(i / points.size()));
    for (std::size_t a = 0; a < 3; ++a) body.velocity[3 * i + a] = turned[int(a)];
    body.pore_pressure.push_back(1e4 * std::cos(7 * x[0]) * std::cos(5 * x[1] + x[2]));
  }
  if (c.drained) setup.coupling->drainage.push_back(drain(c, points, copies));
  const Schedule schedule = setup.schedule;
  const auto simulation = Simulation::create(std::move(setup));
  run(*simulation, schedule);
  Result result{state_of(*simulation), {}, {}};
  const auto snapshot = simulation->particles({"pore_pressure", "seepage_velocity"});
  result.pressure = field(snapshot, "pore_pressure").values;
  result.seepage = field(snapshot, "seepage_velocity").values;
  result.state.x.resize(points.size());
  result.state.v.resize(points.size());
  result.pressure.resize(points.size());
  result.seepage.resize(3 * points.size());
  return result;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

class PressureMirror : public ::testing::TestWithParam<Case> {};

/// Rounding and a solve to 1e-14 of its right-hand side, times a condition of 1e2, in each of 50
/// steps.
TEST_P(PressureMirror, part_moves_as_the_whole) {
  const Result part = result_of(GetParam(), false), whole = result_of(GetParam(), true);
  EXPECT_LT(distance(part.state.x, whole.state.x), 1e-12 * dx);
  EXPECT_LT(distance(part.state.v, whole.state.v), 1e-12);  // of 1 m/s
  EXPECT_GT(largest(part.pressure), 1e3);
  EXPECT_LT(difference(part.pressure, whole.pressure), 1e-11 * largest(part.pressure));
  EXPECT_GT(largest(part.seepage), 1e-3);
  EXPECT_LT(difference(part.seepage, whole.seepage), 1e-11 * largest(part.seepage));
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Method& method : all_methods()) {
    if (method.kernel != KernelType::compact || !method.affine()) continue;
    for (const int dimension : {2, 3}) {
      for (const int planes : {1, 2}) {
        for (const int side : {0, 1}) {
          for (const bool drained : {false, true}) {
            all.push_back({dimension, method, planes, side, drained});
          }
        }
      }
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(all, PressureMirror, ::testing::ValuesIn(cases()), [](const auto& info) {
  std::ostringstream name;
  name << info.param;
  return name.str();
});

}  // namespace
}  // namespace scree::testing
