// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/base/pack.hpp"

namespace scree {

/// Reads lanes_of<V> consecutive numbers at any address, register by register: a copy of a wider
/// pack would go by way of the stack.
template <class V>
[[gnu::always_inline]] inline V load_any(const Scalar<V>* p) {
  if constexpr (detail::is_split<V>) {
    using Half = typename V::Half;
    return {load_any<Half>(p), load_any<Half>(p + lanes_of<Half>)};
  } else {
    typedef Scalar<V> Loose __attribute__((vector_size(sizeof(typename V::Vector)),
                                           aligned(alignof(Scalar<V>)), may_alias));
    return {typename V::Vector(*reinterpret_cast<const Loose*>(p))};
  }
}

}  // namespace scree
