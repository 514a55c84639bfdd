// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "solver/element/element_test.hpp"

namespace scree {

/// What a picture of the driver holds near its beginning.
extern const char* const plot_mark;

/// Draws the four diagrams of a test into a PNG: stress against strain, stress path with yield
/// surface, volume (or pore pressure) against strain, and void ratio against ln p or stress ratio
/// against strain. Throws RunFault where the file cannot be written.
void plot_element(const ElementDeck& deck, const ElementResult& result, const std::string& path);

}  // namespace scree
