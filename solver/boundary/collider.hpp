// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "solver/base/tensor.hpp"
#include "solver/boundary/collider_spec.hpp"
#include "solver/boundary/contact_memory.hpp"
#include "solver/boundary/periods.hpp"
#include "solver/deck/expression.hpp"
#include "solver/particles/shape.hpp"

namespace scree {

class StateReader;
class StateWriter;

/// A rigid body that moves with a prescribed velocity. Within a step it stands where it was at the
/// step's start and has the velocity of the step's middle; set_step, then contact, then advance.
/// Where the domain is periodic, so is the body: it stands in every period, and what leaves at one
/// face comes in at the other. One that reaches a period beyond both faces is not repeated; of one
/// longer than four periods the nearest three images count. Half spaces are not repeated either.
class Collider {
 public:
  /// \param cell_size m; nodes within 1e-6 of it off the surface count as touching, so that a node
  /// on a face aligned with the grid is not lost to rounding
  Collider(const ColliderSpec& spec, int dimension, double cell_size, const Periods& periods = {});

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
  /// Signed distance from the surface, below 0 inside, m.
  double distance(const double x[3]) const;
  /// The point x moved by whole periods to where the image of the body that is nearest to it is the
  /// body itself, m; x itself where nothing is periodic.
  Vec3<double> unwrapped(const double x[3]) const;
  /// A box that holds the body and its images where they stand now, m; infinite in the axes of a
  /// half space and in those where the body is repeated.
  Box bounds() const;
  /// The point about which torques are taken, moving with the body, m.
  Vec3<double> reference_point() const;

  /// The displacement, under "collider/NAME".
  void save(StateWriter& writer) const;
  void load(const StateReader& reader);

 private:
  /// A point as the shape sees it, and the signed distance there, m.
  struct Seen {
    Vec3<double> at{};
    double distance = 0;
  };
  Seen seen(const double x[3]) const;
  Vec3<double> at_start(const double x[3]) const;
  void find_images();
  bool repeated(std::size_t axis) const { return last_image_[axis] > first_image_[axis]; }
  bool surely_beyond(double distance, const ContactMemory& memory) const;

  std::string name_;
  ContactType contact_;
  double coefficient_;
  double tolerance_;
  std::unique_ptr<const Shape> shape_;
  std::vector<Expression> speed_;  ///< dimension of them, or none at rest
  Vec3<double> velocity_{};
  Vec3<double> displacement_{};
  Periods periods_;
  /// By how many periods the images that may meet the domain are moved: whole numbers.
  std::array<double, 3> first_image_{}, last_image_{};
  double travelled_ = 0;  ///< length of the way since the start of the program, m
};

}  // namespace scree
