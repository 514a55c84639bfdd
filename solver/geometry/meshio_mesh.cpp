// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "solver/base/error.hpp"
#include "solver/geometry/mesh_file.hpp"

extern char** environ;

namespace scree {
namespace {

namespace fs = std::filesystem;

constexpr const char* python = "/usr/bin/python3";
constexpr int no_meshio = 3, no_such_region = 4;

/// Reads argv[1], writes the cells of region argv[3] (empty: all) to argv[2] as VTU. Regions are
/// Gmsh's physical groups by name or number, named sets of cells, and MED's families.
constexpr const char* script = R"py(
import sys
try:
    import meshio, numpy
except ImportError as fault:
    print(fault)
    sys.exit(3)
source, target, region = sys.argv[1:4]
try:
    mesh = meshio.read(source)
except BaseException as fault:
    print(getattr(fault, "message", "") or fault)
    sys.exit(1)
blocks = mesh.cells
keep = [numpy.full(len(block.data), not region) for block in blocks]
known = set()
def take(name, index, cells):
    known.add(str(name))
    if str(name) == region:
        keep[index][cells] = True
for name, sets in (mesh.cell_sets or {}).items():
    if name.startswith("gmsh:"):
        continue
    for index, cells in enumerate(sets):
        if cells is not None and len(cells):
            take(name, index, numpy.asarray(cells, dtype=int))
names = {}
for name, value in (mesh.field_data or {}).items():
    if len(numpy.atleast_1d(value)) == 2:
        names.setdefault(int(value[0]), []).append((name, int(value[1])))
dimension = {"triangle": 2, "quad": 2, "triangle6": 2, "quad8": 2, "quad9": 2, "line": 1, "line3": 1,
             "vertex": 0}
for key in ("gmsh:physical", "medit:ref", "cell_tags"):
    for index, tags in enumerate(mesh.cell_data.get(key, [])):
        tags = numpy.asarray(tags)
        for tag in numpy.unique(tags):
            take(int(tag), index, tags == tag)
            for name, size in names.get(int(tag), []):
                if size == dimension.get(blocks[index].type, 3):
                    take(name, index, tags == tag)
            for name in getattr(mesh, "cell_tags", {}).get(int(tag), []):
                take(name, index, tags == tag)
if region and not any(k.any() for k in keep):
    print("\n".join(sorted(known)))
    sys.exit(4)
cells = [(block.type, block.data[k]) for block, k in zip(blocks, keep) if k.any()]
points = mesh.points
if points.shape[1] == 2:
    points = numpy.column_stack([points, numpy.zeros(len(points))])
try:
    meshio.write(target, meshio.Mesh(points, cells), file_format="vtu")
except BaseException as fault:
    print(getattr(fault, "message", "") or fault)
    sys.exit(1)
)py";

/// A folder that goes with its content.
class ScratchFolder {
 public:
  ScratchFolder() {
    path_ = (fs::temp_directory_path() / "scree-mesh-XXXXXX").string();
    if (mkdtemp(path_.data()) == nullptr)
      throw UserError("cannot make a folder " + path_ + ": " + std::strerror(errno));
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string operator/(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// Runs the script with its output in a file; the exit status, or -1 if it was killed.
int run_script(std::vector<std::string> arguments, const std::string& output) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int fault = posix_spawn(&child, python, &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (fault != 0)
    throw GeometryFault("file", fmt::format("needs meshio to be read, and {} does not start: {}; "
                                            "install the packages python3 and python3-meshio",
                                            python, std::strerror(fault)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream stream(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

}  // namespace

TriangleMesh read_with_meshio(const std::string& path, const std::string& region) {
  const ScratchFolder folder;
  const std::string mesh = folder / "mesh.vtu", output = folder / "output";
  const int status = run_script({python, "-c", script, path, mesh, region}, output);
  std::vector<std::string> lines = lines_of(output);
  if (status == 0) return read_with_vtk(mesh, "");
  if (status == no_such_region) unknown_region(region, std::move(lines));
  const std::string said = lines.empty() ? "no reason is given" : lines.back();
  if (status == no_meshio)
    throw GeometryFault("file", fmt::format("needs meshio to be read, which {} does not find ({}); "
                                            "install the package python3-meshio, or save the "
                                            "surface as STL, OBJ, PLY, VTP or VTU",
                                            python, said));
  throw GeometryFault("file", "cannot be read by meshio: " + said);
}

}  // namespace scree
