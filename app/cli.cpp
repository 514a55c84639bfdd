// SPDX-License-Identifier: Apache-2.0
#include "app/cli.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

#include "app/bench_command.hpp"
#include "app/check_command.hpp"
#include "app/describe_command.hpp"
#include "app/element_command.hpp"
#include "app/info_command.hpp"
#include "app/post_command.hpp"
#include "app/run_command.hpp"
#include "generated/build_info.hpp"
#include "solver/base/error.hpp"
#include "solver/base/problems.hpp"
#include "solver/base/units.hpp"

namespace scree {
namespace {

constexpr int user_error = 2;

/// Everything the command line can say.
struct CommandLine {
  CLI::App app{"scree: material point method for geomechanics", "scree"};
  std::function<int()> action;
  RunOptions run;
  CheckOptions check;
  DescribeOptions describe;
  BenchOptions bench;
  ElementOptions element;
  VerifyOptions verify;
  VerifyCommand verify_command;
  std::string until;
};

/// A time of an option: seconds, or a number with a unit.
double parse_time(const std::string& option, const std::string& text) {
  const auto quantity = parse_quantity(text);
  const bool good = quantity && quantity->unknown_unit.empty() && quantity->value >= 0 &&
                    (!quantity->has_unit || quantity->dimension == dimension_of(Unit::time));
  if (!good) {
    throw UserError(option + " " + text + ": must be a time in seconds, e.g. 0.5 or \"500 ms\"");
  }
  return quantity->value;
}

/// What is wrong with the number of an option, or nothing: CLI11's words hold the range of the
/// type.
std::string count_fault(const std::string& text) {
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const bool good = error == std::errc() && stop == end && value >= 0;
  return good ? "" : text + " is not a whole number of at least 0";
}

void add_overrides(CLI::App& command, std::vector<std::string>& overrides) {
  command.add_option("--set", overrides, "Put another value in place of the deck's (repeatable)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
}

void add_run(CommandLine& line) {
  CLI::App& run = *line.app.add_subcommand("run", "Run a deck");
  RunOptions& options = line.run;
  run.add_option("deck", options.deck, "Input deck (TOML)")->required()->type_name("DECK");
  run.add_option("-o,--output", options.output, "Run folder (default: runs/<deck name>)")
      ->type_name("DIR");
  add_overrides(run, options.overrides);
  run.add_option("--backend", options.backend, "Where to compute (default: auto)")
      ->check(CLI::IsMember({"auto", "cpu", "cuda"}))
      ->type_name("auto|cpu|cuda");
  run.add_option("--threads", options.threads, "Number of threads (default: all cores)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  run.add_option("--until", line.until, "Stop after the first step at or past this time")
      ->type_name("T");
  run.add_option("--max-steps", options.max_steps, "Stop after this many steps")
      ->check(&count_fault)
      ->type_name("N");
  auto* resume = run.add_flag("--resume", options.resume, "Continue from the run's checkpoint");
  run.add_flag("--overwrite", options.overwrite, "Replace an existing run")->excludes(resume);
  run.add_flag("--quiet", options.quiet, "Print errors only");
  run.callback([&line] {
    line.action = [&line] {
      if (!line.until.empty()) line.run.until = parse_time("--until", line.until);
      return run_command(line.run);
    };
  });
}

void add_check(CommandLine& line) {
  CLI::App& check = *line.app.add_subcommand("check", "Check a deck and predict the effort");
  check.add_option("deck", line.check.deck, "Input deck (TOML)")->required()->type_name("DECK");
  add_overrides(check, line.check.overrides);
  check.add_option("--threads", line.check.threads, "Number of threads (default: all cores)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  check.callback([&line] { line.action = [&line] { return check_command(line.check); }; });
}

void add_describe(CommandLine& line) {
  CLI::App& describe = *line.app.add_subcommand("describe", "Print the reference of the deck");
  describe.add_option("topic", line.describe.topic, "A table, key or model; all when left out")
      ->type_name("TOPIC");
  auto* markdown = describe.add_flag("--markdown", line.describe.markdown, "As Markdown");
  describe.add_flag("--json-schema", line.describe.json_schema, "As a JSON schema of decks")
      ->excludes(markdown);
  describe.callback([&line] { line.action = [&line] { return describe_command(line.describe); }; });
}

/// The options of `bench` that name one case; they exclude the suite.
void add_bench_case(CLI::App& bench, BenchOptions& options, CLI::Option* suite) {
  const auto choice = [&](const char* name, std::string& target,
                          const std::vector<std::string>& names, const char* doc) {
    bench.add_option(name, target, std::string(doc) + " (default: " + target + ")")
        ->check(CLI::IsMember(names))
        ->type_name(join(names, "|"))
        ->excludes(suite);
  };
  choice("--case", options.case_name, {"elastic", "sand", "fluid", "coupled"}, "What to simulate");
  bench.add_option("--dimension", options.dimension, "Of space (default: 3)")
      ->check(CLI::IsMember({2, 3}))
      ->type_name("2|3")
      ->excludes(suite);
  bench
      .add_option("--steps", options.steps,
                  "Timed steps, with pore water whole strides (default: enough to measure well)")
      ->check(CLI::Range(1, 1'000'000'000))
      ->type_name("N")
      ->excludes(suite);
  bench
      .add_option("--per-direction", options.per_direction,
                  "Particles an axis and cell (default: 2; coupled: 3)")
      ->check(CLI::Range(1, 10))
      ->type_name("N")
      ->excludes(suite);
  choice("--soil", options.soil, {"fixed_corotated", "drucker_prager"}, "Law of the case coupled");
  choice("--precision", options.precision, {"double", "single"}, "Floating-point type");
  choice("--kernel", options.kernel, {"compact", "quadratic"}, "Interpolation kernel");
  choice("--path", options.path, {"automatic", "fused", "split"}, "How a step is computed");
  const char* material_doc = "Print ns a particle of each material law by itself, on one core";
  bench.add_flag("--material-only", options.material_only, material_doc)->excludes(suite);
}

/// A deck in place of a case; it says itself what the other options ask.
void add_bench_deck(CLI::App& bench, BenchOptions& options) {
  auto* deck =
      bench.add_option("--deck", options.deck, "Measure the steps of a deck, without its output")
          ->type_name("DECK");
  for (const char* name : {"--suite", "--case", "--dimension", "--precision", "--kernel", "--path",
                           "--particles", "--material-only"}) {
    deck->excludes(bench.get_option(name));
  }
  add_overrides(bench, options.overrides);
  bench.get_option("--set")->needs(deck);
}

void add_bench(CommandLine& line) {
  CLI::App& bench = *line.app.add_subcommand("bench", "Measure particle updates per second");
  BenchOptions& options = line.bench;
  auto* suite = bench.add_flag("--suite", options.suite,
                               "Measure all cases, precisions and kernels, a sweep of sizes and "
                               "the memory's bandwidth, instead of one case");
  bench.add_flag("--quick", options.quick, "The suite with tiny sizes, to see that it works")
      ->needs(suite);
  add_bench_case(bench, options, suite);
  bench.add_option("--particles", options.particles, "About how many (default: 1000000)")
      ->check(CLI::Range(std::int64_t{8}, std::int64_t{4'000'000'000}))
      ->type_name("N");
  bench.add_option("--threads", options.threads, "Number of threads (default: all cores)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  bench.add_option("--backend", options.backend, "Where to compute (default: cpu)")
      ->check(CLI::IsMember({"auto", "cpu", "cuda"}))
      ->type_name("auto|cpu|cuda");
  bench.add_flag("--json", options.json, "Print one JSON object and nothing else");
  add_bench_deck(bench, options);
  bench.callback([&line] { line.action = [&line] { return bench_command(line.bench); }; });
}

void add_element(CommandLine& line) {
  CLI::App& element =
      *line.app.add_subcommand("element", "Drive a material point along a laboratory test");
  ElementOptions& options = line.element;
  element.add_option("deck", options.deck, "Element deck (TOML)")->required()->type_name("DECK");
  element.add_option("-o,--output", options.output, "Table (default: <deck name>.csv here)")
      ->type_name("FILE.csv");
  element.add_option("--plot", options.plot, "Also draw the diagrams of the test")
      ->type_name("FILE.png");
  add_overrides(element, options.overrides);
  element.add_flag("--overwrite", options.overwrite,
                   "Replace files that scree element did not write, too");
  element.add_flag("--quiet", options.quiet, "Print errors only");
  element.callback([&line] { line.action = [&line] { return element_command(line.element); }; });
}

void add_verify(CommandLine& line) {
  CLI::App& verify =
      *line.app.add_subcommand("verify", "Compare whole runs with closed forms and experiments");
  VerifyOptions& options = line.verify;
  verify.add_option("case", options.cases, "Cases by name (default: all)")->type_name("CASE...");
  verify.add_flag("--list", options.list, "Name all cases, and do nothing else");
  verify.add_flag("--full", options.full, "The fine variant, which takes hours, not minutes");
  verify
      .add_option("-o,--output", options.output,
                  "Folder of the report (default: runs/verify, or runs/verify-full)")
      ->type_name("DIR");
  verify
      .add_option("--threads", options.threads, "Runs at a time (default: all cores; on a GPU 1)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  verify.add_option("--backend", options.backend, "Where to compute (default: cpu)")
      ->check(CLI::IsMember({"auto", "cpu", "cuda"}))
      ->type_name("auto|cpu|cuda");
  verify.callback([&line] { line.action = [&line] { return line.verify_command(line.verify); }; });
}

void build(CommandLine& line, const std::vector<std::string>& words) {
  line.app.require_subcommand(1);
  line.app.set_version_flag("--version", std::string("scree ") + build_info::version);
  line.app.failure_message(CLI::FailureMessage::simple);
  add_run(line);
  add_check(line);
  add_describe(line);
  add_element(line);
  add_post(line.app, line.action, words);
  line.app.add_subcommand("info", "Print version, build, backends and libraries")
      ->callback([&line] { line.action = [] { return info_command(); }; });
  add_bench(line);
  if (line.verify_command) add_verify(line);
  line.app.footer(
      "scree COMMAND --help explains a command. Begin with\n"
      "  scree run inputs/tutorial/sand_column_2d.toml");
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

int complain(const std::string& message) {
  std::fprintf(stderr, "scree: %s\n", message.c_str());
  return user_error;
}

/// What is wrong with the word in the place of a command of `app`, or 0: nothing.
int check_command_word(const CLI::App& app, const std::string& word) {
  const auto names = command_names(app);
  for (const std::string& name : names) {
    if (word == name) return 0;
  }
  const std::string near = did_you_mean(word, names);
  return complain("unknown command \"" + word + "\"; commands: " + join(names) +
                  (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
}

/// The options of a command, as the user writes them.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// One sentence about a wrong command line.
int complain_about(const CLI::ParseError& error, const CLI::App& app,
                   const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  std::string name = "scree";
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    name += " " + command->get_name();
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const auto names = option_names(*command);
    for (const std::string& word : words) {
      const std::string option = word.substr(0, word.find('='));
      if (option.empty() || option[0] != '-' || command->get_option_no_throw(option) != nullptr)
        continue;
      std::string message = "unknown option " + option;
      message.append(" of ").append(name).append("; options: ").append(join(names));
      const std::string near = did_you_mean(option, names);
      if (!near.empty()) message.append("; did you mean ").append(near).append("?");
      return complain(message);
    }
  }
  return complain(std::string(error.what()) + "; see " + name + " --help");
}

/// A full disk or a closed pipe must not pass for success: all that was printed has arrived.
int delivered(int status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  const std::string cause = std::generic_category().message(errno);
  complain("the output could not be written: " + cause);
  return status == 0 ? 1 : status;
}

/// Runs the command and turns exceptions into sentences and exit states.
int guarded(const std::function<int()>& action) {
  try {
    return delivered(action());
  } catch (const UserError& error) {
    return complain(error.what());
  } catch (const RunFault& fault) {
    complain(fault.what());
  } catch (const std::bad_alloc&) {
    complain("not enough memory; coarsen domain.cell_size or particles_per_direction");
  } catch (const std::exception& error) {
    complain(std::string("internal error: ") + error.what());
  }
  return 1;
}

}  // namespace

int scree_main(int argc, const char* const* argv, const VerifyCommand& verify) {
  CommandLine line;
  line.verify_command = verify;
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  build(line, words);
  if (words.empty()) {
    std::cerr << line.app.help();
    return user_error;
  }
  if (words[0].empty() || words[0][0] != '-') {
    if (const int status = check_command_word(line.app, words[0])) return status;
    if (words[0] == "post" && words.size() > 1 && (words[1].empty() || words[1][0] != '-')) {
      const CLI::App& post = *line.app.get_subcommand("post");
      if (const int status = check_command_word(post, words[1])) return status;
    }
  }
  try {
    // What follows "--" is for the library beneath a command.
    std::vector<std::string> own = words[0] == "post" ? before_dashes(words) : words;
    std::reverse(own.begin(), own.end());  // as CLI11 wants them
    line.app.parse(std::move(own));
  } catch (const CLI::Success& request) {  // --help, --version
    return line.app.exit(request);
  } catch (const CLI::ParseError& error) {
    return complain_about(error, line.app, words);
  }
  return guarded(line.action);
}

}  // namespace scree
