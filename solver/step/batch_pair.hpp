// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/tensor.hpp"
#include "solver/simulation/method.hpp"
#include "solver/step/pass_data.hpp"

namespace scree {

/// Batches whose material is updated together. `parts` of them hold particles; where the second
/// does not, it is the first with no active lane.
template <class Batch, int n>
struct BatchSet {
  static constexpr int size = n;
  Batch batch[n];
  int parts;  ///< 1 .. n

  /// Whether batch i is there; the first always is, which the compiler should know.
  SCREE_FN bool holds(int i) const { return i == 0 || i < parts; }
};

/// Two batches of a group as one of twice the lanes, for what has no neighbours: a law is a long
/// chain of operations that wait for each other, and two chains at a time wait half as long.
template <class G>
class PairedGroup {
 public:
  using V = Pack<typename G::Real, 2 * lanes_of<typename G::V>>;
  using Batch = BatchSet<typename G::Batch, 2>;

  SCREE_FN explicit PairedGroup(G& group) : g_(group) {}

  SCREE_FN V load(const Batch& b, int field) const {
    return {g_.load(b.batch[0], field), g_.load(b.batch[1], field)};
  }
  /// The first batch last: the second may be its copy.
  SCREE_FN void store(const Batch& b, int field, const V& x) {
    g_.store(b.batch[1], field, x.high);
    g_.store(b.batch[0], field, x.low);
  }
  SCREE_FN MaskOf<V> active(const Batch& b) const {
    return {g_.active(b.batch[0]), g_.active(b.batch[1])};
  }
  template <int D>
  SCREE_FN void fault(const MaskOf<V>& mask, FaultCode code, const V& value, const V (&u)[D],
                      const Batch& b) {
    if (!any(mask)) return;
    typename G::V low[D];
    typename G::V high[D];
    for (int a = 0; a < D; ++a) {
      low[a] = u[a].low;
      high[a] = u[a].high;
    }
    g_.fault(mask.low, code, value.low, low, b.batch[0]);
    g_.fault(mask.high, code, value.high, high, b.batch[1]);
  }
  SCREE_FN void note_signal(const MaskOf<V>& mask, const V& signal) {
    g_.note_signal(mask.low, signal.low);
    g_.note_signal(mask.high, signal.high);
  }

 private:
  G& g_;
};

/// Part i of the tensors of n batches.
template <int n, class W>
SCREE_FN auto part_of(const Sym3<W>& t, int i) {
  if constexpr (n == 1) {
    (void)i;
    return t;
  } else {
    const auto part = [i](const W& x) { return i == 0 ? x.low : x.high; };
    return Sym3<typename W::Half>{part(t.xx), part(t.xy), part(t.xz),
                                  part(t.yy), part(t.yz), part(t.zz)};
  }
}

}  // namespace scree
