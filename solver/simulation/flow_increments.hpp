// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "solver/coupling/coupled_flow.hpp"
#include "solver/exec/thread_pool.hpp"
#include "solver/particles/store.hpp"

namespace scree {

/// What a step did to the particles themselves, before their laws get a mean of it: the volume of
/// the pores follows the one, so that no water is lost, the effective stress the other. `field`: of
/// dt grad v in the store's aux batches.
template <int D, class T>
void note_increments(const ParticleStore<D, T>& store, int field, CoupledFlow<D>& flow,
                     ThreadPool& pool) {
  constexpr int width = ParticleStore<D, T>::width;
  const auto& blocks = store.blocks();
  pool.for_each(std::int64_t(blocks.size()), [&](std::int64_t number, int) {
    const auto& block = blocks[std::size_t(number)];
    for (int i = 0; i < block.count; ++i) {
      const std::int32_t batch = block.batches[std::size_t(i / width)];
      const T* aux = store.aux_batch(batch) + field * width + i % width;
      std::array<double, D * D> increment;
      for (int k = 0; k < D * D; ++k) increment[std::size_t(k)] = double(aux[k * width]);
      flow.note_increment(store.ids(batch)[i % width], increment);
    }
  });
}

}  // namespace scree
