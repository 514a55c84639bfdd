// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "solver/exec/executor.hpp"
#include "solver/particles/store.hpp"
#include "solver/simulation/method.hpp"
#include "solver/step/pass_data.hpp"

namespace scree {

/// What a body is, whatever its material's type.
struct BodyInfo {
  std::string name;
  std::string material;  ///< deck name of the material
  std::string model;     ///< name of its law
  std::int32_t body_index = 0;
  std::int32_t material_index = 0;
  double particle_volume = 0;         ///< reference volume V0 [m^3] (2D: m^2)
  double density = 0;                 ///< [kg/m^3]
  double undrained_bulk_modulus = 0;  ///< of the pore water [Pa]; 0: no pore pressure
  double particle_mass() const { return density * particle_volume; }
};

/// One entry of a material's state, for output.
struct StateColumn {
  std::string name;
  std::string unit;
  int components = 1;
  int first = 0;  ///< index of its first entry within the state
  bool output = true;
};

/// A body: particles of one material, with the passes that depend on the material's type.
template <int D, class T>
class Body {
 public:
  using Blocks = std::vector<std::int32_t>;

  Body(BodyInfo info, int state_fields, std::vector<T> padding, std::vector<StateColumn> columns)
      : info_(std::move(info)),
        columns_(std::move(columns)),
        store_(D + state_fields, 0, std::move(padding)) {}
  virtual ~Body() = default;

  /// Fused pass over the blocks of one colour (mls; compact or quadratic).
  virtual void g2p2g(Executor&, const PassData<D, T>&, const Blocks&, KernelType) const = 0;
  /// Material update over blocks, from the stored dt grad v.
  virtual void stress(Executor&, const PassData<D, T>&, const Blocks&) const = 0;
  /// Safe bound of the wave speed of the undeformed material [m/s], with its pore water and with
  /// what its viscosity adds at this cell size [m].
  virtual double initial_signal_speed(double cell_size) const = 0;
  /// For the first `active` particles of a batch: total volume ratio J and elastic energy per
  /// reference volume, that of the pore water included [J/m^3].
  virtual void evaluate(const T* batch, int active, double* volume_ratio,
                        double* energy_density) const = 0;

  const BodyInfo& info() const { return info_; }
  const std::vector<StateColumn>& columns() const { return columns_; }
  ParticleStore<D, T>& store() { return store_; }
  const ParticleStore<D, T>& store() const { return store_; }

 private:
  BodyInfo info_;
  std::vector<StateColumn> columns_;
  ParticleStore<D, T> store_;
};

/// Makes a body of the law `info.model`; input: the law's Input struct.
/// Throws UserError for a law that this build does not hold.
template <int D, class T>
std::unique_ptr<Body<D, T>> make_body(const BodyInfo& info, const std::any& input);

extern template std::unique_ptr<Body<2, float>> make_body(const BodyInfo&, const std::any&);
extern template std::unique_ptr<Body<2, double>> make_body(const BodyInfo&, const std::any&);
extern template std::unique_ptr<Body<3, float>> make_body(const BodyInfo&, const std::any&);
extern template std::unique_ptr<Body<3, double>> make_body(const BodyInfo&, const std::any&);

}  // namespace scree
