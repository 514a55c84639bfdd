// SPDX-License-Identifier: Apache-2.0
// scree post render: pictures and films, drawn by the script postproc/render.
#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "postproc/colliders/collider_files.hpp"
#include "postproc/commands/command.hpp"
#include "postproc/commands/options.hpp"
#include "postproc/commands/tool.hpp"
#include "postproc/run/quantity.hpp"
#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"
#include "solver/io/vtk_frame.hpp"

namespace scree {
namespace {

struct RenderOptions {
  std::string run, output, time, field = "velocity", title, view = "iso";
  std::vector<std::string> range;
  double exaggeration = 1, rate = 25, opacity = 0;
  int width = 1600;
  bool all = false, crop = false, no_colliders = false, no_faces = false, quiet = false;
};

namespace fs = std::filesystem;

/// A folder that lasts as long as this object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "scree_render_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw RunFault(write_failure(name, errno));
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// What the script reads: the run itself where its frames are VTU, else a copy of frames.
class FramesForScript {
 public:
  FramesForScript(const Run& run, const std::vector<std::size_t>& frames,
                  const std::vector<std::string>& fields) {
    std::error_code ignored;
    path_ = run.folder();
    if (fs::exists(run.folder() / "particles.pvd", ignored)) return;
    path_ = copies_.emplace().path();
    fs::copy_file(run.folder() / "resolved.toml", path_ / "resolved.toml");
    std::string list;
    for (const std::size_t frame : frames) {
      const std::string file = fmt::format("{:06}.vtu", frame);
      write_particle_frame(path_ / file, run.frames().read(frame, fields), FramePrecision::single_);
      list += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", run.frames().times()[frame],
                          file);
    }
    replace_file(path_ / "particles.pvd",
                 "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>\n" + list +
                     "</Collection></VTKFile>\n");
  }
  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
  std::optional<TemporaryFolder> copies_;
};

/// Writes the colliders at the times of these frames; returns the words that name them.
std::vector<std::string> collider_words(const Run& run, const std::vector<std::size_t>& frames,
                                        const RenderOptions& options, const fs::path& folder) {
  const Value* colliders = run.deck().find("collider");
  if (options.no_colliders || colliders == nullptr || colliders->items.empty()) return {};
  std::vector<double> times;
  for (const std::size_t frame : frames) times.push_back(run.frames().times()[frame]);
  const fs::path index = folder / "colliders.pvd";
  try {
    write_colliders(run, times, index);
  } catch (const UserError& error) {
    throw UserError(std::string(error.what()) + "\n--no-colliders draws the particles alone");
  }
  std::vector<std::string> words{"--colliders", index.string()};
  if (options.opacity > 0) {
    words.insert(words.end(), {"--collider-opacity", fmt::format("{}", options.opacity)});
  }
  return words;
}

/// The words for the script but for the folder that it reads. A field.component is what the other
/// commands take.
std::vector<std::string> script_words(const RenderOptions& options, const Run& run) {
  std::vector<std::string> words{"-o", options.output};
  const std::size_t dot = options.field.find('.');
  const auto found = quantities(options.field, run.fields(), run.dimension());
  words.insert(words.end(), {"--field", options.field.substr(0, dot)});
  if (dot == std::string::npos && found.size() > 1 &&
      found.back().kind != ParticleQuantity::Kind::magnitude) {
    throw UserError("--field " + options.field + " has several components; name one, e.g. " +
                    found.front().name);
  }
  if (dot != std::string::npos) {
    if (found.front().kind == ParticleQuantity::Kind::component) {
      words.insert(words.end(), {"--component", options.field.substr(dot + 1)});
    } else if (found.front().kind != ParticleQuantity::Kind::magnitude) {
      words.insert(words.end(), {"--invariant", options.field.substr(dot + 1)});
    }
  }
  if (!options.time.empty()) {
    TimeOptions time;
    time.time = options.time;
    const std::size_t frame = chosen_frames(run.frames(), time).front();
    words.insert(words.end(), {"--time", fmt::format("{}", run.frames().times()[frame])});
  }
  if (!options.range.empty()) {
    words.push_back("--range");
    for (const std::string& word : options.range) {
      words.push_back(fmt::format("{}", parse_value("--range", word, Unit::none)));
    }
  }
  words.insert(words.end(), {"--title", options.title.empty() ? run.title() : options.title});
  words.insert(words.end(), {"--view", options.view, "--width", std::to_string(options.width),
                             "--rate", fmt::format("{}", options.rate), "--exaggeration",
                             fmt::format("{}", options.exaggeration)});
  for (const auto& [set, word] : {std::pair{options.all, "--all"},
                                  {options.crop, "--crop"},
                                  {options.no_faces, "--no-faces"},
                                  {options.quiet, "--quiet"}}) {
    if (set) words.emplace_back(word);
  }
  return words;
}

int run_render(RenderOptions options) {
  const Run run(options.run);
  if (options.output.empty()) options.output = (run.folder() / "picture.png").string();
  const std::string kind = extension_of(options.output);
  if (kind != "png" && kind != "mp4") {
    throw UserError("-o " + options.output + ": the name must end in .png or .mp4");
  }
  check_target(options.output, run);
  if (!options.time.empty() && (options.all || kind == "mp4")) {
    throw UserError("--time names one frame; --all and films show all of them");
  }
  std::vector<std::string> words = script_words(options, run);
  TimeOptions time;
  time.time = options.time;
  time.all = options.all || kind == "mp4";
  const auto wanted = quantities(options.field, run.fields(), run.dimension());
  const std::vector<std::size_t> chosen = chosen_frames(run.frames(), time);
  const TemporaryFolder folder;
  const std::vector<std::string> more = collider_words(run, chosen, options, folder.path());
  const FramesForScript frames(run, chosen, needed_fields(wanted));
  words.insert(words.begin(), frames.path());
  words.insert(words.end(), more.begin(), more.end());
  const int status = run_tool("render", words);
  if (status == 0 && !options.quiet) fmt::print("{}\n", options.output);
  return status;
}

std::function<int(const PostWords&)> declare(OptionSet& set) {
  const auto shared = std::make_shared<RenderOptions>();
  RenderOptions& options = *shared;
  set.positional("run", options.run, "RUN", "Run folder");
  set.text("-o,--output", options.output, "FILE.png|FILE.mp4",
           "Picture, or film of all frames (default: picture.png in the run folder)");
  set.text("--field", options.field, "F",
           "That gives the colour: pressure, velocity.x, stress.q, ... (default: velocity, its "
           "magnitude)");
  set.text("--time", options.time, "T", "Nearest frame (default: the last)");
  set.flag("--all", options.all, "A picture of every frame: NAME_000000.png, ...");
  set.texts("--range", options.range, "LOW HIGH", "Of the colours (default: of the frames)", 2, 2);
  set.choice("--view", options.view, {"iso", "front", "side", "top"},
             "Where from, in three dimensions (default: iso, from the right and above)");
  set.number("--exaggeration", options.exaggeration, 1e-3, 1e3, "E", "Of heights (default: 1)");
  set.text("--title", options.title, "TEXT", "Default: the deck's title");
  set.flag("--crop", options.crop, "Show the particles instead of the whole domain");
  set.flag("--no-colliders", options.no_colliders, "Leave out colliders and terrain");
  set.number("--collider-opacity", options.opacity, 0.01, 1, "A",
             "Of colliders (default: 0.35; 1 for a terrain in space)");
  set.flag("--no-faces", options.no_faces, "Leave out the faces of the domain that hold particles");
  set.whole_number("--width", options.width, 200, 16000, "N", "In pixels (default: 1600)");
  set.number("--rate", options.rate, 0.1, 240, "R", "Frames a second of a film (default: 25)");
  set.flag("--quiet", options.quiet, "Print errors only");
  return [shared](const PostWords&) { return run_render(*shared); };
}

}  // namespace

PostCommand post_render() { return {"render", "Pictures (PNG) and films (MP4)", false, &declare}; }

}  // namespace scree
