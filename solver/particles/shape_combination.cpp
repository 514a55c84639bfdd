// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/shape_combination.hpp"

#include <algorithm>
#include <utility>

namespace scree {

namespace {

/// Index of the part whose signed distance is least (sign = 1) or greatest (sign = -1).
std::size_t extreme_part(const ShapeList& parts, const double x[3], double sign, double& distance) {
  std::size_t best = 0;
  distance = parts[0]->signed_distance(x);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const double d = parts[i]->signed_distance(x);
    if (sign * d < sign * distance) {
      distance = d;
      best = i;
    }
  }
  return best;
}

}  // namespace

bool any_costly(const ShapeList& parts) {
  return std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part->costly(); });
}

UnionShape::UnionShape(ShapeList parts, int dimension)
    : Shape(dimension), parts_(std::move(parts)) {}

double UnionShape::signed_distance(const double x[3]) const {
  double distance = 0;
  extreme_part(parts_, x, 1, distance);
  return distance;
}

bool UnionShape::inside(const double x[3]) const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [&](const auto& part) { return part->inside(x); });
}

void UnionShape::normal(const double x[3], double n[3]) const {
  double distance = 0;
  parts_[extreme_part(parts_, x, 1, distance)]->normal(x, n);
}

Box UnionShape::bounds() const {
  Box box = parts_[0]->bounds();
  for (const auto& part : parts_) {
    const Box other = part->bounds();
    for (int a = 0; a < dimension(); ++a) {
      box.lower[a] = std::min(box.lower[a], other.lower[a]);
      box.upper[a] = std::max(box.upper[a], other.upper[a]);
    }
  }
  return box;
}

IntersectionShape::IntersectionShape(ShapeList parts, int dimension)
    : Shape(dimension), parts_(std::move(parts)) {}

double IntersectionShape::signed_distance(const double x[3]) const {
  double distance = 0;
  extreme_part(parts_, x, -1, distance);
  return distance;
}

bool IntersectionShape::inside(const double x[3]) const {
  return std::all_of(parts_.begin(), parts_.end(),
                     [&](const auto& part) { return part->inside(x); });
}

void IntersectionShape::normal(const double x[3], double n[3]) const {
  double distance = 0;
  parts_[extreme_part(parts_, x, -1, distance)]->normal(x, n);
}

Box IntersectionShape::bounds() const {
  Box box = parts_[0]->bounds();
  for (const auto& part : parts_) {
    const Box other = part->bounds();
    for (int a = 0; a < dimension(); ++a) {
      box.lower[a] = std::max(box.lower[a], other.lower[a]);
      box.upper[a] = std::min(box.upper[a], other.upper[a]);
    }
  }
  // Parts that do not meet leave an empty box, not one turned inside out.
  for (int a = 0; a < dimension(); ++a) box.upper[a] = std::max(box.upper[a], box.lower[a]);
  return box;
}

DifferenceShape::DifferenceShape(ShapeList parts, int dimension)
    : Shape(dimension), parts_(std::move(parts)) {}

double DifferenceShape::side(std::size_t i, const double x[3]) const {
  const double d = parts_[i]->signed_distance(x);
  return i == 0 ? d : -d;
}

double DifferenceShape::signed_distance(const double x[3]) const {
  double distance = side(0, x);
  for (std::size_t i = 1; i < parts_.size(); ++i) distance = std::max(distance, side(i, x));
  return distance;
}

bool DifferenceShape::inside(const double x[3]) const {
  // The surface of the other parts is theirs: not being inside of them is not enough.
  return parts_[0]->inside(x) &&
         std::all_of(parts_.begin() + 1, parts_.end(),
                     [&](const auto& part) { return part->signed_distance(x) > 0; });
}

void DifferenceShape::normal(const double x[3], double n[3]) const {
  std::size_t best = 0;
  double distance = side(0, x);
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    const double d = side(i, x);
    if (d > distance) {
      distance = d;
      best = i;
    }
  }
  parts_[best]->normal(x, n);
  if (best == 0) return;
  for (int a = 0; a < dimension(); ++a) n[a] = -n[a];
}

}  // namespace scree
