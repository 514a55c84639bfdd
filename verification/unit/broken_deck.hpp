// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "solver/deck/deck.hpp"

/// A good deck and ways to break it.
namespace scree::testing_decks {

/// Plane strain, one body of sand. Tests count its lines from 1.
inline const char* const good_deck = R"~(title = "base"
[domain]
dimension = 2
lower = [0.0, 0.0]
upper = [0.8, 0.3]
cell_size = 0.005
[time]
end = 1.0
cfl = 0.4
[method]
kernel = "compact"
transfer = "mls"
gravity = [0.0, -9.81]
[material.sand]
model = "drucker_prager"
density = 1600
youngs_modulus = "2 MPa"
poissons_ratio = 0.3
friction_angle = "31 deg"
[body.column]
material = "sand"
shape = { type = "box", lower = [0.0, 0.0], upper = [0.1, 0.2] }
[boundary]
x_min = "slip"
y_min = { type = "friction", coefficient = 0.6 }
[output]
every = "20 ms"
fields = ["velocity", "stress"]
)~";

/// The good deck with another text in place of one line.
inline std::string with_line(int number, const std::string& replacement) {
  std::istringstream lines(good_deck);
  std::string text;
  int i = 0;
  for (std::string line; std::getline(lines, line);) {
    text += (++i == number ? replacement : line) + "\n";
  }
  return text;
}

/// The whole report of a deck.
inline std::string problems_of(const std::string& text,
                               const std::vector<std::string>& overrides = {}) {
  Problems problems;
  read_deck_text(text, "deck.toml", overrides, problems);
  return problems.text();
}

/// One line of the good deck, what it is replaced by, and what must be reported, word for word.
struct BrokenDeck {
  int line;
  const char* replacement;
  const char* report;
};

/// Names the case in gtest's output.
inline std::ostream& operator<<(std::ostream& stream, const BrokenDeck& deck) {
  return stream << "line " << deck.line << ": " << deck.replacement;
}

class BrokenDecks : public testing::TestWithParam<BrokenDeck> {};

}  // namespace scree::testing_decks
