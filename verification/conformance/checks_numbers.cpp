// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "verification/conformance/checks.hpp"
#include "verification/support/floating_point_traps.hpp"

namespace scree::testing {

namespace {

template <class T>
Sym3<double> widened(const Sym3<T>& a) {
  return {double(a.xx), double(a.xy), double(a.xz), double(a.yy), double(a.yz), double(a.zz)};
}

template <class T>
State widened(const Entries<T>& a) {
  State r;
  std::copy(a.begin(), a.end(), r.begin());
  return r;
}

template <class T>
double run_distance(const Law& law, const LaneRun<T>& a, const LaneRun<T>& b) {
  if (a.admissible != b.admissible) return 1;
  if (!a.admissible) return 0;
  const double c = double(b.wave_speed);
  const double scale = std::max({law.stiffness, density * c * c, norm(widened(b.stress))});
  return std::max({norm(widened(a.stress) - widened(b.stress)) / scale,
                   distance_of_entries(widened(a.state), widened(b.state)),
                   std::abs(double(a.wave_speed) / c - 1),
                   std::abs(double(a.energy_density) - double(b.energy_density)) / scale,
                   std::abs(double(a.volume_ratio) / double(b.volume_ratio) - 1)});
}

}  // namespace

template <class T>
Worst lanes_against_scalars(const Law& law, const LaneLaw<T>& lanes, int width,
                            MatrixSource& source, int count) {
  Worst worst;
  const FloatingPointTraps traps;
  std::vector<LaneRun<T>> runs(std::size_t(width), LaneRun<T>{});
  for (int n = 0; n < count; ++n) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
      const Eigen::Matrix3d first = strong_gradient(source) - one, second = source.entries(0.1);
      const bool undeformed = int(i) == n % width;
      runs[i].first = undeformed ? zero3<T>() : from_eigen<T>(first);
      runs[i].second = undeformed ? zero3<T>() : from_eigen<T>(second);
    }
    std::vector<LaneRun<T>> alone = runs;
    lanes.run(width, runs.data());
    for (std::size_t i = 0; i < runs.size(); ++i) {
      lanes.run(1, &alone[i]);
      worst.add(run_distance(law, runs[i], alone[i]));
    }
  }
  return worst;
}
template Worst lanes_against_scalars<double>(const Law&, const LaneLaw<double>&, int, MatrixSource&,
                                             int);
template Worst lanes_against_scalars<float>(const Law&, const LaneLaw<float>&, int, MatrixSource&,
                                            int);

Worst single_against_double(const Law& law, MatrixSource& source, int count) {
  Worst worst;
  for (int n = 0; n < count; ++n) {
    State state = state_of_any_size(law, source, 0.05);
    Entries<float> single;
    for (std::size_t i = 0; i < single.size(); ++i) state[i] = single[i] = float(state[i]);
    const Mat3<float> L = from_eigen<float>(source.entries(0.05));
    Mat3<double> same;
    for (int k = 0; k < 9; ++k) same(k / 3, k % 3) = double(L(k / 3, k % 3));
    const Sym3<double> tau = law.exact->kirchhoff(state, same, 0.01);
    const Sym3<float> rounded = law.single->kirchhoff(single, L, 0.01f);
    if (!law.exact->admissible(state)) continue;
    worst.add(norm(widened(rounded) - tau) / stress_scale(law, state, tau));
    worst.add(std::abs(double(law.single->wave_speed(single)) / law.exact->wave_speed(state) - 1));
  }
  return worst;
}

namespace {

/// True if the laws answer some path differently.
bool differ(const Law& a, const Law& b, MatrixSource source) {
  for (int n = 0; n < 60; ++n) {
    const double compression = std::pow(10, source.uniform(-4, -1));
    State x = a.exact->initial(), y = b.exact->initial();
    for (int step = 0; step < 5; ++step) {
      const double squeeze = step == 0 && n % 3 != 0 ? compression : 0;
      const Eigen::Matrix3d L = source.entries(compression) - squeeze * Eigen::Matrix3d::Identity();
      const Sym3<double> tau = advance(a, x, L), other = advance(b, y, L);
      if (norm(tau - other) > 1e-7 * norm(tau) || distance_of_entries(x, y) > 1e-7) return true;
    }
  }
  return false;
}

/// True if a tenth more or less of this number changes the law.
bool matters(const Family& family, const std::any& input, const std::string& key,
             const MatrixSource& source) {
  const auto value = family.number(input, key);
  if (!value || *value == 0) return false;
  for (const double factor : {0.9, 1.1}) {
    const auto other = family.changed(input, key, factor * *value);
    if (other && differ(family.make(input), family.make(*other), source)) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> idle_keys(const Family& family, MatrixSource& source) {
  std::vector<std::string> idle;
  for (const auto& entry : family.schema->entries()) {
    if (entry->kind != EntryKind::number) continue;
    const bool useful = std::any_of(
        family.inputs.begin(), family.inputs.end(),
        [&](const std::any& input) { return matters(family, input, entry->key, source); });
    if (!useful) idle.push_back(entry->key);
  }
  return idle;
}

}  // namespace scree::testing
