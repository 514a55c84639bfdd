// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace scree {

/// The regular lattice on which particles are placed: site i is the centre of the i-th cell of
/// side `spacing` counted from `lower`, so x = lower + (i + 1/2) spacing.
struct SampleLattice {
  std::array<double, 3> lower{};  ///< m
  double spacing = 0;             ///< m
  int dimension = 3;

  double coordinate(int axis, std::int64_t i) const {
    return lower[axis] + (static_cast<double>(i) + 0.5) * spacing;
  }
  /// The site of a lattice point (exact: a site's own point lies half a spacing from the next).
  std::array<std::int64_t, 3> site(const double x[3]) const;
};

/// A set of sites: one bit for each site of a box.
class SiteSet {
 public:
  /// Sites first[a] <= i < first[a] + count[a]; all absent.
  SiteSet(const std::array<std::int64_t, 3>& first, const std::array<std::int64_t, 3>& count);

  void insert(std::int64_t i, std::int64_t j, std::int64_t k);
  /// Any site may be asked for; those outside the box are absent.
  bool contains(std::int64_t i, std::int64_t j, std::int64_t k) const;
  std::int64_t size() const { return size_; }

 private:
  std::int64_t index(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return (i - first_[0]) + count_[0] * ((j - first_[1]) + count_[1] * (k - first_[2]));
  }

  std::array<std::int64_t, 3> first_, count_;
  std::vector<std::uint64_t> words_;
  std::int64_t size_ = 0;
};

}  // namespace scree
