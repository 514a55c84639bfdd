// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "solver/base/tensor.hpp"
#include "solver/boundary/collider_spec.hpp"
#include "solver/boundary/contact_memory.hpp"
#include "solver/deck/expression.hpp"
#include "solver/particles/shape.hpp"

namespace scree {

class StateReader;
class StateWriter;

/// A rigid body that moves with a prescribed velocity. Within a step it stands where it was at the
/// step's start and has the velocity of the step's middle; set_step, then contact, then advance.
class Collider {
 public:
  /// \param cell_size m; nodes within 1e-6 of it off the surface count as touching, so that a node
  /// on a face aligned with the grid is not lost to rounding
  Collider(const ColliderSpec& spec, int dimension, double cell_size);

  const std::string& name() const { return name_; }
  ContactType contact() const { return contact_; }
  double coefficient() const { return coefficient_; }

  /// Takes the velocity at t + dt/2: the motion is then second order accurate, and a point of the
  /// material that sticks to the surface keeps with it exactly.
  /// \throws RunFault if an expression gives no finite number.
  void set_step(double t, double dt);
  /// Moves by dt times the velocity.
  void advance(double dt);

  /// True inside and on the surface.
  bool touches(const double x[3]) const;
  /// Unit vector out of the body.
  Vec3<double> normal(const double x[3]) const;
  /// True if a node at x touches; then with the normal there. Remembers what it finds out.
  bool touches(const double x[3], ContactMemory& memory, Vec3<double>& normal) const;
  /// True if no point within `reach` (m) of x can touch. Remembers the distance of x.
  bool clear_of(const double x[3], double reach, ContactMemory& memory) const;
  /// True if the shape is slow to ask.
  bool costly() const { return shape_->costly(); }
  const Vec3<double>& velocity() const { return velocity_; }          ///< m/s
  const Vec3<double>& displacement() const { return displacement_; }  ///< m, since t = 0
  /// A box that holds the body where it stands now, m; infinite in the axes of a half space.
  Box bounds() const;
  /// The point about which torques are taken, moving with the body, m.
  Vec3<double> reference_point() const;

  /// The displacement, under "collider/NAME".
  void save(StateWriter& writer) const;
  void load(const StateReader& reader);

 private:
  double distance(const double x[3]) const;
  bool surely_beyond(double distance, const ContactMemory& memory) const;

  std::string name_;
  ContactType contact_;
  double coefficient_;
  double tolerance_;
  std::unique_ptr<const Shape> shape_;
  std::vector<Expression> speed_;  ///< dimension of them, or none at rest
  Vec3<double> velocity_{};
  Vec3<double> displacement_{};
  double travelled_ = 0;  ///< length of the way since the start of the program, m
};

}  // namespace scree
