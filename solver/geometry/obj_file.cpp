// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "solver/geometry/mesh_file.hpp"
#include "solver/geometry/polygon.hpp"
#include "solver/geometry/word_reader.hpp"

namespace scree {
namespace {

/// `v x y z`, `f 1 2 3 ...` or `f 1/t/n ...`, `o NAME`, `g NAME...`. In double precision, which
/// VTK's reader is not.
class Obj {
 public:
  Obj(const std::string& text, const std::string& region) : words_(text), region_(region) {}

  TriangleMesh read() {
    while (!words_.at_end()) {
      const std::string word(words_.next_in_line());
      if (word == "v") vertex();
      if (word == "f") face();
      if (word == "o" || word == "g") name(word == "o" ? object_ : group_);
      words_.rest_of_line();
    }
    if (!region_.empty() && std::find(known_.begin(), known_.end(), region_) == known_.end())
      unknown_region(region_, known_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw GeometryFault(
        "file", fmt::format("is no OBJ file that can be read: line {}: {}", words_.line(), what));
  }

  void vertex() {
    TriangleMesh::Point point;
    for (double& x : point) {
      const std::string word(words_.next_in_line());
      if (!WordReader::number(word, x)) fail("\"" + word + "\" is no coordinate");
    }
    mesh_.points.push_back(point);
  }

  /// Of `f a/b/c` the part a; negative numbers count from the latest vertex.
  void face() {
    std::vector<std::int32_t> corners;
    for (std::string_view word = words_.next_in_line(); !word.empty() && word.front() != '#';
         word = words_.next_in_line()) {
      const std::int64_t count = std::int64_t(mesh_.points.size());
      std::int64_t number = 0;
      const bool read = WordReader::number(word.substr(0, word.find('/')), number);
      if (read && number < 0) number += count + 1;
      if (!read || number < 1 || number > count)
        fail(fmt::format("\"{}\" is none of the {} vertices so far", word, count));
      corners.push_back(std::int32_t(number - 1));
    }
    if (corners.size() < 3) fail("a face needs three corners");
    if (region_.empty() || has(object_) || has(group_)) add_polygon(mesh_, corners);
  }

  bool has(const std::vector<std::string>& names) const {
    return std::find(names.begin(), names.end(), region_) != names.end();
  }

  void name(std::vector<std::string>& current) {
    current.clear();
    for (std::string_view word = words_.next_in_line(); !word.empty(); word = words_.next_in_line())
      current.emplace_back(word);
    known_.insert(known_.end(), current.begin(), current.end());
  }

  WordReader words_;
  const std::string& region_;
  std::vector<std::string> object_, group_, known_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh read_obj(const std::string& path, const std::string& region) {
  const std::string text = read_geometry_file(path);
  return Obj(text, region).read();
}

}  // namespace scree
