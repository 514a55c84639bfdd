// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "solver/particles/shape_spec.hpp"

namespace scree {

/// An axis-aligned box, m. In 2D the third axis is [0, 0]; an unbounded axis is infinite.
struct Box {
  std::array<double, 3> lower{};
  std::array<double, 3> upper{};

  /// True if every one of the first `dimension` axes is finite.
  bool bounded(int dimension) const;
};

/// A solid given by its signed distance. In 2D the third coordinate is ignored everywhere.
/// Immutable, so it may be asked from any number of threads at once.
class Shape {
 public:
  explicit Shape(int dimension) : dimension_(dimension) {}
  virtual ~Shape() = default;
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;

  /// Distance to the surface, m, negative inside. Exact for box, sphere, cylinder, polygon,
  /// plane and mesh. For heightmaps and combinations it has the right sign everywhere and vanishes
  /// on the surface; its size is a lower bound of the distance (combinations: min and max of the
  /// parts).
  virtual double signed_distance(const double x[3]) const = 0;

  /// Unit vector out of the solid along the gradient of the signed distance. Where the gradient is
  /// not unique (edges, corners, centres, axes) one of its limits is returned, always the same (at
  /// edges and corners of a mesh a mean of them). A heightmap gives the normal of its terrain.
  virtual void normal(const double x[3], double n[3]) const = 0;

  /// A box that holds the solid, m: tight, except that a difference keeps its first part's box and
  /// an intersection the common part of the boxes.
  virtual Box bounds() const = 0;

  /// A point that stands for the whole solid, m: the centre of its bounds, 0 in an unbounded axis,
  /// except that a plane gives its own point.
  virtual std::array<double, 3> reference_point() const;

  /// True strictly inside.
  virtual bool inside(const double x[3]) const { return signed_distance(x) < 0; }

  /// True if a question takes microseconds: a caller that asks often should keep the answers.
  virtual bool costly() const { return false; }

  int dimension() const { return dimension_; }

 private:
  int dimension_;
};

/// What is wrong with a shape: the deck key (relative to the shape's table), and the sentence.
struct ShapeProblem {
  std::string key;
  std::string message;
};

/// The first mistake in `spec` (a negative radius, an empty box, too few corners, ...), or nothing.
std::optional<ShapeProblem> find_problem(const ShapeSpec& spec, int dimension);

/// Builds a shape. In 2D a sphere is a disk, and a cylinder the strip of width 2 radius that
/// runs from `from` to `to`, cut off square at both ends.
/// \throws UserError with find_problem's sentence.
std::unique_ptr<Shape> make_shape(const ShapeSpec& spec, int dimension);

}  // namespace scree
