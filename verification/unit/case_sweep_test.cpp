// SPDX-License-Identifier: Apache-2.0
// What a case's files may say: parameters in braces, sweeps, expectations.
#include <gtest/gtest.h>

#include "solver/deck/document.hpp"
#include "verification/suite/expectation.hpp"
#include "verification/suite/sweep.hpp"

namespace scree::verify {
namespace {

Value document_of(const std::string& text) {
  Problems problems;
  const auto document = parse_document(text, "case.toml", problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
  return document.value_or(Value{});
}

Parameters some_parameters() {
  Parameters parameters;
  parameters.set("cells", 16);
  parameters.set("g", -9.81);
  parameters.set("kernel", "compact");
  return parameters;
}

TEST(CaseParameters, BracesBecomeNumbersTextsAndExpressions) {
  Value deck = document_of(
      "size = \"{4/cells}\"\ncount = \"{2*cells}\"\nkernel = \"{kernel}\"\n"
      "gravity = [0.0, \"{g}*min(t/{cells}, 1)\"]\nplain = \"10 kPa\"\n");
  Problems problems;
  some_parameters().fill(deck, "", problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
  EXPECT_EQ(deck.find("size")->number(), 0.25);
  EXPECT_TRUE(deck.find("count")->is(Value::Kind::integer));
  EXPECT_EQ(deck.find("count")->integer, 32);
  EXPECT_EQ(deck.find("kernel")->text, "compact");
  EXPECT_EQ(deck.find("gravity")->items[1].text, "(-9.81)*min(t/16.0, 1)");
  EXPECT_EQ(deck.find("plain")->text, "10 kPa");
}

TEST(CaseParameters, MistakesNamePlaceAndRepair) {
  Value deck = document_of("a = \"{cels}\"\nb = \"{cells\"\n");
  Problems problems;
  some_parameters().fill(deck, "", problems);
  EXPECT_EQ(problems.text(),
            "case.toml:1:5: a = \"{cels}\": {cels} is no expression: unknown name \"cels\" at "
            "character 1 (did you mean \"cells\"?); allowed: parameters: cells, g\n"
            "case.toml:2:5: b = \"{cells\": a { without its }\n");
}

const char* const sweep_text =
    "[sweep]\nover = \"cells\"\nsize = \"{h/cells}\"\n"
    "[sweep.parameters]\nkernel = \"compact\"\nh = \"{full ? 3 : 2}\"\ncells = 8\ndx = "
    "\"{h/cells}\"\n"
    "[[sweep.series]]\nname = \"a\"\nci = [4, 8]\nfull = [4, 8, 16]\n"
    "[[sweep.series]]\nname = \"b c\"\nwith = { kernel = \"linear\", h = 5 }\nci = 4\n"
    "may_fail = true\n";

TEST(CaseSweep, SeriesBecomeRuns) {
  Problems problems;
  const Sweep sweep = read_sweep(document_of(sweep_text), false, problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
  ASSERT_EQ(sweep.runs.size(), 3u);
  EXPECT_EQ(sweep.runs[1].size, 2.0 / 8);
  EXPECT_EQ(sweep.runs[1].parameters.number("dx"), 2.0 / 8);
  EXPECT_EQ(sweep.runs[1].label, "a, cells = 8");
  EXPECT_EQ(sweep.runs[2].parameters.text("kernel"), "linear");
  EXPECT_EQ(sweep.runs[2].parameters.number("dx"), 5.0 / 4);
  EXPECT_TRUE(sweep.runs[2].may_fail);
  EXPECT_EQ(sweep.runs[2].slug, "b_c_cells_4");
}

TEST(CaseSweep, TheFullVariantHasItsOwnValues) {
  Problems problems;
  const Sweep sweep = read_sweep(document_of(sweep_text), true, problems);
  ASSERT_EQ(sweep.runs.size(), 4u);
  EXPECT_EQ(sweep.runs[2].size, 3.0 / 16);
}

TEST(CaseSweep, UnknownNamesAreReported) {
  Problems problems;
  read_sweep(document_of("[sweep]\nover = \"cels\"\n[sweep.parameters]\ncells = 8\n"
                         "[[sweep.series]]\nname = \"a\"\nci = 1\nwiht = { cells = 1 }\n"),
             false, problems);
  const std::string text = problems.text();
  EXPECT_NE(text.find("\"cels\" is no parameter; allowed: those of sweep.parameters, cells"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("sweep.series.wiht: unknown key"), std::string::npos) << text;
  EXPECT_NE(text.find("did you mean with?"), std::string::npos) << text;
}

TEST(CaseText, AnExpectationSaysOneThingAndWhy) {
  Problems problems;
  read_case_text(
      document_of("title = \"t\"\nphysics = \"p\"\nreference = \"r\"\n"
                  "[[expect]]\nquantity = \"e\"\nat_most = 1\nat_least = 0\nwhy = \"w\"\n"
                  "[[expect]]\nquantity = \"e\"\nat = [1, 2]\nat_most = [1, 2, 3]\n"),
      problems);
  const std::string text = problems.text();
  EXPECT_NE(text.find("says several things at once: at_most, at_least"), std::string::npos) << text;
  EXPECT_NE(text.find("expect.why: is missing"), std::string::npos) << text;
  EXPECT_NE(text.find("has 3 numbers; allowed: one number, or one for each entry of `at`"),
            std::string::npos)
      << text;
}

TEST(CaseText, OtherCodesHaveANumberForEachRun) {
  Problems problems;
  const CaseText text = read_case_text(
      document_of("title = \"t\"\nphysics = \"p\"\nreference = \"r\"\n"
                  "[[expect]]\nquantity = \"e\"\nat_most = 1\nwhy = \"w\"\n"
                  "[[peer]]\ncode = \"c\"\nquantity = \"e\"\nseries = \"a\"\nat = [8, 16]\n"
                  "value = [0.1, 0.05]\nsource = \"s\"\n"
                  "[[peer]]\ncode = \"d\"\nquantity = \"e\"\nseries = \"a\"\nat = [8, 16]\n"
                  "value = 0.1\n"),
      problems);
  ASSERT_EQ(text.peers.size(), 2u);
  EXPECT_EQ(text.peers[0].values, (std::vector<double>{0.1, 0.05}));
  const std::string found = problems.text();
  EXPECT_NE(found.find("peer.value: has not one number for each entry of `at`"), std::string::npos)
      << found;
  EXPECT_NE(found.find("peer.source: is missing"), std::string::npos) << found;
}

}  // namespace
}  // namespace scree::verify
