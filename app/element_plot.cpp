// SPDX-License-Identifier: Apache-2.0
#include "app/element_plot.hpp"

#include <fmt/format.h>

#include "app/element_charts.hpp"

namespace scree {

const char* const plot_mark = "scree element";

void plot_element(const ElementDeck& deck, const ElementResult& result, const std::string& path) {
  const std::string title = deck.title.empty() ? deck.name : deck.title;
  const std::string subtitle =
      fmt::format("{}, {} steps, {}; compression positive", lab_test_name(deck.driven.type),
                  result.rows.back().step, deck.materials.front().model);
  draw_page(title, subtitle, element_charts(deck, result)).write_png(path, plot_mark);
}

}  // namespace scree
