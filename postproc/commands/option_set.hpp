// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace scree {

/// What a command's command line may say: each call declares an option and where its value goes.
/// `names` is "--long" or "-s,--long", `type` the word for its value in the help. The program reads
/// the words; wrong ones are refused before the command runs.
class OptionSet {
 public:
  virtual ~OptionSet() = default;

  /// A word without a name.
  virtual void positional(const char* name, std::string& target, const char* type, const char* doc,
                          bool required = true) = 0;
  virtual void text(const char* names, std::string& target, const char* type, const char* doc,
                    bool required = false) = 0;
  /// Several words, separated by blanks or commas; at least and at most so many.
  virtual void texts(const char* names, std::vector<std::string>& target, const char* type,
                     const char* doc, int least = 1, int most = 1000, bool required = false) = 0;
  /// A text, commas and all; may be given several times.
  virtual void repeated(const char* names, std::vector<std::string>& target, const char* type,
                        const char* doc) = 0;
  /// One of these names.
  virtual void choice(const char* names, std::string& target,
                      const std::vector<std::string>& choices, const char* doc) = 0;
  /// Several of these names.
  virtual void choices(const char* names, std::vector<std::string>& target,
                       const std::vector<std::string>& choices, const char* doc) = 0;
  virtual void number(const char* names, double& target, double low, double high, const char* type,
                      const char* doc) = 0;
  virtual void whole_number(const char* names, int& target, int low, int high, const char* type,
                            const char* doc) = 0;
  virtual void flag(const char* names, bool& target, const char* doc) = 0;
  /// Text under the options in the help.
  virtual void footer(const char* text) = 0;
};

}  // namespace scree
