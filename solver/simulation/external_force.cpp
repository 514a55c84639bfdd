// SPDX-License-Identifier: Apache-2.0
#include "solver/simulation/external_force.hpp"

#include <utility>

namespace scree {

ExternalForce::ExternalForce(BodyForce body_force, const std::vector<TractionSetup>& tractions,
                             int dimension, const std::vector<std::int64_t>& first_id,
                             const std::vector<double>& mass, std::int64_t particles)
    : body_force_(std::move(body_force)), first_load_(std::size_t(particles), -1) {
  for (const TractionSetup& setup : tractions) {
    const auto traction = static_cast<std::int32_t>(tractions_.size());
    tractions_.emplace_back(setup.spec, dimension);
    for (std::size_t i = 0; i < setup.patch.particle.size(); ++i) {
      const double* a = &setup.patch.area_vector[3 * i];
      const std::size_t body = std::size_t(setup.body);
      std::int32_t& first = first_load_[std::size_t(first_id[body] + setup.patch.particle[i])];
      loads_.push_back({traction, first, Vec3<double>{{a[0], a[1], a[2]}}, setup.patch.area[i],
                        mass[body], identity3<double>()});
      first = static_cast<std::int32_t>(loads_.size()) - 1;
    }
  }
}

std::vector<std::int64_t> ExternalForce::loaded_ids() const {
  std::vector<std::int64_t> ids;
  for (std::size_t id = 0; id < first_load_.size(); ++id) {
    if (first_load_[id] >= 0) ids.push_back(std::int64_t(id));
  }
  return ids;
}

void ExternalForce::deform(std::int64_t id, const Mat3<double>& increment) {
  for (std::int32_t i = first_load_[std::size_t(id)]; i >= 0; i = loads_[std::size_t(i)].next) {
    Load& load = loads_[std::size_t(i)];
    load.F = load.F + increment * load.F;
  }
}

std::array<double, 3> ExternalForce::acceleration(std::int64_t id, const double* X, const double* x,
                                                  double t) const {
  std::array<double, 3> sum{};
  if (body_force_) sum = body_force_(X, x, t);
  const Vec3<double> start{{X[0], X[1], X[2]}};
  const Vec3<double> now{{x[0], x[1], x[2]}};
  for (std::int32_t i = first_load_[std::size_t(id)]; i >= 0; i = loads_[std::size_t(i)].next) {
    const Load& load = loads_[std::size_t(i)];
    const Vec3<double> f = tractions_[std::size_t(load.traction)].force(
        t, now, start, load.area_vector, load.area, load.F);
    for (int a = 0; a < 3; ++a) sum[std::size_t(a)] += f[a] / load.mass;
  }
  return sum;
}

Mat3<double> ExternalForce::moment(std::int64_t id, const double* X, const double* x, double t,
                                   double half) const {
  Mat3<double> sum = zero3<double>();
  const Vec3<double> start{{X[0], X[1], X[2]}};
  const Vec3<double> now{{x[0], x[1], x[2]}};
  for (std::int32_t i = first_load_[std::size_t(id)]; i >= 0; i = loads_[std::size_t(i)].next) {
    const Load& load = loads_[std::size_t(i)];
    const double square = dot(load.area_vector, load.area_vector);
    for (int axis = 0; axis < 3; ++axis) {
      const double share = load.area_vector[axis];
      if (share == 0) continue;
      Vec3<double> face{}, place{};
      face[axis] = share;
      place[axis] = share > 0 ? half : -half;
      const Vec3<double> f = tractions_[std::size_t(load.traction)].force(
          t, now, start, face, load.area * share * share / square, load.F);
      const Vec3<double> offset = load.F * place;
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) sum(a, b) += f[a] * offset[b];
      }
    }
  }
  return sum;
}

void ExternalForce::save(StateWriter& writer) const {
  std::vector<double> entries;
  for (const Load& load : loads_) {
    for (int i = 0; i < 9; ++i) entries.push_back(load.F(i / 3, i % 3));
  }
  writer.put("loads/deformation_gradient", entries);
}

void ExternalForce::load(const StateReader& reader) {
  const std::vector<double> entries = reader.get<double>("loads/deformation_gradient");
  for (std::size_t l = 0; l < loads_.size(); ++l) {
    for (int i = 0; i < 9; ++i) loads_[l].F(i / 3, i % 3) = entries.at(9 * l + std::size_t(i));
  }
}

}  // namespace scree
