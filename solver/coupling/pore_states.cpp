// SPDX-License-Identifier: Apache-2.0
#include "solver/coupling/pore_states.hpp"

namespace scree {

template <int D>
void PoreStates<D>::begin_order(const std::vector<std::int64_t>& slots) {
  coming_.first.clear();
  std::int64_t total = 0;
  for (const std::int64_t n : slots) {
    coming_.first.push_back(total);
    total += (n + width - 1) / width * width;
  }
  coming_.vectors.resize(std::size_t(total / width));
  coming_.id.assign(std::size_t(total), -1);
  coming_.place.assign(now_.place.size(), -1);
}

template <int D>
void PoreStates<D>::move_pores() {
  for (std::size_t to = 0; to < coming_.id.size(); ++to) {
    const std::int64_t id = coming_.id[to];
    const std::int64_t from = id >= 0 ? place(id) : -1;
    auto& row = coming_.vectors[to / width].row;
    for (int k = 0; k < Row::count; ++k) {
      const bool one = k < D * D ? k % (D + 1) == 0 : k == Row::ratio || k == Row::start_ratio;
      row[k][to % width] = from >= 0 ? at(from, k) : one ? 1.0 : 0.0;
    }
  }
  std::swap(now_, coming_);
  coming_ = {};  // memory that waits for the next order would count twice
}

template class PoreStates<2>;
template class PoreStates<3>;

}  // namespace scree
