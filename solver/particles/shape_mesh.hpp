// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "solver/geometry/mesh_solid.hpp"
#include "solver/particles/shape.hpp"

namespace scree {

/// The solid within a closed triangulated surface; 3D only.
class MeshShape final : public Shape {
 public:
  explicit MeshShape(std::shared_ptr<const MeshSolid> solid) : Shape(3), solid_(std::move(solid)) {}
  double signed_distance(const double x[3]) const override { return solid_->signed_distance(x); }
  bool inside(const double x[3]) const override { return solid_->inside(x); }
  void normal(const double x[3], double n[3]) const override { solid_->normal(x, n); }
  Box bounds() const override { return {solid_->lower(), solid_->upper()}; }
  bool costly() const override { return true; }
  const MeshSolid& solid() const { return *solid_; }

 private:
  std::shared_ptr<const MeshSolid> solid_;
};

}  // namespace scree
