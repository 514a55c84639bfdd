// SPDX-License-Identifier: Apache-2.0
#include "solver/io/checkpoint.hpp"

#include <hdf5.h>

#include <cstring>

#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"
#include "solver/io/hdf5_handle.hpp"

namespace scree {

namespace fs = std::filesystem;

namespace {

constexpr const char* format_name = "scree checkpoint";
constexpr std::int64_t format_version = 1;

/// A 64-bit checksum: a multiply and a rotation a word, so that any changed bit changes it.
std::uint64_t checksum(const void* values, std::size_t bytes) {
  const auto* next = static_cast<const unsigned char*>(values);
  std::uint64_t sum = 0x9e3779b97f4a7c15ULL ^ bytes;
  while (bytes > 0) {
    std::uint64_t word = 0;
    const std::size_t taken = bytes < sizeof word ? bytes : sizeof word;
    std::memcpy(&word, next, taken);
    sum = (sum ^ word) * 0xd6e8feb86659fd93ULL;
    sum = (sum << 29) | (sum >> 35);
    next += taken;
    bytes -= taken;
  }
  return sum;
}

Hdf5Handle file_access() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Written aside and renamed, the file needs no lock, and some network disks refuse them.
  H5Pset_file_locking(access.get(), false, true);
  return access;
}

bool write_scalar_attribute(hid_t object, const char* name, hid_t file_type, hid_t type,
                            const void* value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(
      H5Acreate2(object, name, file_type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.valid() && H5Awrite(attribute.get(), type, value) >= 0;
}

bool read_scalar_attribute(hid_t object, const char* name, hid_t type, void* value) {
  if (H5Aexists(object, name) <= 0) return false;
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  return attribute.valid() && H5Aread(attribute.get(), type, value) >= 0;
}

/// Same size and class (integer or floating); the byte order is the library's affair.
bool same_type(hid_t stored, hid_t wanted) {
  return H5Tget_class(stored) == H5Tget_class(wanted) && H5Tget_size(stored) == H5Tget_size(wanted);
}

}  // namespace

struct CheckpointWriter::File {
  fs::path path;
  Hdf5Handle file;
  bool committed = false;

  ~File() {
    if (committed) return;
    file.release();
    std::error_code ignored;  // a leftover aside harms nobody: the next checkpoint replaces it
    fs::remove(aside(path), ignored);
  }

  [[noreturn]] void fail() const {
    const std::string why = hdf5_system_message();
    throw RunFault(write_failure(path, 0) + why);
  }

  void put(const std::string& name, hid_t type, std::size_t element, bool is_text,
           const void* values, std::size_t count) {
    const hsize_t size = count;
    const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links.get(), 1);
    // No time stamps: the same state gives the same bytes.
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation.get(), false);
    const Hdf5Handle data(H5Dcreate2(file.get(), name.c_str(), type, space.get(), links.get(),
                                     creation.get(), H5P_DEFAULT),
                          H5Dclose);
    if (!data.valid()) fail();
    if (count > 0 && H5Dwrite(data.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail();
    const std::uint64_t sum = checksum(values, count * element);
    const std::uint8_t text = is_text ? 1 : 0;
    if (!write_scalar_attribute(data.get(), "checksum", H5T_STD_U64LE, H5T_NATIVE_UINT64, &sum) ||
        !write_scalar_attribute(data.get(), "text", H5T_STD_U8LE, H5T_NATIVE_UINT8, &text)) {
      fail();
    }
  }
};

CheckpointWriter::CheckpointWriter(const fs::path& path) : file_(std::make_unique<File>()) {
  start_hdf5();
  file_->path = path;
  const Hdf5Handle access = file_access();
  file_->file = Hdf5Handle(H5Fcreate(aside(path).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()),
                           H5Fclose);
  if (!file_->file.valid()) file_->fail();
  CheckpointWriter::put_text("format", format_name);
  CheckpointWriter::put_array("format_version", ElementType::int64, &format_version, 1);
}

CheckpointWriter::~CheckpointWriter() = default;

void CheckpointWriter::put_text(const std::string& name, const std::string& text) {
  file_->put(name, hdf5_type(ElementType::uint8), 1, true, text.data(), text.size());
}

void CheckpointWriter::put_array(const std::string& name, ElementType type, const void* values,
                                 std::size_t count) {
  file_->put(name, hdf5_type(type), element_size(type), false, values, count);
}

void CheckpointWriter::commit() {
  if (H5Fflush(file_->file.get(), H5F_SCOPE_GLOBAL) < 0) file_->fail();
  if (!file_->file.release()) file_->fail();
  take_name_durably(aside(file_->path), file_->path);
  file_->committed = true;
}

struct CheckpointReader::File {
  fs::path path;
  Hdf5Handle file;

  [[noreturn]] void fail(const std::string& what) const {
    throw RunFault("cannot read the checkpoint " + path.string() + ": " + what);
  }

  /// The dataset of this name, type and kind.
  Hdf5Handle open(const std::string& name, hid_t type, bool is_text) const {
    Hdf5Handle data(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!data.valid()) fail("'" + name + "' is missing");
    const Hdf5Handle stored(H5Dget_type(data.get()), H5Tclose);
    std::uint8_t text = 0;
    read_scalar_attribute(data.get(), "text", H5T_NATIVE_UINT8, &text);
    if (!same_type(stored.get(), type) || (text != 0) != is_text) {
      fail("'" + name + "' holds another type of value");
    }
    return data;
  }

  std::size_t size(const Hdf5Handle& data) const {
    const Hdf5Handle space(H5Dget_space(data.get()), H5Sclose);
    const hssize_t size = H5Sget_simple_extent_npoints(space.get());
    return size < 0 ? 0 : static_cast<std::size_t>(size);
  }

  void read(const Hdf5Handle& data, const std::string& name, hid_t type, void* values,
            std::size_t bytes) const {
    std::uint64_t stored = 0;
    if ((bytes > 0 && H5Dread(data.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) ||
        !read_scalar_attribute(data.get(), "checksum", H5T_NATIVE_UINT64, &stored) ||
        stored != checksum(values, bytes)) {
      fail("'" + name + "' is damaged");
    }
  }
};

CheckpointReader::CheckpointReader(const fs::path& path) : file_(std::make_unique<File>()) {
  start_hdf5();
  file_->path = path;
  std::error_code error;
  if (!fs::is_regular_file(path, error)) file_->fail("there is no such file");
  const Hdf5Handle access = file_access();
  file_->file = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose);
  if (!file_->file.valid()) {
    const std::string why = hdf5_system_message();
    file_->fail("it is truncated, damaged or not an HDF5 file" + why);
  }
  if (!CheckpointReader::has("format") || CheckpointReader::text("format") != format_name)
    file_->fail("it is not from scree");
  const auto version = get_value<std::int64_t>("format_version");
  if (version != format_version) {
    file_->fail("its format version is " + std::to_string(version) + ", this scree reads " +
                std::to_string(format_version));
  }
}

CheckpointReader::~CheckpointReader() = default;

bool CheckpointReader::has(const std::string& name) const {
  std::size_t slash = 0;
  while ((slash = name.find('/', slash + 1)) != std::string::npos) {
    if (H5Lexists(file_->file.get(), name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(file_->file.get(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string CheckpointReader::text(const std::string& name) const {
  const hid_t type = hdf5_type(ElementType::uint8);
  const Hdf5Handle data = file_->open(name, type, true);
  std::string text(file_->size(data), '\0');
  file_->read(data, name, type, text.data(), text.size());
  return text;
}

std::size_t CheckpointReader::array_size(const std::string& name, ElementType type) const {
  return file_->size(file_->open(name, hdf5_type(type), false));
}

void CheckpointReader::read_array(const std::string& name, ElementType type, void* values,
                                  std::size_t count) const {
  const hid_t memory = hdf5_type(type);
  const Hdf5Handle data = file_->open(name, memory, false);
  file_->read(data, name, memory, values, count * element_size(type));
}

}  // namespace scree
