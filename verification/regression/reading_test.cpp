// SPDX-License-Identifier: Apache-2.0
// Other programs read a run's files: meshio and the picture script. Skipped where they are missing.
#include <gtest/gtest.h>

#include "verification/support/process.hpp"
#include "verification/support/temporary_folder.hpp"

#ifdef SCREE_EXECUTABLE

namespace scree {
namespace {

namespace fs = std::filesystem;

constexpr const char* python = "/usr/bin/python3";

/// A block at rest in three dimensions; one frame at t = 0 and one at the end.
constexpr const char* deck_text = R"(title = "Block"
[domain]
dimension = 3
lower = [0.0, 0.0, 0.0]
upper = [0.4, 0.4, 0.4]
cell_size = 0.1
[time]
end = 0.002
[material.rubber]
model = "fixed_corotated"
density = 1000
youngs_modulus = "1 MPa"
poissons_ratio = 0.3
[body.block]
material = "rubber"
shape = { type = "box", lower = [0.1, 0.1, 0.1], upper = [0.3, 0.3, 0.3] }
particles_per_direction = 2
velocity = [1.0, 2.0, 3.0]
[output]
fields = ["velocity", "stress"]
)";

class Reading : public testing::Test {
 protected:
  void SetUp() override {
    write_text(folder_ / "block.toml", deck_text);
    const ProcessResult result =
        run_process({SCREE_EXECUTABLE, "run", (folder_ / "block.toml").string(), "-o",
                     run().string(), "--quiet"});
    ASSERT_EQ(result.status, 0) << result.err;
  }
  fs::path run() const { return folder_ / "run"; }

  TemporaryFolder folder_;
};

TEST_F(Reading, MeshioReadsTheParticles) {
  if (run_process({python, "-c", "import meshio"}).status != 0) GTEST_SKIP() << "no meshio";
  // 4 x 4 x 4 particles: 2 cells of 2 particles an axis
  const std::string script =
      "import meshio, sys\n"
      "mesh = meshio.read(sys.argv[1])\n"
      "assert mesh.points.shape == (64, 3), mesh.points.shape\n"
      "assert mesh.cells_dict['vertex'].shape == (64, 1)\n"
      "data = mesh.point_data\n"
      "assert len(set(data['id'])) == 64\n"
      "assert set(data['body']) == {0} and set(data['material']) == {0}\n"
      "assert data['stress'].shape == (64, 9)\n"
      "assert abs(data['velocity'].mean(axis=0) - [1, 2, 3]).max() < 1e-5\n"
      "assert abs(mesh.field_data['TimeValue'][0] - 0.002) < 1e-15\n";
  const ProcessResult result =
      run_process({python, "-c", script, (run() / "frames/particles_000001.vtu").string()});
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(Reading, MeshioReadsAProjection) {
  if (run_process({python, "-c", "import meshio, h5py"}).status != 0) GTEST_SKIP() << "no meshio";
  // The block has 2 x 2 x 2 cells; its nodes' volumes are all of its 0.2^3 m^3.
  const std::string script =
      "import meshio, sys\n"
      "mesh = meshio.read(sys.argv[1])\n"
      "cells = mesh.cells_dict['hexahedron']\n"
      "assert cells.shape[0] >= 8 and cells.max() + 1 == len(mesh.points)\n"
      "side = mesh.points[cells[:, 6]] - mesh.points[cells[:, 0]]\n"
      "assert abs(side - 0.1).max() < 1e-12, side\n"  // opposite corners, so the order is right
      "assert abs(mesh.point_data['volume'].sum() - 0.008) < 1e-12\n"
      "assert mesh.point_data['velocity'].shape == (len(mesh.points), 3)\n";
  const std::string file = (folder_ / "projection.xdmf").string();
  const ProcessResult post = run_process({SCREE_EXECUTABLE, "post", "project", run().string(), "-o",
                                          file, "--fields", "velocity", "--quiet"});
  ASSERT_EQ(post.status, 0) << post.err;
  const ProcessResult result = run_process({python, "-c", script, file});
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(Reading, ThePictureIsDrawn) {
  if (!fs::exists("/usr/bin/xvfb-run") || run_process({python, "-c", "import vtk"}).status != 0) {
    GTEST_SKIP() << "no xvfb or no VTK for Python";
  }
  const std::string render = std::string(SCREE_SOURCE_DIR) + "/postproc/render";
  const fs::path picture = folder_ / "picture.png";
  const ProcessResult result =
      run_process({python, render, run().string(), "-o", picture.string(), "--width", "800"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(read_text(picture).substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_GT(fs::file_size(picture), 10000u);  // a white page compresses to far less
  EXPECT_EQ(run_process({python, render, run().string(), "--field", "none"}).status, 2);
}

}  // namespace
}  // namespace scree

#endif
