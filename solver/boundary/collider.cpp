// SPDX-License-Identifier: Apache-2.0
#include "solver/boundary/collider.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/base/error.hpp"
#include "solver/io/state_archive.hpp"

namespace scree {
namespace {

/// Distance of a point from a box, 0 inside.
double gap(const Box& box, const Vec3<double>& x) {
  double square = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double at = x[static_cast<int>(a)];
    const double beyond = std::max({box.lower[a] - at, at - box.upper[a], 0.0});
    square += beyond * beyond;
  }
  return std::sqrt(square);
}

}  // namespace

Collider::Collider(const ColliderSpec& spec, int dimension, double cell_size,
                   const Periods& periods)
    : name_(spec.name),
      contact_(spec.contact.type),
      coefficient_(spec.contact.coefficient),
      tolerance_(1e-6 * cell_size),
      shape_(make_shape(spec.shape, dimension)),
      periods_(periods) {
  find_images();
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
  find_images();
}

/// The images that reach into the domain and one more on either side: among them is the one that is
/// nearest to a point of the domain. Of long bodies fewer, which is cheaper.
void Collider::find_images() {
  constexpr double most_periods = 4;
  if (!periods_.any()) return;
  const Box box = shape_->bounds();
  for (std::size_t a = 0; a < 3; ++a) {
    const double period = periods_.length[a];
    const double moved = displacement_[static_cast<int>(a)] - periods_.lower[a];
    const double low = box.lower[a] + moved, high = box.upper[a] + moved;
    if (!(period > 0) || !std::isfinite(high - low)) continue;
    double first = std::ceil(-high / period) - 1;
    double last = std::floor((period - low) / period) + 1;
    if (low <= -period && high >= 2 * period) {
      first = last = 0;
    } else if (high - low > most_periods * period) {
      const double middle = std::round(0.5 - 0.5 * (low + high) / period);
      first = middle - 1;
      last = middle + 1;
    }
    // Of a long body another choice is another body, to which what is remembered says nothing.
    const bool other = first != first_image_[a] || last != last_image_[a];
    if (other && high - low >= 3 * period) travelled_ += high - low;
    first_image_[a] = first;
    last_image_[a] = last;
  }
}

Vec3<double> Collider::at_start(const double x[3]) const {
  return {{x[0] - displacement_[0], x[1] - displacement_[1], x[2] - displacement_[2]}};
}

/// Of images at one distance the one moved least is taken.
Collider::Seen Collider::seen(const double x[3]) const {
  const Vec3<double> own = at_start(x);
  if (!periods_.any()) return {own, shape_->signed_distance(own.v)};
  const Box box = shape_->bounds();
  Seen nearest{own, std::numeric_limits<double>::infinity()};
  double least = 0;
  const auto try_image = [&](double i, double j, double k) {
    const Vec3<double> at{{own[0] - i * periods_.length[0], own[1] - j * periods_.length[1],
                           own[2] - k * periods_.length[2]}};
    if (const double far = gap(box, at); far > 0 && far > nearest.distance) return;
    const double distance = shape_->signed_distance(at.v);
    const double moved = std::abs(i) + std::abs(j) + std::abs(k);
    if (distance > nearest.distance || (distance == nearest.distance && moved >= least)) return;
    nearest = {at, distance};
    least = moved;
  };
  for (double i = first_image_[0]; i <= last_image_[0]; ++i) {
    for (double j = first_image_[1]; j <= last_image_[1]; ++j) {
      for (double k = first_image_[2]; k <= last_image_[2]; ++k) try_image(i, j, k);
    }
  }
  return nearest;
}

double Collider::distance(const double x[3]) const { return seen(x).distance; }

Vec3<double> Collider::unwrapped(const double x[3]) const {
  if (!periods_.any()) return {{x[0], x[1], x[2]}};
  return seen(x).at + displacement_;
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
  const Vec3<double> at = periods_.any() ? seen(x).at : at_start(x);
  Vec3<double> n;
  shape_->normal(at.v, n.v);
  return n;
}

Box Collider::bounds() const {
  Box box = shape_->bounds();
  constexpr double endless = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < 3; ++a) {
    const double moved = displacement_[static_cast<int>(a)];
    box.lower[a] = repeated(a) ? -endless : box.lower[a] + moved;
    box.upper[a] = repeated(a) ? endless : box.upper[a] + moved;
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
  find_images();
}

}  // namespace scree
