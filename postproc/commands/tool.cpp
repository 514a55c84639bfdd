// SPDX-License-Identifier: Apache-2.0
#include "postproc/commands/tool.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "solver/base/error.hpp"

extern char** environ;

namespace scree {
namespace {

namespace fs = std::filesystem;

/// PREFIX/share/scree/postproc beside PREFIX/bin/scree, or postproc/ in a folder above the program.
std::optional<fs::path> find_tool(const std::string& script) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return std::nullopt;
  const fs::path installed = program.parent_path().parent_path() / "share/scree/postproc" / script;
  if (fs::exists(installed, error)) return installed;
  for (fs::path above = program.parent_path(); above.has_relative_path();
       above = above.parent_path()) {
    if (fs::exists(above / "postproc" / script, error)) return above / "postproc" / script;
  }
  return std::nullopt;
}

}  // namespace

int run_tool(const std::string& script, const std::vector<std::string>& words) {
  const std::optional<fs::path> path = find_tool(script);
  if (!path) throw RunFault("the script postproc/" + script + " is not beside the program");
  // Debian's own: another python3 in front of it lacks VTK and meshio.
  const std::string python = "/usr/bin/python3";
  std::vector<std::string> command{python, path->string()};
  command.insert(command.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(nullptr);
  pid_t child = 0;
  if (posix_spawn(&child, python.c_str(), nullptr, nullptr, arguments.data(), environ) != 0) {
    throw RunFault(python + " could not be started; install python3");
  }
  int state = 0;
  while (waitpid(child, &state, 0) < 0) {
    if (errno != EINTR) throw RunFault("lost track of " + python);
  }
  return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
}

}  // namespace scree
