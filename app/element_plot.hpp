// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "solver/element/element_test.hpp"

namespace scree {

/// What a picture of the driver holds near its beginning.
extern const char* const plot_mark;

/// Draws the diagrams of a test (app/element_charts.hpp) into a PNG. Throws RunFault where the file
/// cannot be written.
void plot_element(const ElementDeck& deck, const ElementResult& result, const std::string& path);

}  // namespace scree
