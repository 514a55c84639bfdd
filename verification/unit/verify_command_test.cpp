// SPDX-License-Identifier: Apache-2.0
// scree verify: exit states, sentences and the files that it leaves.
#include "verification/suite/verify_command.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/cli.hpp"
#include "solver/deck/deck.hpp"
#include "verification/suite/case_code.hpp"
#include "verification/suite/suite.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree::verify {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  int status;
  std::string out, error;
};

Outcome scree(std::vector<std::string> words, const VerifyCommand& command = verify_command) {
  std::vector<const char*> arguments{"scree"};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int status = scree_main(static_cast<int>(arguments.size()), arguments.data(), command);
  std::fflush(stdout);
  return {status, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

bool has_law(const char* name) {
  for (const CaseCode& code : all_cases()) {
    if (code.name == name) return missing_law(plan_case(code, false)).empty();
  }
  return false;
}

TEST(VerifyCommand, EveryCaseCanBePlannedAndSaysWhatItIs) {
  for (const CaseCode& code : all_cases()) {
    for (const bool full : {false, true}) {
      const PlannedCase planned = plan_case(code, full);
      EXPECT_FALSE(planned.text.expectations.empty()) << code.name;
      std::vector<std::string> slugs;
      for (const RunPlan& run : planned.sweep.runs) slugs.push_back(run.slug);
      std::sort(slugs.begin(), slugs.end());
      EXPECT_EQ(std::adjacent_find(slugs.begin(), slugs.end()), slugs.end())
          << code.name << ": two runs would write the same deck";
    }
    EXPECT_GT(plan_case(code, false).sweep.seconds, 0) << code.name;
  }
}

/// The decks are only read here, which costs nothing; ctest runs the cases.
TEST(VerifyCommand, EveryDeckIsValid) {
  for (const CaseCode& code : all_cases()) {
    const PlannedCase planned = plan_case(code, true);
    if (!missing_law(planned).empty() || planned.document.find("path") != nullptr) continue;
    Problems problems;
    for (const RunPlan& run : planned.sweep.runs) {
      const Value deck = deck_of(planned.document, run.parameters, problems);
      if (problems.empty()) read_deck_document(deck, code.name, problems);
      if (!problems.empty()) break;
    }
    EXPECT_TRUE(problems.empty()) << code.name << "\n" << problems.text();
  }
}

TEST(VerifyCommand, ListIsOneLineACase) {
  const Outcome outcome = scree({"verify", "--list"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'),
            static_cast<std::ptrdiff_t>(all_cases().size()));
  EXPECT_EQ(outcome.out.rfind("self_weight_column", 0), 0u);
}

TEST(VerifyCommand, UnknownCasesGetASuggestion) {
  const TemporaryFolder folder;
  const Outcome outcome = scree({"verify", "contact_gab", "-o", (folder / "report").string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.error,
            "scree: there is no case \"contact_gab\"; did you mean \"contact_gap\"? (scree verify "
            "--list names all cases)\n");
  EXPECT_FALSE(fs::exists(folder / "report"));
}

TEST(VerifyCommand, AFolderWithOtherFilesIsRefused) {
  const TemporaryFolder folder;
  write_text(folder / "thesis.txt", "precious");
  const Outcome outcome = scree({"verify", "contact_gap", "-o", folder.path().string()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.error.find("holds other files and no report of scree verify"),
            std::string::npos)
      << outcome.error;
  EXPECT_EQ(read_text(folder / "thesis.txt"), "precious");
}

TEST(VerifyCommand, ARunLeavesItsReportAndIsReplaced) {
  if (!has_law("contact_gap")) GTEST_SKIP() << "left out of this build";
  const TemporaryFolder folder;
  const std::string target = (folder / "report").string();
  for (int i = 0; i < 2; ++i) {
    const Outcome outcome = scree({"verify", "contact_gap", "-o", target, "--threads", "2"});
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.error;
    EXPECT_NE(outcome.out.find("1 of 1 cases passed"), std::string::npos) << outcome.out;
  }
  const std::string html = read_text(folder / "report/report.html");
  EXPECT_NE(html.find("<svg"), std::string::npos);
  EXPECT_EQ(html.find("http://"), html.find("http://www.w3.org/2000/svg")) << "self-contained";
  const auto json = nlohmann::json::parse(read_text(folder / "report/results.json"));
  EXPECT_EQ(json["verdict"], "passed");
  const auto& run = json["cases"][0]["runs"][0];
  Problems problems;
  read_deck((folder / "report/decks/contact_gap" / run["deck"].get<std::string>()).string(), {},
            problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
}

/// The case with one check that no run passes, and one that each does.
CaseCode impossible(CaseCode code) {
  code.expect = R"(title = "Gap"
physics = "two blocks"
reference = "none"
[[expect]]
quantity = "momentum passed on"
series = "compact"
at_most = -1
why = "nothing is below"
[[expect]]
quantity = "momentum passed on"
series = "compact"
at_least = 0
why = "all are above"
)";
  return code;
}

TEST(VerifyCommand, AFailedCheckGivesStatus1AndASentence) {
  if (!has_law("contact_gap")) GTEST_SKIP() << "left out of this build";
  std::vector<CaseCode> known;
  for (const CaseCode& code : all_cases()) {
    if (code.name == "contact_gap") known.push_back(impossible(code));
  }
  const TemporaryFolder folder;
  const auto command = [&](const VerifyOptions& options) { return verify_cases(options, known); };
  const Outcome outcome =
      scree({"verify", "-o", (folder / "report").string(), "--threads", "2"}, command);
  EXPECT_EQ(outcome.status, 1) << outcome.out << outcome.error;
  EXPECT_NE(outcome.out.find("0 of 1 cases passed"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\ncontact_gap: momentum passed on of compact, "), std::string::npos)
      << outcome.out;
  EXPECT_EQ(outcome.out.find("of compact, compact"), std::string::npos) << outcome.out;
  const auto json = nlohmann::json::parse(read_text(folder / "report/results.json"));
  EXPECT_EQ(json["verdict"], "failed");
}

}  // namespace
}  // namespace scree::verify
