// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/sampling_lattice.hpp"

#include <cmath>

namespace scree {

std::array<std::int64_t, 3> SampleLattice::site(const double x[3]) const {
  std::array<std::int64_t, 3> at{};
  for (int a = 0; a < dimension; ++a)
    at[a] = static_cast<std::int64_t>(std::floor((x[a] - lower[a]) / spacing));
  return at;
}

SiteSet::SiteSet(const std::array<std::int64_t, 3>& first, const std::array<std::int64_t, 3>& count)
    : first_(first), count_(count) {
  const std::int64_t sites = count[0] * count[1] * count[2];
  words_.resize(static_cast<std::size_t>((sites + 63) / 64), 0);
}

void SiteSet::insert(std::int64_t i, std::int64_t j, std::int64_t k) {
  const std::int64_t n = index(i, j, k);
  std::uint64_t& word = words_[static_cast<std::size_t>(n >> 6)];
  const std::uint64_t bit = std::uint64_t{1} << (n & 63);
  if (!(word & bit)) ++size_;
  word |= bit;
}

bool SiteSet::contains(std::int64_t i, std::int64_t j, std::int64_t k) const {
  const std::int64_t site[3] = {i, j, k};
  for (int a = 0; a < 3; ++a)
    if (site[a] < first_[a] || site[a] >= first_[a] + count_[a]) return false;
  const std::int64_t n = index(i, j, k);
  return (words_[static_cast<std::size_t>(n >> 6)] >> (n & 63)) & 1;
}

}  // namespace scree
