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
  for (const PorePoint& p : points_) occupied_.insert(cell_of(p.position));
  for (const PorePoint& p : points_) {
    Touch touch{stencil(kernel_, p.position, cell_size_, dimension_),
                {},
                hats(cell_of(p.position), p.position),
                flow_points(p)};
    for (const StencilEntry& entry : touch.nodes) {
      touch.gradient.push_back(gradient(entry, p.position));
      mass_[entry.node] += entry.weight * p.mass;
    }
    for (const Hat& hat : touch.hats) nodes_[hat.node] = 0;
    touch_.push_back(std::move(touch));
  }
}

PressureStep::Cell PressureStep::cell_of(const Vector& x) const {
  Cell cell{};
  for (int a = 0; a < dimension_; ++a) {
    cell[std::size_t(a)] = int(std::floor((x[a] - offset_) / spacing_));
  }
  return cell;
}

/// Gauss' two points an axis in each part of the box, exact for products of two hats.
std::vector<PressureStep::FlowPoint> PressureStep::flow_points(const PorePoint& point) const {
  const double side = std::pow(point.volume, 1.0 / dimension_), gauss = std::sqrt(1.0 / 3);
  std::vector<std::pair<Vector, double>> points{{point.position, 1.0}};
  for (int a = 0; a < dimension_; ++a) {
    const double lower = point.position[a] - side / 2, upper = lower + side;
    std::vector<std::pair<double, double>> axis;  // place, share
    for (double from = lower; from < upper - 1e-9 * side;) {
      const double face = offset_ + spacing_ * std::floor((from - offset_) / spacing_ + 1 + 1e-9);
      const double to = std::min(face, upper), middle = (from + to) / 2, half = (to - from) / 2;
      for (const double sign : {-1.0, 1.0}) {
        axis.emplace_back(middle + sign * gauss * half, half / side);
      }
      from = to;
    }
    std::vector<std::pair<Vector, double>> product;
    for (const auto& [x, share] : points) {
      for (const auto& [place, part] : axis) {
        product.emplace_back(x, share * part);
        product.back().first[a] = place;
      }
    }
    points = std::move(product);
  }
  std::vector<FlowPoint> result;
  for (const auto& [x, share] : points) {
    const Cell cell = cell_of(x), own = cell_of(point.position);
    result.push_back({share, hats(occupied_.contains(cell) ? cell : own, x)});
  }
  return result;
}

/// The hats of a cell's corners at x, which may lie outside.
std::vector<PressureStep::Hat> PressureStep::hats(const Cell& cell, const Vector& x) const {
  std::vector<Hat> result;
  Vector xi = Vector::Zero();
  for (int a = 0; a < dimension_; ++a) {
    xi[a] = (x[a] - offset_) / spacing_ - cell[std::size_t(a)];
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
    const double rate =
        point.storage * interpolate(p, touch) / dt + point.biot * divergence(velocity, touch);
    for (const Hat& hat : touch.hats) result[hat.node] += point.volume * hat.value * rate;
    for (const FlowPoint& flow : touch.flow) {
      Vector slope = Vector::Zero();
      for (const Hat& hat : flow.hats) slope += hat.slope * p.at(hat.node);
      const double flux = flow.share * point.volume * point.mobility;
      for (const Hat& hat : flow.hats) result[hat.node] += flux * hat.slope.dot(slope);
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
    for (const Hat& hat : touch_[n].hats) result[hat.node] += p.volume * hat.value * rate;
    for (const FlowPoint& flow : touch_[n].flow) {
      const double weight = flow.share * p.volume * p.mobility * p.fluid_density;
      for (const Hat& hat : flow.hats) result[hat.node] += weight * hat.slope.dot(gravity);
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
