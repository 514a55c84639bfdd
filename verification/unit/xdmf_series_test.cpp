// SPDX-License-Identifier: Apache-2.0
#include "solver/io/xdmf_series.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <map>
#include <optional>
#include <sstream>

#include "solver/base/error.hpp"
#include "solver/io/hdf5_handle.hpp"
#include "solver/io/memory_archive.hpp"
#include "verification/support/file_size_limit.hpp"
#include "verification/support/sample_snapshot.hpp"
#include "verification/support/temporary_folder.hpp"
#include "verification/unit/write_watch.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

/// A file of frames opened as any other program does it.
class Reader {
 public:
  explicit Reader(const fs::path& path)
      : file_((start_hdf5(), H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)), H5Fclose) {}

  bool valid() const { return file_.valid(); }

  std::vector<hsize_t> size(const std::string& name) const {
    const Hdf5Handle data(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    const Hdf5Handle space(H5Dget_space(data.get()), H5Sclose);
    std::vector<hsize_t> size(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space.get())));
    H5Sget_simple_extent_dims(space.get(), size.data(), nullptr);
    return size;
  }

  std::vector<double> values(const std::string& name) const {
    const Hdf5Handle data(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!data.valid()) return {};
    const Hdf5Handle space(H5Dget_space(data.get()), H5Sclose);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
    const herr_t read =
        H5Dread(data.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    return read < 0 ? std::vector<double>{} : values;
  }

  std::size_t stored_bytes(const std::string& name) const {
    const Hdf5Handle data(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    return static_cast<std::size_t>(H5Dget_storage_size(data.get()));
  }

  bool chunked(const std::string& name) const {
    const Hdf5Handle data(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    const Hdf5Handle creation(H5Dget_create_plist(data.get()), H5Pclose);
    return H5Pget_layout(creation.get()) == H5D_CHUNKED;
  }

 private:
  Hdf5Handle file_;
};

/// The arrays of the file that the index names: path in the file and number of values.
std::map<std::string, std::size_t> named_arrays(const std::string& index, const std::string& file) {
  std::map<std::string, std::size_t> arrays;
  std::size_t at = 0;
  while ((at = index.find("Dimensions=\"", at)) != std::string::npos) {
    at += std::string("Dimensions=\"").size();
    std::istringstream sizes(index.substr(at, index.find('"', at) - at));
    std::size_t count = 1;
    for (std::size_t n = 0; sizes >> n;) count *= n;
    const std::size_t text = index.find('>', at) + 1;
    const std::string item = index.substr(text, index.find('<', text) - text);
    if (item.starts_with(file + ":")) arrays[item.substr(file.size() + 1)] = count;
  }
  return arrays;
}

/// What is wrong with the frames that the index in this folder names; "" if all can be read and are
/// those of sample_particles.
std::string fault_of(const fs::path& folder, std::size_t frames) {
  const auto arrays = named_arrays(read_text(folder / "particles.xdmf"), "particles.h5");
  const Reader file(folder / "particles.h5");
  if (!file.valid()) return "the file cannot be opened";
  std::size_t found = 0;
  for (const auto& [name, count] : arrays) {
    const std::vector<double> values = file.values(name);
    if (values.size() != count) return name + " cannot be read";
    if (!name.ends_with("/pressure")) continue;
    ++found;
    for (std::size_t p = 0; p < count; ++p) {
      if (values[p] != sample_value(2, p, 0)) return name + " has other values";
    }
  }
  return found == frames ? "" : std::to_string(found) + " frames";
}

XdmfSeries double_series(const fs::path& folder, std::size_t expected) {
  return XdmfSeries(folder, "particles", FramePrecision::double_, false, expected);
}

TEST(XdmfSeries, FramesComeBackAsTheyWent) {
  const TemporaryFolder folder;
  XdmfSeries series(folder.path(), "particles", FramePrecision::single_, false, 2);
  EXPECT_EQ(series.last_file(), "");
  const ParticleSnapshot snapshot = sample_particles(7, 0.25);
  series.add(snapshot);
  series.add(sample_particles(5, 0.5));
  EXPECT_EQ(series.last_file(), "frame 1 in particles.h5");
  EXPECT_EQ(series.times(), (std::vector<double>{0.25, 0.5}));
  const Reader file(folder / "particles.h5");
  EXPECT_EQ(file.values("/frame_000000/position"), snapshot.position);  // never in single precision
  EXPECT_EQ(file.values("/frame_000000/connectivity"), (std::vector<double>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(file.size("/frame_000000/connectivity"), (std::vector<hsize_t>{7, 1}));
  EXPECT_EQ(file.size("/frame_000000/stress"), (std::vector<hsize_t>{7, 9}));
  EXPECT_EQ(file.size("/frame_000001/stress"), (std::vector<hsize_t>{5, 9}));
  EXPECT_EQ(file.values("/frame_000000/id").at(3), double(snapshot.id[3]));
  EXPECT_TRUE(file.chunked("/frame_000000/stress"));
  const std::vector<double> stress = file.values("/frame_000000/stress");
  for (std::size_t i = 0; i < stress.size(); ++i) {
    EXPECT_EQ(stress[i], double(float(snapshot.fields[1].values[i])));
  }
}

TEST(XdmfSeries, TheIndexNamesTimesAndEveryArray) {
  const TemporaryFolder folder;
  XdmfSeries series(folder.path(), "particles", FramePrecision::single_, false, 2);
  series.add(sample_particles(3, 0.0));
  series.add(sample_particles(2, 0.1));
  const std::string index = read_text(folder / "particles.xdmf");
  EXPECT_NE(index.find("<Time Value=\"0.1\"/>"), std::string::npos) << index;
  EXPECT_NE(index.find("Name=\"stress\" AttributeType=\"Tensor\" Center=\"Node\"><DataItem "
                       "Format=\"HDF\" NumberType=\"Float\" Precision=\"4\" Dimensions=\"2 9\">"
                       "particles.h5:/frame_000001/stress</DataItem>"),
            std::string::npos)
      << index;
  const auto arrays = named_arrays(index, "particles.h5");
  EXPECT_EQ(arrays.size(), 2 * 8u);  // connectivity, position, id, material, body and three fields
  EXPECT_EQ(arrays.at("/frame_000001/position"), 6u);
}

TEST(XdmfSeries, PackedArraysAreSmallerAndTheSame) {
  const TemporaryFolder folder;
  XdmfSeries series(folder.path(), "particles", FramePrecision::double_, true, 1);
  ParticleSnapshot snapshot = sample_particles(1000, 0);
  snapshot.fields[1].values.assign(9000, 1.0 / 3.0);
  series.add(snapshot);
  const Reader file(folder / "particles.h5");
  EXPECT_EQ(file.values("/frame_000000/stress"), snapshot.fields[1].values);
  EXPECT_LT(file.stored_bytes("/frame_000000/stress"), 9000u);  // of 72000
}

TEST(XdmfSeries, ManyChunksAndNoParticlesAtAll) {
  const TemporaryFolder folder;
  XdmfSeries series = double_series(folder.path(), 2);
  const ParticleSnapshot large = sample_particles(40000, 0.0);  // stress: 2.9 MB, three chunks
  series.add(large);
  series.add(sample_particles(0, 1.0));
  const Reader file(folder / "particles.h5");
  EXPECT_EQ(file.values("/frame_000000/stress"), large.fields[1].values);
  EXPECT_EQ(file.size("/frame_000001/stress"), (std::vector<hsize_t>{0, 9}));
}

TEST(XdmfSeries, MoreFramesThanExpected) {
  const TemporaryFolder folder;
  XdmfSeries series = double_series(folder.path(), 2);
  for (int i = 0; i < 9; ++i) series.add(sample_particles(3, 0.1 * i));
  EXPECT_EQ(fault_of(folder.path(), 9), "");
  const auto arrays = named_arrays(read_text(folder / "particles.xdmf"), "particles.h5");
  EXPECT_TRUE(arrays.contains("/frame_000001/id"));
  EXPECT_TRUE(arrays.contains("/more/frame_000003/id"));       // two more
  EXPECT_TRUE(arrays.contains("/more/more/frame_000007/id"));  // four more
}

TEST(XdmfSeries, LatticesArePartsOfAFrame) {
  const TemporaryFolder folder;
  XdmfSeries series(folder.path(), "grid", FramePrecision::double_, false, 1);
  const GridSnapshot minus = sample_grid(4, 3, 2, 0.5, "minus");
  series.add({minus, sample_grid(3, 2, 1, 0.5, "plus")});
  const Reader file(folder / "grid.h5");
  EXPECT_EQ(file.size("/frame_000000/minus/velocity"), (std::vector<hsize_t>{2, 3, 4, 3}));
  EXPECT_EQ(file.values("/frame_000000/minus/velocity"), minus.fields[1].values);
  const std::string index = read_text(folder / "grid.xdmf");
  EXPECT_NE(index.find("3DCoRectMesh\" Dimensions=\"2 3 4\""), std::string::npos) << index;
  series.add(std::vector<GridSnapshot>{});
  EXPECT_EQ(series.times().size(), 1u);
}

/// Frames of several sizes, more of them than were expected.
void add_frames(XdmfSeries& series, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) series.add(sample_particles(3 + i % 2, 0.1 * double(i)));
}

TEST(XdmfSeries, WhateverStopsTheProgramTheFramesCanBeRead) {
  /// The files as they are when the program ends at some moment.
  struct Moment {
    std::string index, frames;
    std::size_t complete;
  };
  const TemporaryFolder folder;
  std::vector<Moment> moments;
  std::size_t complete = 0;
  {
    std::optional<XdmfSeries> series(double_series(folder.path(), 3));
    const WriteWatch watch([&] {
      if (!fs::exists(folder / "particles.xdmf")) return;
      moments.push_back(
          {read_text(folder / "particles.xdmf"), read_text(folder / "particles.h5"), complete});
    });
    for (; complete < 5; ++complete) add_frames(*series, complete, complete + 1);
    series.reset();  // closes the file
  }
  EXPECT_GT(moments.size(), 50u);  // eight arrays in each of five frames
  EXPECT_EQ(fault_of(folder.path(), 5), "");
  for (std::size_t i = 0; i < moments.size(); ++i) {
    write_text(folder / "particles.xdmf", moments[i].index);
    write_text(folder / "particles.h5", moments[i].frames);
    // The frame under way may just have become complete.
    const std::string fault = fault_of(folder.path(), moments[i].complete);
    const std::string next = fault.empty() ? "" : fault_of(folder.path(), moments[i].complete + 1);
    EXPECT_TRUE(fault.empty() || next.empty())
        << "after " << i << " of " << moments.size() << " writes: " << fault << ", " << next;
  }
}

class XdmfResume : public testing::Test {
 protected:
  /// Writes `frames` frames, of which a checkpoint knows `saved`.
  void write(std::size_t saved, std::size_t frames, std::size_t expected) {
    XdmfSeries series = double_series(folder_.path(), expected);
    add_frames(series, 0, saved);
    series.save(archive_, "run/");
    index_ = read_text(folder_ / "particles.xdmf");
    length_ = fs::file_size(folder_ / "particles.h5");
    add_frames(series, saved, frames);
  }
  std::string index() const { return read_text(folder_ / "particles.xdmf"); }

  TemporaryFolder folder_;
  MemoryArchive archive_;
  std::string index_;
  std::uintmax_t length_ = 0;
};

TEST_F(XdmfResume, CutsBackAndGoesOn) {
  for (const std::size_t expected : {2u, 3u, 20u}) {
    archive_ = {};
    write(3, 7, expected);
    const std::string all = index();
    XdmfSeries series = double_series(folder_.path(), expected);
    series.resume(archive_, "run/");
    EXPECT_EQ(index(), index_);
    EXPECT_EQ(fs::file_size(folder_ / "particles.h5"), length_);
    EXPECT_EQ(fault_of(folder_.path(), 3), "");
    add_frames(series, 3, 7);
    EXPECT_EQ(index(), all);
    EXPECT_EQ(fault_of(folder_.path(), 7), "");
  }
}

TEST_F(XdmfResume, SurvivesHalfAFrameAndARaisedEnd) {
  write(2, 2, 2);
  write_text(folder_ / "particles.h5",
             read_text(folder_ / "particles.h5") + std::string(5000, 'x'));
  XdmfSeries series = double_series(folder_.path(), 6);
  series.resume(archive_, "run/");
  EXPECT_EQ(fs::file_size(folder_ / "particles.h5"), length_);
  add_frames(series, 2, 6);
  EXPECT_EQ(fault_of(folder_.path(), 6), "");
}

TEST_F(XdmfResume, NeedsTheEarlierFrames) {
  write(3, 3, 3);
  fs::resize_file(folder_ / "particles.h5", length_ - 1);
  XdmfSeries shorter = double_series(folder_.path(), 3);
  EXPECT_THROW(shorter.resume(archive_, "run/"), RunFault);
  fs::remove(folder_ / "particles.h5");
  XdmfSeries missing = double_series(folder_.path(), 3);
  EXPECT_THROW(missing.resume(archive_, "run/"), RunFault);
  fs::remove(folder_ / "particles.xdmf");
  XdmfSeries unlisted = double_series(folder_.path(), 3);
  EXPECT_THROW(unlisted.resume(archive_, "run/"), RunFault);
}

TEST(XdmfSeries, AFullDiskLeavesTheFormerFrames) {
  const TemporaryFolder folder;
  XdmfSeries series = double_series(folder.path(), 4);
  add_frames(series, 0, 2);
  const std::string before = read_text(folder / "particles.h5");
  std::string sentence;
  {
    const FileSizeLimit limit(before.size() + 300);
    try {
      series.add(sample_particles(1000, 0.3));
    } catch (const RunFault& fault) {
      sentence = fault.what();
    }
  }
  EXPECT_NE(sentence.find("cannot write"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("File too large"), std::string::npos) << sentence;
  EXPECT_EQ(read_text(folder / "particles.h5"), before);
  EXPECT_EQ(fault_of(folder.path(), 2), "");
  EXPECT_THROW(series.add(sample_particles(3, 0.3)), RunFault);  // a failed file stays as it is
}

}  // namespace
}  // namespace scree
