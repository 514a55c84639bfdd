// SPDX-License-Identifier: Apache-2.0
#include "solver/io/vtk_series.hpp"

#include <gtest/gtest.h>

#include "solver/base/error.hpp"
#include "verification/support/sample_snapshot.hpp"
#include "verification/support/temporary_folder.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

std::string collection(const std::string& entries) {
  return "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
         "  <Collection>\n" +
         entries + "  </Collection>\n</VTKFile>\n";
}

std::string entry(const std::string& time, const std::string& file, const std::string& part = "0") {
  return "    <DataSet timestep=\"" + time + "\" part=\"" + part + "\" file=\"frames/" + file +
         "\"/>\n";
}

class VtkSeriesTest : public testing::Test {
 protected:
  VtkSeriesTest() { fs::create_directory(folder_ / "frames"); }
  std::string read(const std::string& file) const { return read_text(folder_ / file); }
  bool exists(const std::string& file) const { return fs::exists(folder_ / file); }

  TemporaryFolder folder_;
};

TEST_F(VtkSeriesTest, TheCollectionListsEveryFrameAtOnce) {
  VtkSeries series(folder_.path(), "particles", FramePrecision::single_);
  EXPECT_EQ(series.last_file(), "");
  series.add(sample_particles(2, 0.0));
  EXPECT_EQ(read("particles.pvd"), collection(entry("0", "particles_000000.vtu")));
  series.add(sample_particles(2, 0.1));
  EXPECT_EQ(read("particles.pvd"),
            collection(entry("0", "particles_000000.vtu") + entry("0.1", "particles_000001.vtu")));
  EXPECT_TRUE(exists("frames/particles_000001.vtu"));
  EXPECT_EQ(series.last_file(), "frames/particles_000001.vtu");
  EXPECT_FALSE(exists("particles.pvd.tmp"));
}

TEST_F(VtkSeriesTest, TwoLatticesAreTwoPartsOfOneTime) {
  VtkSeries series(folder_.path(), "grid", FramePrecision::single_);
  series.add({sample_grid(2, 2, 1, 0.5, "minus"), sample_grid(3, 3, 1, 0.5, "plus")});
  EXPECT_EQ(read("grid.pvd"), collection(entry("0.5", "grid_minus_000000.vti", "0") +
                                         entry("0.5", "grid_plus_000000.vti", "1")));
}

TEST_F(VtkSeriesTest, OneLatticeNeedsNoName) {
  VtkSeries series(folder_.path(), "grid", FramePrecision::single_);
  series.add({sample_grid(2, 2, 1, 0.5, "nodes")});
  EXPECT_EQ(read("grid.pvd"), collection(entry("0.5", "grid_000000.vti")));
}

TEST_F(VtkSeriesTest, ResumeCutsBackAndGoesOn) {
  std::string after_two;
  {
    VtkSeries series(folder_.path(), "particles", FramePrecision::single_);
    series.add(sample_particles(2, 0.0));
    series.add(sample_particles(2, 0.1));
    after_two = read("particles.pvd");
    series.add(sample_particles(2, 0.2));
  }
  write_text(folder_ / "frames/particles_000003.vtu.tmp", "half a frame, left by a kill");
  write_text(folder_ / "frames/particles_of_mine.vtu", "not ours");
  write_text(folder_ / "frames/particles_grid_minus_000005.vti", "of another series");
  VtkSeries series(folder_.path(), "particles", FramePrecision::single_);
  series.resume({0.0, 0.1});
  EXPECT_EQ(read("particles.pvd"), after_two);
  EXPECT_TRUE(exists("frames/particles_000001.vtu"));
  EXPECT_FALSE(exists("frames/particles_000002.vtu"));
  EXPECT_FALSE(exists("frames/particles_000003.vtu.tmp"));
  EXPECT_TRUE(exists("frames/particles_of_mine.vtu"));
  EXPECT_TRUE(exists("frames/particles_grid_minus_000005.vti"));
  series.add(sample_particles(2, 0.2));
  EXPECT_EQ(read("particles.pvd"),
            collection(entry("0", "particles_000000.vtu") + entry("0.1", "particles_000001.vtu") +
                       entry("0.2", "particles_000002.vtu")));
}

TEST_F(VtkSeriesTest, ResumeNeedsTheEarlierFrames) {
  VtkSeries series(folder_.path(), "particles", FramePrecision::single_);
  EXPECT_THROW(series.resume({0.0}), RunFault);
}

}  // namespace
}  // namespace scree
