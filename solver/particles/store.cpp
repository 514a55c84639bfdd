// SPDX-License-Identifier: Apache-2.0
#include "solver/particles/store.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scree {

template <int D, class T>
ParticleStore<D, T>::ParticleStore(int fields, int aux, std::vector<T> padding)
    : fields_(fields), aux_(aux), padding_(std::move(padding)) {}

template <int D, class T>
void ParticleStore<D, T>::fill_padding(std::int32_t b, int lane) {
  T* p = batch(b);
  for (int f = 0; f < fields_; ++f) {
    p[f * width + lane] = f < D ? T(home_begin + 0.5 * block_cells) : padding_[f];
  }
  T* aux = aux_batch(b);
  for (int f = 0; f < aux_; ++f) aux[f * width + lane] = T(0);
  ids(b)[lane] = -1;
}

template <int D, class T>
void ParticleStore<D, T>::reserve(std::int64_t particles) {
  const std::size_t lanes = (std::size_t(particles) + width - 1) / width * width;
  ids_.reserve(lanes);
  pool_.reserve(lanes * std::size_t(fields_));
  aux_pool_.reserve(lanes * std::size_t(aux_));
}

template <int D, class T>
std::int32_t ParticleStore<D, T>::take_batch() {
  std::int32_t b = 0;
  if (!free_.empty()) {
    b = free_.back();
    free_.pop_back();
  } else {
    b = static_cast<std::int32_t>(ids_.size() / width);
    if (ids_.size() == ids_.capacity())
      reserve(std::int64_t(ids_.size() + ids_.size() / 8 + width));
    ids_.resize(ids_.size() + width);
    pool_.resize(pool_.size() + std::size_t(fields_) * width);
    aux_pool_.resize(aux_pool_.size() + std::size_t(aux_) * width);
  }
  for (int lane = 0; lane < width; ++lane) fill_padding(b, lane);
  return b;
}

template <int D, class T>
std::size_t ParticleStore<D, T>::find_or_add(std::uint64_t key) {
  const auto end = blocks_.begin() + std::ptrdiff_t(sorted_);
  const auto less = [](const Block& b, std::uint64_t k) { return b.key < k; };
  const auto it = std::lower_bound(blocks_.begin(), end, key, less);
  if (it != end && it->key == key) return std::size_t(it - blocks_.begin());
  // New blocks of one rebin stay few and unsorted at the end; the last one is the likeliest.
  for (std::size_t i = blocks_.size(); i > sorted_; --i) {
    if (blocks_[i - 1].key == key) return i - 1;
  }
  if (blocks_.size() - sorted_ > 32) {
    finish_blocks();
    return find_or_add(key);
  }
  blocks_.push_back(Block{key, 0, {}});
  return blocks_.size() - 1;
}

template <int D, class T>
std::int64_t ParticleStore<D, T>::append(std::uint64_t key, std::int64_t id) {
  Block& block = blocks_[find_or_add(key)];
  if (block.count == std::int32_t(block.batches.size()) * width)
    block.batches.push_back(take_batch());
  const std::int64_t s = slot(block, block.count++);
  ids_[std::size_t(s)] = id;
  ++count_;
  return s;
}

template <int D, class T>
void ParticleStore<D, T>::copy_slot(std::int64_t from, std::int64_t to) {
  for (int f = 0; f < fields_; ++f) value(to, f) = value(from, f);
  for (int f = 0; f < aux_; ++f) aux_value(to, f) = aux_value(from, f);
  ids_[std::size_t(to)] = ids_[std::size_t(from)];
}

template <int D, class T>
void ParticleStore<D, T>::remove_slot(Block& block, std::int32_t index, Outbox& outbox) {
  const std::int64_t last = slot(block, block.count - 1);
  if (index != block.count - 1) copy_slot(last, slot(block, index));
  fill_padding(std::int32_t(last / width), int(last % width));
  --block.count;
  ++outbox.removed;
  if (block.count == std::int32_t(block.batches.size() - 1) * width) {
    outbox.freed.push_back(block.batches.back());
    block.batches.pop_back();
  }
}

