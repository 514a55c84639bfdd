// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/config.hpp"

namespace scree {

/// Number of entries of a material state over scalar or lanes V; the state holds V's only.
template <class State, class V>
inline constexpr int state_entries = int(sizeof(State) / sizeof(V));

/// Reads a material state from consecutive fields, the first at `field`.
template <class State, class V, class G>
SCREE_FN State load_state(const G& g, const typename G::Batch& b, int field) {
  static_assert(sizeof(State) % sizeof(V) == 0, "a material state holds V's only");
  struct Entries {
    V v[state_entries<State, V>];
  } entries;
  for (int i = 0; i < state_entries<State, V>; ++i) entries.v[i] = g.load(b, field + i);
  return __builtin_bit_cast(State, entries);
}

/// Writes a material state to consecutive fields.
template <class V, class State, class G>
SCREE_FN void store_state(G& g, const typename G::Batch& b, int field, const State& state) {
  struct Entries {
    V v[state_entries<State, V>];
  };
  const Entries entries = __builtin_bit_cast(Entries, state);
  for (int i = 0; i < state_entries<State, V>; ++i) g.store(b, field + i, entries.v[i]);
}

}  // namespace scree
