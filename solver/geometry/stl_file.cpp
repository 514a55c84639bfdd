// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "solver/geometry/mesh_file.hpp"
#include "solver/geometry/word_reader.hpp"

namespace scree {
namespace {

constexpr std::size_t header_size = 80, record_size = 50;

std::uint32_t little_endian(const char* bytes) {
  const auto* b = reinterpret_cast<const unsigned char*>(bytes);
  return std::uint32_t(b[0]) | std::uint32_t(b[1]) << 8 | std::uint32_t(b[2]) << 16 |
         std::uint32_t(b[3]) << 24;
}

/// Triangles that a binary file of this size announces and holds, or -1.
std::int64_t binary_triangles(const std::string& bytes) {
  if (bytes.size() < header_size + 4) return -1;
  const std::uint64_t count = little_endian(bytes.data() + header_size);
  return bytes.size() == header_size + 4 + record_size * count ? std::int64_t(count) : -1;
}

void add_triangle(TriangleMesh& mesh, const TriangleMesh::Point (&corner)[3]) {
  const std::int32_t first = std::int32_t(mesh.points.size());
  mesh.points.insert(mesh.points.end(), corner, corner + 3);
  mesh.triangles.push_back({first, first + 1, first + 2});
}

TriangleMesh read_binary(const std::string& bytes, std::int64_t count) {
  TriangleMesh mesh;
  mesh.points.reserve(3 * std::size_t(count));
  mesh.triangles.reserve(std::size_t(count));
  const char* record = bytes.data() + header_size + 4;
  for (std::int64_t t = 0; t < count; ++t, record += record_size) {
    TriangleMesh::Point corner[3];
    for (int i = 0; i < 9; ++i)  // after the normal, which is not needed
      corner[i / 3][std::size_t(i % 3)] =
          double(std::bit_cast<float>(little_endian(record + 12 + 4 * i)));
    add_triangle(mesh, corner);
  }
  return mesh;
}

/// `solid NAME`, then facets of three vertices; keywords in any case.
class TextStl {
 public:
  TextStl(const std::string& text, const std::string& region) : words_(text), region_(region) {}

  TriangleMesh read() {
    bool wanted = region_.empty();
    for (std::string word = next(); !word.empty(); word = next()) {
      if (word == "solid" || word == "endsolid") {
        const std::string name(words_.rest_of_line());
        if (word == "solid") {
          names_.push_back(name);
          wanted = region_.empty() || name == region_;
        }
      } else if (word == "facet") {
        facet(wanted);
      } else {
        fail("\"" + word + "\" stands where \"facet\" or \"endsolid\" is expected");
      }
    }
    if (!region_.empty() && std::find(names_.begin(), names_.end(), region_) == names_.end()) {
      std::erase(names_, "");
      unknown_region(region_, names_);
    }
    return std::move(mesh_);
  }

 private:
  std::string next() {
    std::string word(words_.next());
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return word;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw GeometryFault(
        "file", fmt::format("is no STL file that can be read: line {}: {}", words_.line(), what));
  }
  void expect(const char* keyword) {
    const std::string word = next();
    if (word != keyword) fail("\"" + word + "\" stands where \"" + keyword + "\" is expected");
  }
  double number() {
    const std::string word = next();
    double value = 0;
    if (!WordReader::number(word, value)) fail("\"" + word + "\" is no number");
    return value;
  }
  void facet(bool wanted) {
    expect("normal");
    for (int i = 0; i < 3; ++i) next();  // often wrong or "nan", and not needed
    expect("outer");
    expect("loop");
    TriangleMesh::Point corner[3];
    for (auto& point : corner) {
      expect("vertex");
      for (double& x : point) x = number();
    }
    expect("endloop");
    expect("endfacet");
    if (wanted) add_triangle(mesh_, corner);
  }

  WordReader words_;
  const std::string& region_;
  std::vector<std::string> names_;
  TriangleMesh mesh_;
};

bool begins_like_text(const std::string& bytes) {
  WordReader words(bytes);
  const std::string first(words.next());
  return first == "solid" || first == "SOLID" || bytes.find("facet") != std::string::npos;
}

}  // namespace

TriangleMesh read_stl(const std::string& path, const std::string& region) {
  const std::string bytes = read_geometry_file(path);
  const std::int64_t count = binary_triangles(bytes);
  if (count >= 0) {
    if (!region.empty()) unknown_region(region, {});
    return read_binary(bytes, count);
  }
  // Text has no zero bytes; a binary file that is cut short nearly always has.
  if (begins_like_text(bytes) && bytes.find('\0') == std::string::npos)
    return TextStl(bytes, region).read();
  if (bytes.size() < header_size + 4)
    throw GeometryFault("file", fmt::format("is no STL file: {} bytes", bytes.size()));
  throw GeometryFault(
      "file",
      fmt::format(
          "is no whole STL file: it announces {} triangles, which take {} bytes, "
          "and has {}",
          little_endian(bytes.data() + header_size),
          header_size + 4 + record_size * std::uint64_t(little_endian(bytes.data() + header_size)),
          bytes.size()));
}

}  // namespace scree
