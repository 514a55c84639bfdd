// SPDX-License-Identifier: Apache-2.0
#include "solver/io/frame_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"
#include "solver/io/file_descriptor.hpp"
#include "solver/io/hdf5_handle.hpp"
#include "solver/io/to_float.hpp"

namespace scree {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t chunk_bytes = 1 << 20;
constexpr std::int64_t most_slots = 10000;    ///< made at a time
constexpr std::int64_t head_bytes = 48;       ///< of a superblock of version 2
constexpr std::size_t array_overhead = 4096;  ///< more than an array's description takes

Hdf5Handle file_access() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // The format of 1.8: a file left open by a killed program needs no repair before it is read, and
  // its head is one short record.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  // Readers may look while the run goes on, and some network disks refuse locks.
  H5Pset_file_locking(access.get(), false, true);
  // No space in advance, so that the file never counts bytes that were not written.
  H5Pset_meta_block_size(access.get(), 0);
  H5Pset_small_data_block_size(access.get(), 0);
  return access;
}

Hdf5Handle file_creation() {
  Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_istore_k(creation.get(), 8);  // small lists of chunks: most arrays have one chunk
  H5Pset_obj_track_times(creation.get(), false);
  return creation;
}

Hdf5Handle group_creation() {
  Hdf5Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);  // the same frames give the same bytes
  H5Pset_link_phase_change(creation.get(), 64, 32);
  H5Pset_est_link_info(creation.get(), 8, 12);
  return creation;
}

std::string slot_name(std::int64_t frame) { return fmt::format("frame_{:06}", frame); }

bool read_part(int file, std::int64_t first, std::uint8_t* bytes, std::int64_t length) {
  while (length > 0) {
    const ssize_t n = ::pread(file, bytes, static_cast<std::size_t>(length), first);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes += n;
    first += n;
    length -= n;
  }
  return true;
}

bool write_part(int file, std::int64_t first, const std::uint8_t* bytes, std::int64_t length) {
  while (length > 0) {
    const ssize_t n = ::pwrite(file, bytes, static_cast<std::size_t>(length), first);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes += n;
    first += n;
    length -= n;
  }
  return true;
}

/// Writes the remembered parts back, the head first, and cuts off what came after. Frames that the
/// head knows are not touched.
bool restore(int file, const FrameFileState& state) {
  const std::uint8_t* bytes = state.bytes.data();
  if (!write_part(file, 0, bytes, head_bytes)) return false;
  for (std::size_t r = 0; r + 1 < state.regions.size(); r += 2) {
    if (!write_part(file, state.regions[r], bytes, state.regions[r + 1])) return false;
    bytes += state.regions[r + 1];
  }
  return ::ftruncate(file, state.length) == 0;
}

std::int64_t length_of(int file) {
  struct stat status {};
  return ::fstat(file, &status) == 0 ? status.st_size : -1;
}

std::size_t stored_size(const FrameArray& array) {
  return array.as_single ? sizeof(float) : element_size(array.type);
}

bool put_attribute(hid_t object, const char* name, hid_t type, const void* value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(object, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  return attribute.valid() && H5Awrite(attribute.get(), type, value) >= 0;
}

bool put_text_attribute(hid_t object, const char* name, const std::string& text) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), text.size() + 1);
  return put_attribute(object, name, type.get(), text.c_str());
}

Hdf5Handle array_creation(const FrameArray& array, bool deflate) {
  Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  if (array.count() == 0) return creation;  // nothing to cut into chunks
  H5Pset_fill_time(creation.get(), H5D_FILL_TIME_NEVER);
  std::vector<hsize_t> chunk(array.size.begin(), array.size.end());
  const std::size_t row = array.count() / array.size[0] * stored_size(array);
  chunk[0] = std::min<hsize_t>(chunk[0], std::max<hsize_t>(1, chunk_bytes / row));
  H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
  if (deflate) {
    H5Pset_shuffle(creation.get());  // equal bytes of the numbers side by side pack better
    H5Pset_deflate(creation.get(), 1);
  }
  return creation;
}

}  // namespace

std::size_t FrameArray::count() const {
  std::size_t product = 1;
  for (const std::size_t n : size) product *= n;
  return product;
}

