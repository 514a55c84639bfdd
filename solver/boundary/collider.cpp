// SPDX-License-Identifier: Apache-2.0
#include "solver/boundary/collider.hpp"

#include <cmath>

#include "solver/base/error.hpp"
#include "solver/io/state_archive.hpp"

namespace scree {

Collider::Collider(const ColliderSpec& spec, int dimension, double cell_size)
    : name_(spec.name),
      contact_(spec.contact.type),
      coefficient_(spec.contact.coefficient),
      tolerance_(1e-6 * cell_size),
      shape_(make_shape(spec.shape, dimension)) {
  if (!spec.velocity[0].given()) return;
  for (int a = 0; a < dimension; ++a)
    speed_.emplace_back(spec.velocity[a].text, std::vector<std::string>{"t"});
}

void Collider::set_step(double t, double dt) {
  const double middle = t + 0.5 * dt;
  for (std::size_t a = 0; a < speed_.size(); ++a) {
    const double speed = speed_[a](&middle);
    if (!std::isfinite(speed))
      throw RunFault("collider." + name_ + ".velocity: " + speed_[a].text() +
                     " is not finite at t = " + std::to_string(middle) + " s");
    velocity_[static_cast<int>(a)] = speed;
  }
}

void Collider::advance(double dt) {
  displacement_ = displacement_ + velocity_ * dt;
  travelled_ += std::hypot(velocity_[0], velocity_[1], velocity_[2]) * dt;
}

double Collider::distance(const double x[3]) const {
  const double at[3] = {x[0] - displacement_[0], x[1] - displacement_[1], x[2] - displacement_[2]};
  return shape_->signed_distance(at);
}

/// Twice the tolerance: the sums of ways and displacements are rounded.
bool Collider::surely_beyond(double reach, const ContactMemory& memory) const {
  return memory.distance - (travelled_ - memory.travelled) > reach + 2 * tolerance_;
}

bool Collider::clear_of(const double x[3], double reach, ContactMemory& memory) const {
  if (memory.travelled != travelled_ && !surely_beyond(reach, memory)) {
    memory.distance = distance(x);
    memory.travelled = travelled_;
  }
  return surely_beyond(reach, memory);
}

bool Collider::touches(const double x[3], ContactMemory& memory, Vec3<double>& normal) const {
  if (memory.travelled != travelled_) {
    if (surely_beyond(0, memory)) return false;
    memory.distance = distance(x);
    memory.travelled = travelled_;
    if (memory.distance <= tolerance_) memory.normal = this->normal(x);
  }
  normal = memory.normal;
  return memory.distance <= tolerance_;
}

bool Collider::touches(const double x[3]) const { return distance(x) <= tolerance_; }

Vec3<double> Collider::normal(const double x[3]) const {
  const double at[3] = {x[0] - displacement_[0], x[1] - displacement_[1], x[2] - displacement_[2]};
  Vec3<double> n;
  shape_->normal(at, n.v);
  return n;
}

Box Collider::bounds() const {
  Box box = shape_->bounds();
  for (int a = 0; a < 3; ++a) {
    box.lower[a] += displacement_[a];
    box.upper[a] += displacement_[a];
  }
  return box;
}

Vec3<double> Collider::reference_point() const {
  const std::array<double, 3> p = shape_->reference_point();
  return Vec3<double>{{p[0], p[1], p[2]}} + displacement_;
}

void Collider::save(StateWriter& writer) const {
  writer.put("collider/" + name_, std::vector<double>(displacement_.v, displacement_.v + 3));
}

void Collider::load(const StateReader& reader) {
  const std::vector<double> values = reader.get<double>("collider/" + name_);
  const Vec3<double> before = displacement_;
  for (int a = 0; a < 3; ++a) displacement_[a] = values.at(static_cast<std::size_t>(a));
  const Vec3<double> way = displacement_ - before;
  travelled_ += std::hypot(way[0], way[1], way[2]);
}

}  // namespace scree