template <int D, class T>
void ParticleStore<D, T>::collect(Block& block, const std::array<std::int32_t, D>& wrap,
                                  Outbox& outbox) {
  BlockCoord<D> home = block_coord<D>(block.key);
  for (std::int32_t i = 0; i < block.count;) {
    const std::int64_t s = slot(block, i);
    if (ids_[std::size_t(s)] < 0) {
      remove_slot(block, i, outbox);
      continue;
    }
    BlockCoord<D> target = home;
    for (int a = 0; a < D; ++a) {
      T& u = value(s, a);
      if (wrap[a] > 0) {
        const T absolute = T(block_cells) * T(home[a]) + u;
        if (absolute < T(0)) u += T(wrap[a]);
        if (absolute >= T(wrap[a])) u -= T(wrap[a]);
      }
      const int shift = int(std::floor((u - T(home_begin)) / T(block_cells)));
      target[a] += shift;
      u -= T(block_cells * shift);
    }
    if (target == home) {
      ++i;
      continue;
    }
    outbox.key.push_back(block_key<D>(target));
    outbox.id.push_back(ids_[std::size_t(s)]);
    for (int f = 0; f < fields_; ++f) outbox.record.push_back(value(s, f));
    for (int f = 0; f < aux_; ++f) outbox.record.push_back(aux_value(s, f));
    remove_slot(block, i, outbox);
  }
}

template <int D, class T>
void ParticleStore<D, T>::deliver(const Outbox& outbox) {
  const std::size_t stride = std::size_t(fields_) + std::size_t(aux_);
  for (std::size_t n = 0; n < outbox.key.size(); ++n) {
    const std::int64_t s = append(outbox.key[n], outbox.id[n]);
    const T* record = outbox.record.data() + n * stride;
    for (int f = 0; f < fields_; ++f) value(s, f) = record[f];
    for (int f = 0; f < aux_; ++f) aux_value(s, f) = record[fields_ + f];
  }
}

template <int D, class T>
bool ParticleStore<D, T>::rebin(const std::array<std::int32_t, D>& wrap, ThreadPool& pool) {
  std::vector<std::uint64_t> before;
  for (const Block& block : blocks_) before.push_back(block.key);
  constexpr std::size_t together = 16;  // blocks an outbox, whatever the threads
  std::vector<Outbox> outboxes((blocks_.size() + together - 1) / together);
  pool.for_each(std::int64_t(outboxes.size()), [&](std::int64_t o, int) {
    const std::size_t first = std::size_t(o) * together;
    const std::size_t last = std::min(first + together, blocks_.size());
    for (std::size_t b = first; b < last; ++b) collect(blocks_[b], wrap, outboxes[std::size_t(o)]);
  });
  for (const Outbox& outbox : outboxes) {
    free_.insert(free_.end(), outbox.freed.begin(), outbox.freed.end());
    count_ -= outbox.removed;
  }
  for (const Outbox& outbox : outboxes) deliver(outbox);
  finish_blocks();
  const auto same = [](const Block& block, std::uint64_t key) { return block.key == key; };
  return !std::equal(blocks_.begin(), blocks_.end(), before.begin(), before.end(), same);
}

template <int D, class T>
void ParticleStore<D, T>::finish_blocks() {
  std::erase_if(blocks_, [](const Block& b) { return b.count == 0; });
  std::sort(blocks_.begin(), blocks_.end(),
            [](const Block& a, const Block& b) { return a.key < b.key; });
  sorted_ = blocks_.size();
  batch_begin_.assign(1, 0);
  batch_list_.clear();
  counts_.clear();
  for (const Block& block : blocks_) {
    batch_list_.insert(batch_list_.end(), block.batches.begin(), block.batches.end());
    batch_begin_.push_back(static_cast<std::int32_t>(batch_list_.size()));
    counts_.push_back(block.count);
  }
}

template <int D, class T>
void ParticleStore<D, T>::clear() {
  blocks_.clear();
  free_.clear();
  ids_.clear();
  pool_.clear();
  aux_pool_.clear();
  sorted_ = 0;
  count_ = 0;
  finish_blocks();
}

template <int D, class T>
void ParticleStore<D, T>::resize_aux(int aux) {
  aux_ = aux;
  aux_pool_ = AlignedVector<T>();  // assign alone would keep the old memory
  aux_pool_.resize(std::size_t(aux) * ids_.size(), T(0));
}

template <int D, class T>
std::int64_t ParticleStore<D, T>::bytes() const {
  std::size_t total = (pool_.capacity() + aux_pool_.capacity()) * sizeof(T);
  total += ids_.capacity() * sizeof(std::int64_t);
  total += (batch_list_.capacity() + 2 * batch_begin_.capacity() + free_.capacity()) * 4;
  for (const Block& b : blocks_) total += sizeof(Block) + b.batches.capacity() * 4;
  return static_cast<std::int64_t>(total);
}

template class ParticleStore<2, float>;
template class ParticleStore<2, double>;
template class ParticleStore<3, float>;
template class ParticleStore<3, double>;

}  // namespace scree
