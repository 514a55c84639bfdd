// SPDX-License-Identifier: Apache-2.0
#include "postproc/colliders/run_colliders.hpp"

#include <cmath>

#include "postproc/colliders/shape_surface.hpp"
#include "solver/base/error.hpp"
#include "solver/base/schema.hpp"
#include "solver/deck/expression.hpp"

namespace scree {
namespace {

/// The integral of the velocity from t = 0 to each of the times, by the rule of midpoints as in a
/// run, with 64 parts between two times.
std::vector<std::array<double, 3>> ways(const ColliderSpec& spec, int dimension,
                                        const std::vector<double>& times) {
  constexpr int parts = 64;
  std::vector<Expression> speed;
  for (int a = 0; a < dimension; ++a) {
    const Formula& formula = spec.velocity[static_cast<std::size_t>(a)];
    speed.emplace_back(formula.given() ? formula.text : "0", std::vector<std::string>{"t"});
  }
  std::vector<std::array<double, 3>> result;
  std::array<double, 3> way{};
  double before = 0;
  for (const double time : times) {
    const double step = (time - before) / parts;
    for (int i = 0; i < parts && step > 0; ++i) {
      const double middle = before + (i + 0.5) * step;
      for (std::size_t a = 0; a < speed.size(); ++a) way[a] += step * speed[a](&middle);
    }
    before = time;
    result.push_back(way);
  }
  return result;
}

}  // namespace

RunCollider::RunCollider(const Run& run, ColliderSpec spec, const std::vector<double>& times)
    : spec_(std::move(spec)),
      dimension_(run.dimension()),
      lower_(run.lower()),
      upper_(run.upper()),
      moves_(false),
      displacement_(ways(spec_, dimension_, times)) {
  for (const auto& d : displacement_) moves_ = moves_ || d != std::array<double, 3>{};
}

bool RunCollider::terrain() const { return spec_.shape.kind == ShapeKind::heightmap; }

SurfaceMesh RunCollider::surface(std::size_t k) const {
  const std::array<double, 3>& d = displacement_[k];
  try {
    if (spec_.shape.kind == ShapeKind::plane) {  // ends at the domain wherever it stands
      ShapeSpec moved = spec_.shape;
      for (std::size_t a = 0; a < 3; ++a) moved.point[a] += d[a];
      return shape_surface(moved, dimension_, {lower_, upper_});
    }
    if (!at_start_) at_start_ = shape_surface(spec_.shape, dimension_, {lower_, upper_});
  } catch (const UserError& error) {
    throw UserError("collider." + spec_.name + ": " + error.what());
  }
  SurfaceMesh mesh = *at_start_;
  for (auto& point : mesh.points)
    for (std::size_t a = 0; a < 3; ++a) point[a] += d[a];
  return mesh;
}

std::vector<RunCollider> run_colliders(const Run& run, const std::vector<double>& times) {
  std::vector<RunCollider> result;
  const Value* colliders = run.deck().find("collider");
  if (colliders == nullptr) return result;
  SchemaContext context;
  context.dimension = run.dimension();
  Problems problems;
  SchemaReader reader(context, problems);
  for (const Value& table : colliders->items) {
    ColliderSpec spec;
    reader.read(collider_schema(), &spec, table, "collider." + table.key);
    spec.name = table.key;
    if (problems.empty()) result.emplace_back(run, std::move(spec), times);
  }
  if (!problems.empty())
    throw UserError("the colliders of the run cannot be drawn: " + problems.text());
  return result;
}

}  // namespace scree