struct FrameFile::File {
  fs::path path;
  FileDescriptor bytes;  ///< the same file without HDF5
  Hdf5Handle file;
  bool deflate = false;
  std::vector<float> single;  ///< for conversions
  FrameFileState state;       ///< after the last frame that is complete

  [[noreturn]] void fail(int error = 0) const {
    throw RunFault(write_failure(path, error) + (error != 0 ? "" : hdf5_system_message()));
  }

  void open() {
    bytes = FileDescriptor(::open(path.c_str(), O_RDWR | O_CLOEXEC));
    if (!bytes.is_open()) fail(errno);
    file = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDWR, file_access().get()), H5Fclose);
    if (!file.valid()) fail();
  }

  /// The path of the group that holds the slots of a batch, "/" at the end.
  static std::string batch_path(std::size_t batch) {
    std::string path = "/";
    for (std::size_t i = 0; i < batch; ++i) path += "more/";
    return path;
  }

  std::string frame_path(std::int64_t frame) const {
    const auto next = std::upper_bound(state.batches.begin(), state.batches.end(), frame);
    return batch_path(static_cast<std::size_t>(next - state.batches.begin()) - 1) +
           slot_name(frame);
  }

  void make_group(const std::string& name) const {
    const Hdf5Handle group(
        H5Gcreate2(file.get(), name.c_str(), H5P_DEFAULT, group_creation().get(), H5P_DEFAULT),
        H5Gclose);
    if (!group.valid()) fail();
  }

  /// Makes a batch of empty groups for frames, and the group for the next batch.
  void make_slots(std::int64_t count) {
    const std::string parent = batch_path(state.batches.size());
    const std::int64_t before = state.length;
    for (std::int64_t i = 0; i < count; ++i) make_group(parent + slot_name(state.slots + i));
    make_group(parent + "more");
    flush();
    state.batches.push_back(state.slots);
    state.slots += count;
    state.regions.push_back(before);
    state.regions.push_back(state.length - before);
    remember();
  }

  /// Makes all that was added part of the file. Its length is right before the head says so.
  void flush() {
    hsize_t length = 0;
    if (H5Fget_filesize(file.get(), &length) < 0) fail();
    reserve(static_cast<std::int64_t>(length));
    if (::fdatasync(bytes.get()) != 0) fail(errno);
    if (H5Fflush(file.get(), H5F_SCOPE_GLOBAL) < 0) fail();
    if (H5Fget_filesize(file.get(), &length) < 0) fail();
    if (::ftruncate(bytes.get(), static_cast<off_t>(length)) != 0) fail(errno);
    if (::fdatasync(bytes.get()) != 0) fail(errno);
    state.length = static_cast<std::int64_t>(length);
  }

  /// Room on the disk up to this length.
  void reserve(std::int64_t length) const {
    if (length <= state.length) return;
    const int error = ::posix_fallocate(bytes.get(), state.length, length - state.length);
    // File systems that cannot reserve have to be tried.
    if (error != 0 && error != EOPNOTSUPP && error != EINVAL) fail(error);
  }

  void remember() {
    std::size_t total = 0;
    for (std::size_t r = 1; r < state.regions.size(); r += 2) {
      total += static_cast<std::size_t>(state.regions[r]);
    }
    state.bytes.resize(total);
    std::uint8_t* next = state.bytes.data();
    for (std::size_t r = 0; r < state.regions.size(); r += 2) {
      if (!read_part(bytes.get(), state.regions[r], next, state.regions[r + 1])) fail(errno);
      next += state.regions[r + 1];
    }
  }

  /// After a failure: the file as it was before, closed.
  void roll_back() {
    file.release();
    restore(bytes.get(), state);
  }

  const void* stored_values(const FrameArray& array) {
    if (!array.as_single) return array.values;
    single.resize(array.count());
    const double* first = static_cast<const double*>(array.values);
    std::transform(first, first + array.count(), single.begin(), to_float);
    return single.data();
  }

  void put(hid_t group, const FrameArray& array) {
    const std::vector<hsize_t> size(array.size.begin(), array.size.end());
    const hid_t type = hdf5_type(array.as_single ? ElementType::float32 : array.type);
    const Hdf5Handle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
                           H5Sclose);
    const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links.get(), 1);
    Hdf5Handle data(H5Dcreate2(group, array.name.c_str(), type, space.get(), links.get(),
                               array_creation(array, deflate).get(), H5P_DEFAULT),
                    H5Dclose);
    if (!data.valid()) fail();
    if (array.count() > 0 &&
        H5Dwrite(data.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, stored_values(array)) < 0) {
      fail();
    }
    if (!array.unit.empty() && !put_text_attribute(data.get(), "unit", array.unit)) fail();
    if (!data.release()) fail();  // writes the chunks
  }

  void put_all(const std::string& name, double time, std::int64_t step,
               const std::vector<FrameArray>& arrays) {
    std::size_t room = 0;
    for (const FrameArray& a : arrays) room += array_overhead + a.count() * stored_size(a);
    reserve(state.length + static_cast<std::int64_t>(room));
    const Hdf5Handle group(H5Gopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Gclose);
    if (!group.valid() || !put_attribute(group.get(), "time", H5T_NATIVE_DOUBLE, &time) ||
        !put_attribute(group.get(), "step", H5T_NATIVE_INT64, &step)) {
      fail();
    }
    for (const FrameArray& array : arrays) put(group.get(), array);
    flush();
    ++state.frames;
    remember();
  }
};

