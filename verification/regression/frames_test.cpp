// SPDX-License-Identifier: Apache-2.0
// The frames and tables of whole runs: both formats hold the same, and a killed run goes on.
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>

#include "verification/support/process.hpp"
#include "verification/support/temporary_folder.hpp"

#ifdef SCREE_EXECUTABLE

namespace scree {
namespace {

namespace fs = std::filesystem;

constexpr const char* deck_text = R"([domain]
dimension = 2
lower = [0.0, 0.0]
upper = [0.4, 0.4]
cell_size = "2 cm"
[time]
end = "0.1 s"
[method]
gravity = [0.0, -9.81]
[material.sand]
model = "drucker_prager"
density = 1600
youngs_modulus = "1 MPa"
poissons_ratio = 0.3
friction_angle = "31 deg"
[body.block]
material = "sand"
shape = { type = "box", lower = [0.0, 0.0], upper = [0.1, 0.2] }
[boundary]
x_min = "slip"
y_min = "sticky"
[output]
every = "10 ms"
fields = ["velocity", "stress", "p", "lode_angle", "yield_distance", "strain_rate"]
grid = true
[checkpoint]
every = "20 ms"
[frames.left]
every = "5 ms"
format = "xdmf"
compression = "deflate"
region = { type = "box", lower = [0.0, 0.0], upper = [0.05, 0.4] }
[probe.here]
at = [0.05, 0.05]
every = "1 ms"
[probe.grain]
type = "particle"
id = 7
[profile.up]
from = [0.05, 0.0]
to = [0.05, 0.2]
[section.all]
every = "50 ms"
)";

class Frames : public testing::Test {
 protected:
  Frames() { write_text(folder_ / "sand.toml", deck_text); }

  std::vector<std::string> command(const std::string& run, std::vector<std::string> more) const {
    std::vector<std::string> words = {SCREE_EXECUTABLE, "run", (folder_ / "sand.toml").string(),
                                      "-o", (folder_ / run).string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::string read(const std::string& run, const std::string& file) const {
    return read_text(folder_ / run / file);
  }

  TemporaryFolder folder_;
};

TEST_F(Frames, BothFormatsHoldTheSame) {
  const std::string python = "/usr/bin/python3";  // the distribution's own, to which meshio belongs
  if (run_process({python, "-c", "import meshio, h5py"}).status != 0) {
    GTEST_SKIP() << "meshio and h5py are not installed (./bootstrap --packages --developer)";
  }
  for (const char* precision : {"single", "double"}) {
    const std::string output = std::string("output.precision=\"") + precision + "\"";
    const std::string vtu = std::string("vtu_") + precision,
                      xdmf = std::string("xdmf_") + precision;
    ASSERT_EQ(run_process(command(vtu, {"--set", output})).status, 0);
    ASSERT_EQ(
        run_process(command(xdmf, {"--set", output, "--set", "output.format=\"xdmf\""})).status, 0);
    const ProcessResult read = run_process(
        {python, std::string(SCREE_SOURCE_DIR) + "/verification/regression/read_frames.py",
         (folder_ / vtu).string(), (folder_ / xdmf).string()});
    EXPECT_EQ(read.status, 0) << read.err;
    EXPECT_EQ(read.out, "11 frames, 9 arrays\n");  // id, material, body and the six fields
  }
}

TEST_F(Frames, AKilledRunGoesOnAsIfItHadNot) {
  const std::vector<std::string> xdmf{"--set", "output.format=\"xdmf\""};
  ASSERT_EQ(run_process(command("whole", xdmf)).status, 0);
  const ProcessResult killed = run_process(
      command("killed", xdmf), [] {},
      [&](pid_t child) {
        EXPECT_TRUE(wait_for([&] {
          return fs::exists(folder_ / "killed" / "checkpoint.h5") &&
                 read("killed", "particles.xdmf").find("frame_000003\"") != std::string::npos;
        }));
        kill(child, SIGKILL);
      });
  EXPECT_EQ(killed.status, 128 + SIGKILL);
  std::vector<std::string> resume = xdmf;
  resume.emplace_back("--resume");
  const ProcessResult resumed = run_process(command("killed", resume));
  ASSERT_EQ(resumed.status, 0) << resumed.err;
  for (const char* file :
       {"history.csv", "particles.xdmf", "grid.xdmf", "left.xdmf", "probes/here.csv",
        "probes/grain.csv", "profiles/up.csv", "sections/all.csv"}) {
    EXPECT_EQ(read("killed", file), read("whole", file)) << file;
  }
  EXPECT_NE(resumed.out.find("probes/grain.csv"), std::string::npos) << resumed.out;
}

TEST_F(Frames, AnOverwrittenRunKeepsOtherFiles) {
  ASSERT_EQ(run_process(command("run", {})).status, 0);
  write_text(folder_ / "run" / "probes" / "mine.csv", "not of the run");
  ASSERT_EQ(run_process(command("run", {"--overwrite", "--until", "0.01"})).status, 0);
  EXPECT_EQ(read("run", "probes/mine.csv"), "not of the run");
  EXPECT_EQ(read("run", "probes/here.csv").find("\n0,0,") != std::string::npos, true);
}

TEST_F(Frames, AProbeOfNoParticleIsTheUsersMistake) {
  const ProcessResult result = run_process(command("run", {"--set", "probe.grain.id=100000"}));
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(
      result.err.find("probe.grain.id = 100000: there is no such particle; allowed: 0 to 449"),
      std::string::npos)
      << result.err;
  EXPECT_FALSE(fs::exists(folder_ / "run"));
}

}  // namespace
}  // namespace scree

#endif
