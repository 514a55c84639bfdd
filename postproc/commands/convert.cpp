// SPDX-License-Identifier: Apache-2.0
// scree post convert: frames in the formats of other programs.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "postproc/commands/command.hpp"
#include "postproc/commands/options.hpp"
#include "postproc/commands/tool.hpp"
#include "postproc/run/quantity.hpp"
#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"
#include "solver/io/vtk_frame.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

struct ConvertOptions {
  std::string run, output;
  std::vector<std::string> fields;
  TimeOptions time;
  bool quiet = false;
};

/// A particle a row: id, material, body, place, fields with all their components.
std::string table_of(const ParticleSnapshot& frame) {
  static constexpr std::array<const char*, 3> axes = {"x", "y", "z"};
  static constexpr std::array<const char*, 9> tensor = {"xx", "xy", "xz", "yx", "yy",
                                                        "yz", "zx", "zy", "zz"};
  std::string text = "id,material,body,x,y,z";
  for (const SnapshotField& field : frame.fields) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(field.components); ++c) {
      text += "," + field.name;
      if (field.components == 3) text += std::string(".") + axes[c];
      if (field.components == 9) text += std::string(".") + tensor[c];
    }
  }
  text += "\n";
  for (std::size_t p = 0; p < frame.id.size(); ++p) {
    text += fmt::format("{},{},{}", frame.id[p], frame.material[p], frame.body[p]);
    for (std::size_t a = 0; a < 3; ++a) text += fmt::format(",{}", frame.position[3 * p + a]);
    for (const SnapshotField& field : frame.fields) {
      const auto count = static_cast<std::size_t>(field.components);
      for (std::size_t c = 0; c < count; ++c) {
        text += fmt::format(",{}", field.values[p * count + c]);
      }
    }
    text += "\n";
  }
  return text;
}

/// OUT.ext for one frame, OUT_000012.ext for several.
std::string file_name(const ConvertOptions& options, std::size_t frame, bool several) {
  if (!several) return options.output;
  const fs::path path(options.output);
  return (path.parent_path() /
          fmt::format("{}_{:06}{}", path.stem().string(), frame, path.extension().string()))
      .string();
}

/// Converts one frame; returns the status.
int convert(const ParticleSnapshot& frame, const std::string& output) {
  if (extension_of(output) == "csv") {
    replace_file(output, table_of(frame));
    return 0;
  }
  // meshio reads the frame from a file of the usual kind, whatever format the run has.
  const fs::path temporary = output + ".scree.vtu";
  write_particle_frame(temporary, frame, FramePrecision::double_);
  const int status = run_tool("convert", {temporary.string(), output});
  std::error_code ignored;
  fs::remove(temporary, ignored);
  return status;
}

int run_convert(const ConvertOptions& options) {
  const Run run(options.run);
  check_target(options.output, run);
  if (extension_of(options.output).empty()) {
    throw UserError("-o " + options.output +
                    ": the name's ending says the format, e.g. .csv, .vtk, "
                    ".xdmf, .msh, .inp, .ply");
  }
  std::vector<std::string> fields;
  for (const FieldInfo& field : run.fields()) fields.push_back(field.name);
  if (!options.fields.empty()) {
    fields = needed_fields(quantities(options.fields, run.fields(), run.dimension()));
  }
  const auto frames = chosen_frames(run.frames(), options.time);
  const bool several = options.time.all || options.time.times.size() > 1;
  FrameProgress progress("frame", frames.size(), options.quiet);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::string file = file_name(options, frames[i], several);
    const int status = convert(run.frames().read(frames[i], fields), file);
    if (status != 0) return status;
    if (!options.quiet) {
      fmt::print("{}, {}\n", file, time_text(run.frames().times()[frames[i]]));
    }
    progress.done(i + 1);
  }
  return 0;
}

std::function<int(const PostWords&)> declare(OptionSet& set) {
  const auto shared = std::make_shared<ConvertOptions>();
  ConvertOptions& options = *shared;
  set.positional("run", options.run, "RUN", "Run folder");
  set.text("-o,--output", options.output, "FILE",
           "The ending says the format: .csv, or one that meshio writes (.vtk .xdmf .msh .inp "
           ".ply ...)",
           true);
  set.texts("--fields,--field", options.fields, "F,F,...", "Default: all");
  add_time_options(set, options.time, true);
  set.flag("--quiet", options.quiet, "Print errors only");
  return [shared](const PostWords&) { return run_convert(*shared); };
}

}  // namespace

PostCommand post_convert() {
  return {"convert", "Frames in the formats of other programs", false, &declare};
}

}  // namespace scree
