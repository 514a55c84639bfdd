// SPDX-License-Identifier: Apache-2.0
// scree post colliders: the surfaces of a run's colliders for ParaView.
#include <fmt/format.h>

#include <memory>

#include "postproc/colliders/collider_files.hpp"
#include "postproc/commands/command.hpp"
#include "postproc/commands/options.hpp"
#include "solver/base/error.hpp"

namespace scree {
namespace {

struct CollidersOptions {
  std::string run, output;
  bool quiet = false;
};

int run_colliders_command(CollidersOptions options) {
  const Run run(options.run);
  if (options.output.empty()) options.output = (run.folder() / "colliders.pvd").string();
  if (extension_of(options.output) != "pvd") {
    throw UserError("-o " + options.output + ": the name must end in .pvd");
  }
  check_target(options.output, run);
  const Value* deck = run.deck().find("collider");
  if (deck == nullptr || deck->items.empty()) {
    throw UserError(options.run + " has no colliders: its deck has no [collider.NAME]");
  }
  const std::vector<double>& times = run.frames().times();
  FrameProgress progress("colliders: frame", times.size(), options.quiet);
  const ColliderFiles written =
      write_colliders(run, times, options.output, [&](std::size_t done) { progress.done(done); });
  if (!options.quiet) {
    fmt::print("{}\ncolliders: {}, of which {} move; {} files\n", options.output, written.colliders,
               written.moving, written.files);
  }
  return 0;
}

std::function<int(const PostWords&)> declare(OptionSet& set) {
  const auto shared = std::make_shared<CollidersOptions>();
  set.positional("run", shared->run, "RUN", "Run folder");
  set.text("-o,--output", shared->output, "FILE.pvd",
           "List of the surfaces at the times of the frames (default: colliders.pvd in the run "
           "folder); the surfaces lie in FILE_files beside it");
  set.flag("--quiet", shared->quiet, "Print errors only");
  return [shared](const PostWords&) { return run_colliders_command(*shared); };
}

}  // namespace

PostCommand post_colliders() {
  return {"colliders", "Surfaces of the colliders and the terrain for ParaView", false, &declare};
}

}  // namespace scree
