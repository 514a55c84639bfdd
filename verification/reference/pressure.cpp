// SPDX-License-Identifier: Apache-2.0
#include "verification/reference/pressure.hpp"

#include <cmath>

namespace scree::reference {
namespace {

double dot(const PressureStep::Field& a, const PressureStep::Field& b) {
  double sum = 0;
  for (const auto& [node, value] : a) sum += value * b.at(node);
  return sum;
}

/// a + s b
PressureStep::Field plus(PressureStep::Field a, double s, const PressureStep::Field& b) {
  for (auto& [node, value] : a) value += s * b.at(node);
  return a;
}

}  // namespace

PressureStep::PressureStep(Kernel kernel, bool affine, int dimension, double cell_size, int spacing,
                           double offset, std::vector<PorePoint> points)
    : kernel_(kernel),
      affine_(affine),
      dimension_(dimension),
      cell_size_(cell_size),
      spacing_(spacing * cell_size),
      offset_(offset * cell_size),
      points_(std::move(points)) {
  for (const PorePoint& p : points_) {
    Touch touch{stencil(kernel_, p.position, cell_size_, dimension_), {}, hats(p.position)};
    for (const StencilEntry& entry : touch.nodes) {
      touch.gradient.push_back(gradient(entry, p.position));
      mass_[entry.node] += entry.weight * p.mass;
    }
    for (const Hat& hat : touch.hats) nodes_[hat.node] = 0;
    touch_.push_back(std::move(touch));
  }
}

std::vector<PressureStep::Hat> PressureStep::hats(const Vector& x) const {
  std::vector<Hat> result;
  std::array<int, 3> cell{};
  Vector xi = Vector::Zero();
  for (int a = 0; a < dimension_; ++a) {
    const double y = (x[a] - offset_) / spacing_;
    cell[std::size_t(a)] = int(std::floor(y));
    xi[a] = y - std::floor(y);
  }
  for (int k = 0; k < (1 << dimension_); ++k) {
    Hat hat{cell, 1, Vector::Zero()};
    for (int a = 0; a < dimension_; ++a) {
      hat.node[std::size_t(a)] += k >> a & 1;
      hat.value *= (k >> a & 1) ? xi[a] : 1 - xi[a];
    }
    for (int a = 0; a < dimension_; ++a) {
      const double own = (k >> a & 1) ? xi[a] : 1 - xi[a];
      // Off the cell's faces, where no random particle lies, the other factors follow by division.
      hat.slope[a] = ((k >> a & 1) ? 1 : -1) * hat.value / own / spacing_;
    }
    result.push_back(hat);
  }
  return result;
}

Vector PressureStep::gradient(const StencilEntry& entry, const Vector& x) const {
  if (!affine_) return entry.gradient;
  return entry.weight * (inverse_moment_matrix(kernel_, x, cell_size_, dimension_) * entry.offset);
}

double PressureStep::interpolate(const Field& p, const Touch& touch) {
  double value = 0;
  for (const Hat& hat : touch.hats) value += hat.value * p.at(hat.node);
  return value;
}

double PressureStep::divergence(const std::map<Node, Vector>& velocity, const Touch& touch) const {
  double sum = 0;
  for (std::size_t i = 0; i < touch.nodes.size(); ++i) {
    sum += velocity.at(touch.nodes[i].node).dot(touch.gradient[i]);
  }
  return sum / lattice_count(kernel_);
}

std::map<Node, Vector> PressureStep::force(const Field& p) const {
  std::map<Node, Vector> result;
  for (const auto& [node, mass] : mass_) result[node] = Vector::Zero();
  for (std::size_t n = 0; n < points_.size(); ++n) {
    const Touch& touch = touch_[n];
    const double push = points_[n].biot * points_[n].volume * interpolate(p, touch);
    for (std::size_t i = 0; i < touch.nodes.size(); ++i) {
      result[touch.nodes[i].node] += push * touch.gradient[i];
    }
  }
  return result;
}

PressureStep::Field PressureStep::apply(double dt, const Field& p) const {
  std::map<Node, Vector> velocity = force(p);
  for (auto& [node, v] : velocity) v *= dt / mass_.at(node);
  Field result = nodes_;
  for (std::size_t n = 0; n < points_.size(); ++n) {
    const PorePoint& point = points_[n];
    const Touch& touch = touch_[n];
    Vector slope = Vector::Zero();
    for (const Hat& hat : touch.hats) slope += hat.slope * p.at(hat.node);
    const double rate =
        point.storage * interpolate(p, touch) / dt + point.biot * divergence(velocity, touch);
    for (const Hat& hat : touch.hats) {
      result[hat.node] += point.volume * (hat.value * rate + point.mobility * hat.slope.dot(slope));
    }
  }
  return result;
}

PressureStep::Field PressureStep::rhs(double dt, const Vector& gravity) const {
  std::map<Node, Vector> velocity;
  for (const auto& [node, mass] : mass_) velocity[node] = Vector::Zero();
  for (std::size_t n = 0; n < points_.size(); ++n) {
    for (const StencilEntry& entry : touch_[n].nodes) {
      velocity[entry.node] += entry.weight * points_[n].mass * points_[n].velocity;
    }
  }
  for (auto& [node, v] : velocity) v = v / mass_.at(node) + dt * gravity;
  Field result = nodes_;
  for (std::size_t n = 0; n < points_.size(); ++n) {
    const PorePoint& p = points_[n];
    const double rate = p.storage * p.pressure / dt - p.biot * divergence(velocity, touch_[n]);
    for (const Hat& hat : touch_[n].hats) {
      result[hat.node] +=
          p.volume * (hat.value * rate + p.mobility * p.fluid_density * hat.slope.dot(gravity));
    }
  }
  return result;
}

std::vector<double> PressureStep::solve(double dt, const Vector& gravity, double tolerance) {
  Field x = nodes_, r = rhs(dt, gravity), d = r;
  double size = dot(r, r);
  const double enough = tolerance * tolerance * size;
  for (int i = 0; i < 20000 && size > enough; ++i) {
    const Field q = apply(dt, d);
    const double step = size / dot(d, q);
    x = plus(std::move(x), step, d);
    r = plus(std::move(r), -step, q);
    const double next = dot(r, r);
    d = plus(r, next / size, d);
    size = next;
  }
  std::vector<double> result;
  for (const Touch& touch : touch_) result.push_back(interpolate(x, touch));
  return result;
}

}  // namespace scree::reference
