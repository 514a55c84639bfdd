// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "solver/device/chosen_kernels.cuh"
#include "solver/device/grid_kernels.cuh"
#include "solver/device/particle_kernels.cuh"
#include "solver/device/split.cuh"
#include "solver/transfer/compact.hpp"
#include "solver/transfer/linear.hpp"
#include "solver/transfer/quadratic.hpp"

namespace scree {
inline namespace SCREE_SIDE {

SCREE_SPLIT_LAUNCH(extern, Compact)
SCREE_SPLIT_LAUNCH(extern, Quadratic)
SCREE_SPLIT_LAUNCH(extern, Linear)

/// The kernels of this side.
template <int D, class T>
class KernelsOf final : public DeviceKernels<D, T> {
 public:
  void p2g(KernelType kernel, TransferType transfer, const PassData<D, T>& data,
           int blocks) override {
    if (kernel == KernelType::compact) SplitLaunch<Compact, D, T>::p2g(transfer, data, blocks);
    if (kernel == KernelType::quadratic) SplitLaunch<Quadratic, D, T>::p2g(transfer, data, blocks);
    if (kernel == KernelType::linear) SplitLaunch<Linear, D, T>::p2g(transfer, data, blocks);
  }
  void p2g_fixed(KernelType kernel, TransferType transfer, const PassData<D, T>& data,
                 const FixedChannels& sums, int blocks) override {
    if (kernel == KernelType::compact) {
      SplitLaunch<Compact, D, T>::p2g_fixed(transfer, data, sums, blocks);
    }
    if (kernel == KernelType::quadratic) {
      SplitLaunch<Quadratic, D, T>::p2g_fixed(transfer, data, sums, blocks);
    }
    if (kernel == KernelType::linear) {
      SplitLaunch<Linear, D, T>::p2g_fixed(transfer, data, sums, blocks);
    }
  }
  void from_fixed(const FixedChannels& sums, int channel, std::int64_t values, T* out) override {
    launch("from_fixed", kernels::from_fixed<T>, blocks_for(values), block_threads, sums, channel,
           values, out);
  }
  void g2p(KernelType kernel, TransferType transfer, const PassData<D, T>& data,
           int blocks) override {
    if (kernel == KernelType::compact) SplitLaunch<Compact, D, T>::g2p(transfer, data, blocks);
    if (kernel == KernelType::quadratic) SplitLaunch<Quadratic, D, T>::g2p(transfer, data, blocks);
    if (kernel == KernelType::linear) SplitLaunch<Linear, D, T>::g2p(transfer, data, blocks);
  }
  void summarise(const BlockResult<T>* results, int blocks, BodySummary<T>* out) override {
    launch("summarise", kernels::summarise<T>, 1, block_threads, results, blocks, out);
  }

  void add_forces(const NodePass<T>& pass, int lattices, double* block_mass,
                  double* mass) override {
    launch("add_forces", kernels::add_forces<D, T>, pass.blocks, block_threads, pass, block_mass);
    launch("sum_up", kernels::sum_up<double>, 1, block_threads, block_mass, pass.blocks,
           1.0 / lattices, mass);
  }
  void fold(const FoldLines& lines, int stage, T* p, T* before) override {
    launch("fold", kernels::fold<D, T>, blocks_for(lines.lines), block_threads, lines, stage, p,
           before);
  }
  void fold_periodic(const FoldLines& lines, T* p) override {
    launch("fold_periodic", kernels::fold_periodic<T>, blocks_for(lines.lines), block_threads,
           lines, p);
  }
  void unfold(const FoldLines& lines, int stage, T* p, T* q) override {
    launch("unfold", kernels::unfold<D, T>, blocks_for(lines.lines), block_threads, lines, stage, p,
           q);
  }
  void divide(const NodePass<T>& pass) override {
    launch("divide", kernels::divide<D, T>, blocks_for_nodes(pass), block_threads, pass);
  }
  void subtract(const NodePass<T>& pass) override {
    launch("subtract", kernels::subtract<D, T>, blocks_for_nodes(pass), block_threads, pass);
  }
  void touch(const ContactNodes& nodes, const ContactSurface* surfaces,
             const NodePass<T>& pass) override {
    launch("touch", kernels::touch<D, T>, blocks_for(nodes.nodes), block_threads, nodes, surfaces,
           pass);
  }
  void damp(const NodePass<T>& pass, const ContactNodes& nodes) override {
    launch("damp", kernels::damp<D, T>, blocks_for_nodes(pass), block_threads, pass);
    launch("settle", kernels::settle<D, T>, blocks_for(nodes.nodes), block_threads, nodes, pass.p);
  }
  void react(const ContactSums& sums, const ContactSurface* surfaces, const double* impulse,
             double* reactions) override {
    launch("react", kernels::react<double>, sums.colliders, block_threads, sums, surfaces, impulse,
           reactions);
  }
  void carry_over(const std::int32_t* from_block, int blocks, int block_values, const T* from,
                  T* to) override {
    launch("carry_over", kernels::carry_over<T>, blocks, block_threads, from_block, block_values,
           from, to);
  }

  void find_homes(const PassData<D, T>& data, int blocks, const std::int32_t* wrap,
                  std::uint64_t* keys, std::int32_t* values) override {
    kernels::Wrap cells{{0, 0, 0}};
    for (int a = 0; a < D; ++a) cells.cells[a] = wrap[a];
    launch("find_homes", kernels::find_homes<D, T>, blocks, block_threads, data, cells, keys,
           values);
  }
  void move(const ParticlePools<T>& from, const ParticlePools<T>& to, int blocks,
            const std::int32_t* order, const std::int32_t* first, const std::int32_t* counts,
            const std::int32_t* batch_begin) override {
    launch("move", kernels::move<T>, blocks, block_threads, from, to, order, first, counts,
           batch_begin);
  }
  void find_chosen(const PassData<D, T>& data, int blocks, const ChosenRows<T>& chosen) override {
    launch("find_chosen", kernels::find_chosen<D, T>, blocks, block_threads, data, chosen);
  }
  void read_chosen(const PassData<D, T>& data, const ChosenRows<T>& chosen) override {
    launch("read_chosen", kernels::read_chosen<D, T>, blocks_for(chosen.count), block_threads, data,
           chosen);
  }
  void write_chosen(const PassData<D, T>& data, const ChosenRows<T>& chosen) override {
    launch("write_chosen", kernels::write_chosen<D, T>, blocks_for(chosen.count), block_threads,
           data, chosen);
  }

 private:
  static int blocks_for_nodes(const NodePass<T>& pass) {
    return blocks_for(std::int64_t(pass.blocks) * pass.block_nodes);
  }
};

}  // namespace SCREE_SIDE
}  // namespace scree
