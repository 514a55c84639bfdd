// SPDX-License-Identifier: Apache-2.0
#include "solver/io/xdmf_series.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"

namespace scree {

namespace fs = std::filesystem;

namespace {

constexpr const char* index_head =
    "<?xml version=\"1.0\"?>\n"
    "<Xdmf Version=\"3.0\">\n"
    "  <Domain>\n"
    "    <Grid Name=\"frames\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
constexpr const char* index_tail = "    </Grid>\n  </Domain>\n</Xdmf>\n";
// The first and the last line of a frame's entry; no other line of the index is like them.
constexpr const char* entry_begin = "      <Grid Name=\"frame";
constexpr const char* entry_end = "      </Grid>\n";

std::string size_text(const std::vector<std::size_t>& size) {
  return fmt::format("{}", fmt::join(size, " "));
}

/// <DataItem> that names an array of a frame's group `path` in the file.
std::string data_item(const FrameArray& array, const std::string& file, const std::string& path) {
  const bool floating = array.type == ElementType::float64;
  const std::size_t bytes = array.as_single ? sizeof(float) : element_size(array.type);
  return fmt::format(
      "<DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"{}\" Dimensions=\"{}\">{}:{}/{}"
      "</DataItem>",
      floating ? "Float" : "Int", bytes, size_text(array.size), file, path, array.name);
}

const char* attribute_type(std::size_t components) {
  return components == 1   ? "Scalar"
         : components == 3 ? "Vector"
         : components == 9 ? "Tensor"
                           : "Matrix";
}

/// <Attribute>, a field at the points; `points` is how many axes of its size count points.
std::string attribute(const FrameArray& array, std::size_t points, const std::string& file,
                      const std::string& path) {
  std::size_t components = 1;
  for (std::size_t i = points; i < array.size.size(); ++i) components *= array.size[i];
  const std::string name = array.name.substr(array.name.rfind('/') + 1);
  return fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n",
                     name, attribute_type(components), data_item(array, file, path));
}

template <class T>
FrameArray integers(const char* name, const std::vector<T>& values, std::size_t points) {
  if (values.size() != points) {
    throw std::logic_error(std::string(name) + " does not fit the number of points");
  }
  return {name, "", {points}, element_type<T>(), values.data()};
}

std::string read_all(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The entries of the frames in an index.
std::vector<std::string> split_index(const std::string& text) {
  std::vector<std::string> entries;
  std::size_t begin = 0;
  while ((begin = text.find(entry_begin, begin)) != std::string::npos) {
    const std::size_t end = text.find(std::string("\n") + entry_end, begin);
    if (end == std::string::npos) break;
    const std::size_t next = end + 1 + std::string(entry_end).size();
    entries.push_back(text.substr(begin, next - begin));
    begin = next;
  }
  return entries;
}

}  // namespace

XdmfSeries::XdmfSeries(fs::path run_folder, std::string name, FramePrecision precision,
                       bool deflate, std::size_t expected)
    : folder_(std::move(run_folder)),
      name_(std::move(name)),
      precision_(precision),
      deflate_(deflate),
      expected_(expected) {}

FrameFile& XdmfSeries::file() {
  if (!file_) file_ = FrameFile::create(folder_ / (name_ + ".h5"), expected_, deflate_);
  return *file_;
}

std::vector<FrameArray> XdmfSeries::field_arrays(const std::vector<SnapshotField>& fields,
                                                 const std::vector<std::size_t>& points,
                                                 const std::string& group) const {
  std::vector<FrameArray> arrays;
  for (const SnapshotField& field : fields) {
    FrameArray array{group + field.name, field.unit, points, ElementType::float64,
                     field.values.data()};
    if (field.components > 1) array.size.push_back(static_cast<std::size_t>(field.components));
    array.as_single = precision_ == FramePrecision::single_;
    if (array.count() != field.values.size()) {
      throw std::logic_error("field " + field.name + " does not fit the number of points");
    }
    arrays.push_back(std::move(array));
  }
  return arrays;
}

void XdmfSeries::add(const ParticleSnapshot& snapshot) {
  const std::size_t count = snapshot.id.size();
  if (snapshot.position.size() != 3 * count) {
    throw std::logic_error("positions do not fit the number of particles");
  }
  // ParaView shows nothing, or stops, where the numbers of the points of the cells are not given.
  std::vector<std::int64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  std::vector<FrameArray> arrays{
      {"connectivity", "", {count, 1}, ElementType::int64, numbers.data()},
      // In single precision coordinates of a map, 4e6 m, would be rounded to half a metre.
      {"position", "m", {count, 3}, ElementType::float64, snapshot.position.data()},
      integers("id", snapshot.id, count),
      integers("material", snapshot.material, count),
      integers("body", snapshot.body, count)};
  for (FrameArray& field : field_arrays(snapshot.fields, {count}, "")) {
    arrays.push_back(std::move(field));
  }
  const std::string path = file().add(snapshot.time, snapshot.step, arrays);
  const std::string h5 = name_ + ".h5";
  std::string entry = fmt::format(
      "{}_{:06}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n"
      "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" "
      "NodesPerElement=\"1\">{}</Topology>\n"
      "        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
      entry_begin, times_.size(), snapshot.time, count, data_item(arrays[0], h5, path),
      data_item(arrays[1], h5, path));
  for (std::size_t i = 1; i < arrays.size(); ++i) {
    entry += "        " + attribute(arrays[i], 1, h5, path);
  }
  add_entry(snapshot.time, entry + entry_end);
}

void XdmfSeries::add(const std::vector<GridSnapshot>& lattices) {
  if (lattices.empty()) return;
  const GridSnapshot& first = lattices.front();
  std::vector<FrameArray> arrays;
  std::vector<std::size_t> begin;  // a lattice: its first array
  for (const GridSnapshot& lattice : lattices) {
    begin.push_back(arrays.size());
    const std::vector<std::size_t> nodes{static_cast<std::size_t>(lattice.nodes[2]),
                                         static_cast<std::size_t>(lattice.nodes[1]),
                                         static_cast<std::size_t>(lattice.nodes[0])};
    for (FrameArray& field : field_arrays(lattice.fields, nodes, lattice.lattice + "/")) {
      arrays.push_back(std::move(field));
    }
  }
  begin.push_back(arrays.size());
  const std::string path = file().add(first.time, first.step, arrays);
  std::string entry = fmt::format(
      "{}_{:06}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
      "        <Time Value=\"{}\"/>\n",
      entry_begin, times_.size(), first.time);
  for (std::size_t l = 0; l < lattices.size(); ++l) {
    const GridSnapshot& lattice = lattices[l];
    // XDMF counts axes from z to x, those of origin and spacing too.
    entry += fmt::format(
        "        <Grid Name=\"{}\" GridType=\"Uniform\">\n"
        "          <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"{} {} {}\"/>\n"
        "          <Geometry GeometryType=\"ORIGIN_DXDYDZ\">"
        "<DataItem Format=\"XML\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"3\">{} {} {}"
        "</DataItem>"
        "<DataItem Format=\"XML\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"3\">{} {} {}"
        "</DataItem></Geometry>\n",
        lattice.lattice, lattice.nodes[2], lattice.nodes[1], lattice.nodes[0], lattice.origin[2],
        lattice.origin[1], lattice.origin[0], lattice.spacing, lattice.spacing, lattice.spacing);
    for (std::size_t i = begin[l]; i < begin[l + 1]; ++i) {
      entry += "          " + attribute(arrays[i], 3, name_ + ".h5", path);
    }
    entry += "        </Grid>\n";
  }
  add_entry(first.time, entry + entry_end);
}

void XdmfSeries::add_entry(double time, std::string entry) {
  times_.push_back(time);
  entries_.push_back(std::move(entry));
  write_index();
}

void XdmfSeries::write_index() const {
  std::string text = index_head;
  for (const std::string& entry : entries_) text += entry;
  replace_file(folder_ / (name_ + ".xdmf"), text + index_tail);
}

void XdmfSeries::save(StateWriter& writer, const std::string& prefix) const {
  writer.put(prefix + "times", times_);
  if (file_) file_->state().save(writer, prefix + "file_");
}

void XdmfSeries::resume(const StateReader& reader, const std::string& prefix) {
  times_ = reader.get<double>(prefix + "times");
  if (times_.empty()) return;  // a file of later frames is replaced by the first new one
  const fs::path index = folder_ / (name_ + ".xdmf");
  entries_ = split_index(read_all(index));
  if (entries_.size() < times_.size()) {
    throw RunFault(fmt::format("cannot continue: frame {} of {} is missing in {}", entries_.size(),
                               name_, index.string()));
  }
  entries_.resize(times_.size());
  FrameFileState state;
  state.load(reader, prefix + "file_");
  // First the index, then the frames: it never names a frame that is not there.
  write_index();
  file_ = FrameFile::resume(folder_ / (name_ + ".h5"), state, deflate_);
}

std::string XdmfSeries::last_file() const {
  return entries_.empty() ? std::string()
                          : fmt::format("frame {} in {}.h5", entries_.size() - 1, name_);
}

}  // namespace scree
