// SPDX-License-Identifier: Apache-2.0
#include "app/post_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "postproc/commands/command.hpp"
#include "solver/base/error.hpp"
#include "solver/base/problems.hpp"

namespace scree {
namespace {

/// Declares a command's options to CLI11.
class CliOptions : public OptionSet {
 public:
  explicit CliOptions(CLI::App& app) : app_(app) {}

  void positional(const char* name, std::string& target, const char* type, const char* doc,
                  bool required) override {
    app_.add_option(name, target, doc)->required(required)->type_name(type);
  }
  void text(const char* names, std::string& target, const char* type, const char* doc,
            bool required) override {
    app_.add_option(names, target, doc)->required(required)->type_name(type);
  }
  void texts(const char* names, std::vector<std::string>& target, const char* type, const char* doc,
             int least, int most, bool required) override {
    app_.add_option(names, target, doc)
        ->required(required)
        ->expected(least, most)
        ->delimiter(',')
        ->type_name(type);
  }
  void repeated(const char* names, std::vector<std::string>& target, const char* type,
                const char* doc) override {
    app_.add_option(names, target, doc)->expected(1)->take_all()->type_name(type);
  }
  void choice(const char* names, std::string& target, const std::vector<std::string>& choices,
              const char* doc) override {
    app_.add_option(names, target, doc)
        ->check(CLI::IsMember(choices))
        ->type_name(join(choices, "|"));
  }
  void choices(const char* names, std::vector<std::string>& target,
               const std::vector<std::string>& choices, const char* doc) override {
    app_.add_option(names, target, doc)
        ->delimiter(',')
        ->check(CLI::IsMember(choices))
        ->type_name(join(choices, "|"));
  }
  void number(const char* names, double& target, double low, double high, const char* type,
              const char* doc) override {
    app_.add_option(names, target, doc)->check(CLI::Range(low, high))->type_name(type);
  }
  void whole_number(const char* names, int& target, int low, int high, const char* type,
                    const char* doc) override {
    app_.add_option(names, target, doc)->check(CLI::Range(low, high))->type_name(type);
  }
  void flag(const char* names, bool& target, const char* doc) override {
    app_.add_flag(names, target, doc);
  }
  void footer(const char* text) override { app_.footer(text); }

 private:
  CLI::App& app_;
};

}  // namespace

std::vector<std::string> before_dashes(const std::vector<std::string>& words) {
  return {words.begin(), std::find(words.begin(), words.end(), "--")};
}

void add_post(CLI::App& app, std::function<int()>& action, const std::vector<std::string>& words) {
  CLI::App& post = *app.add_subcommand("post", "Analyse a finished or running run");
  post.require_subcommand(1);
  post.footer("scree post COMMAND --help explains a command.");
  PostWords rest;
  const auto dashes = std::find(words.begin(), words.end(), "--");
  rest.dashes = dashes != words.end();
  if (rest.dashes) rest.after_dashes.assign(dashes + 1, words.end());
  for (const PostCommand& command : post_commands()) {
    CLI::App& sub = *post.add_subcommand(command.name, command.summary);
    CliOptions options(sub);
    const auto run = command.declare(options);
    const bool takes_options = command.takes_library_options;
    sub.callback([&action, run, rest, takes_options, name = std::string(command.name)] {
      action = [run, rest, takes_options, name] {
        if (rest.dashes && !takes_options) {
          throw UserError("scree post " + name + " takes nothing after --");
        }
        return run(rest);
      };
    });
  }
}

}  // namespace scree
