// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/bench_suite.hpp"

namespace scree {

// The suite's figures as lines of text; heads come before what they name is measured.

std::string machine_text(const MachineInfo& machine);
std::string bandwidth_head(const SuitePlan& plan);
std::string bandwidth_text(const Bandwidth& bandwidth);
std::string table_head(const TablePlan& plan);
/// share: of the memory's rate that the compact kernel uses.
std::string table_text(const TableRow& row, const std::optional<double>& share);
std::string sweep_head(const SweepPlan& plan);
std::string sweep_text(const SweepPoint& point);
std::string left_out_text(const LeftOut& left);
/// Whether the cost of a particle depends on how many there are.
std::string verdict_text(const SweepPlan& plan, const Sweep& sweep);

}  // namespace scree
