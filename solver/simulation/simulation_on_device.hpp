// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "solver/simulation/simulation.hpp"

namespace scree {

class DeviceToolkit;

/// Like Simulation::create, but particles and grid are on a device (null: the processor). Throws
/// UserError where they do not fit there or a law was not compiled for it.
std::unique_ptr<Simulation> create_on_device(SimulationSetup setup,
                                             std::shared_ptr<const DeviceToolkit> device);

}  // namespace scree