void FrameFileState::save(StateWriter& writer, const std::string& prefix) const {
  writer.put(prefix + "sizes", std::vector<std::int64_t>{length, frames, slots});
  writer.put(prefix + "batches", batches);
  writer.put(prefix + "regions", regions);
  writer.put(prefix + "bytes", bytes);
}

void FrameFileState::load(const StateReader& reader, const std::string& prefix) {
  const auto sizes = reader.get<std::int64_t>(prefix + "sizes");
  length = sizes.at(0);
  frames = sizes.at(1);
  slots = sizes.at(2);
  batches = reader.get<std::int64_t>(prefix + "batches");
  regions = reader.get<std::int64_t>(prefix + "regions");
  bytes = reader.get<std::uint8_t>(prefix + "bytes");
}

FrameFile::FrameFile(std::unique_ptr<File> file) : file_(std::move(file)) {}
FrameFile::FrameFile(FrameFile&&) noexcept = default;
FrameFile& FrameFile::operator=(FrameFile&&) noexcept = default;
FrameFile::~FrameFile() = default;

FrameFile FrameFile::create(const fs::path& path, std::size_t expected, bool deflate) {
  start_hdf5();
  auto file = std::make_unique<File>();
  file->deflate = deflate;
  file->path = aside(path);
  {
    const Hdf5Handle made(
        H5Fcreate(file->path.c_str(), H5F_ACC_TRUNC, file_creation().get(), file_access().get()),
        H5Fclose);
    if (!made.valid()) file->fail();
  }
  file->open();
  file->make_slots(std::clamp<std::int64_t>(static_cast<std::int64_t>(expected), 1, most_slots));
  take_name_durably(file->path, path);
  file->path = path;
  return FrameFile(std::move(file));
}

FrameFile FrameFile::resume(const fs::path& path, const FrameFileState& state, bool deflate) {
  start_hdf5();
  auto file = std::make_unique<File>();
  file->deflate = deflate;
  file->path = path;
  file->state = state;
  const FileDescriptor bytes(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  if (!bytes.is_open() || length_of(bytes.get()) < state.length) {
    throw RunFault(
        fmt::format("cannot continue: {} {} the {} frames before the checkpoint", path.string(),
                    bytes.is_open() ? "has lost some of" : "is missing: it held", state.frames));
  }
  if (!restore(bytes.get(), state)) file->fail(errno);
  file->open();
  return FrameFile(std::move(file));
}

std::string FrameFile::add(double time, std::int64_t step, const std::vector<FrameArray>& arrays) {
  File& file = *file_;
  if (!file.file.valid()) throw RunFault(write_failure(file.path, 0));  // after a failure
  try {
    if (file.state.frames == file.state.slots) {
      file.make_slots(std::min<std::int64_t>(file.state.slots, most_slots));
    }
    std::string name = file.frame_path(file.state.frames);
    file.put_all(name, time, step, arrays);
    return name;
  } catch (...) {
    file.roll_back();
    throw;
  }
}

const FrameFileState& FrameFile::state() const { return file_->state; }

}  // namespace scree
