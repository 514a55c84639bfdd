// SPDX-License-Identifier: Apache-2.0
#include "solver/base/problems.hpp"

#include <gtest/gtest.h>

namespace scree {
namespace {

Position place(int line, int column) {
  return {std::make_shared<const std::string>("deck.toml"), line, column};
}

Position option(const std::string& text) {
  return {std::make_shared<const std::string>(text), 0, 0};
}

TEST(Problems, LineHasAllParts) {
  const Problem problem{place(3, 7), "time.end", "-1", "is too small", "above 0 s", "mend it"};
  EXPECT_EQ(to_string(problem),
            "deck.toml:3:7: time.end = -1: is too small; allowed: above 0 s; mend it");
}

TEST(Problems, EmptyPartsAreLeftOut) {
  EXPECT_EQ(to_string({place(1, 2), "time.end", "", "is missing", "", ""}),
            "deck.toml:1:2: time.end: is missing");
  EXPECT_EQ(to_string({option("--set a=1"), "", "", "is wrong", "", ""}), "--set a=1: is wrong");
}

TEST(Problems, AreSortedByPositionOptionsLastAndNotRepeated) {
  Problems problems;
  problems.add({option("--set a=1"), "a", "", "four", "", ""});
  problems.add({place(10, 1), "c", "", "three", "", ""});
  problems.add({place(2, 9), "b", "", "two", "", ""});
  problems.add({place(2, 3), "a", "", "one", "", ""});
  problems.add({place(2, 9), "b", "", "two", "", ""});
  EXPECT_EQ(problems.size(), 5u);
  EXPECT_EQ(problems.text(),
            "deck.toml:2:3: a: one\ndeck.toml:2:9: b: two\ndeck.toml:10:1: c: three\n"
            "--set a=1: a: four\n");
}

TEST(Problems, KnowsWhichKeysAreFaulty) {
  Problems problems;
  problems.add({place(1, 1), "body.a.shape.radius", "", "bad", "", ""});
  problems.add({place(1, 1), "output.fields[1]", "", "bad", "", ""});
  EXPECT_TRUE(problems.any_under("body.a.shape"));
  EXPECT_TRUE(problems.any_under("body.a.shape.radius"));
  EXPECT_TRUE(problems.any_under("output.fields"));
  EXPECT_FALSE(problems.any_under("body.a.sha"));
  EXPECT_FALSE(problems.any_under("body.b"));
}

TEST(DidYouMean, FindsSlipsOfTheKeyboard) {
  const std::vector<std::string> keys{"density", "youngs_modulus", "poissons_ratio", "cfl"};
  EXPECT_EQ(did_you_mean("densty", keys), "density");
  EXPECT_EQ(did_you_mean("desnity", keys), "density");  // two neighbours swapped
  EXPECT_EQ(did_you_mean("young_modulus", keys), "youngs_modulus");
  EXPECT_EQ(did_you_mean("Density", keys), "density");
  EXPECT_EQ(did_you_mean("youngs", keys), "youngs_modulus");  // a beginning
  EXPECT_EQ(did_you_mean("clf", keys), "cfl");
}

TEST(DidYouMean, DoesNotGuessWildly) {
  EXPECT_EQ(did_you_mean("temperature", {"density", "cfl"}), "");
  EXPECT_EQ(did_you_mean("x", {"y", "zz"}), "");
  EXPECT_EQ(did_you_mean("colour", {}), "");
}

}  // namespace
}  // namespace scree
