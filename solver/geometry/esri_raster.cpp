// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "solver/geometry/height_raster.hpp"
#include "solver/geometry/mesh_file.hpp"
#include "solver/geometry/word_reader.hpp"

namespace scree {
namespace {

constexpr double most_cells = 1e9;

class EsriRaster {
 public:
  explicit EsriRaster(const std::string& text) : words_(text) {}

  HeightRaster read(double scale, const std::array<double, 3>& shift,
                    std::optional<double> no_data) {
    std::string_view word = header();
    const int columns = count("ncols"), rows = count("nrows");
    if (double(columns) * rows > most_cells) fail("its header announces more than 1e9 cells");
    const double size = get("cellsize");
    if (!std::isgreater(size, 0.0)) fail("cellsize must be above 0");
    const std::array<double, 2> corner{center("x", size), center("y", size)};
    const double missing = values_.contains("nodata_value") ? get("nodata_value") : -9999;
    std::vector<double> height(std::size_t(columns) * std::size_t(rows));
    for (int row = rows - 1; row >= 0; --row)  // the file begins in the north
      for (int column = 0; column < columns; ++column, word = words_.next()) {
        double value = number(word, rows - row, column + 1);
        if (value == missing || !std::isfinite(value))
          value = fill(no_data, corner, size, column, row);
        height[std::size_t(row) * std::size_t(columns) + std::size_t(column)] =
            scale * value + shift[2];
      }
    if (!word.empty())
      fail(fmt::format("\"{}\" stands after the last of {} x {} heights", word, columns, rows));
    return {columns,
            rows,
            {scale * corner[0] + shift[0], scale * corner[1] + shift[1]},
            scale * size,
            std::move(height)};
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw GeometryFault("file", fmt::format("is no ESRI ASCII raster that can be read: line {}: {}",
                                            words_.line(), what));
  }

  /// Reads "key value" lines; returns the first word after them.
  std::string_view header() {
    for (;;) {
      const std::string_view word = words_.next();
      double value = 0;
      if (word.empty() || WordReader::number(word, value)) return word;
      std::string key(word);
      std::transform(key.begin(), key.end(), key.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      static constexpr const char* known[] = {"ncols",     "nrows",       "xllcorner",
                                              "yllcorner", "xllcenter",   "yllcenter",
                                              "cellsize",  "nodata_value"};
      if (std::find(std::begin(known), std::end(known), key) == std::end(known))
        fail(fmt::format("unknown key \"{}\" in the header", word));
      const std::string_view text = words_.next();
      if (!WordReader::number(text, value))
        fail(fmt::format("{} is \"{}\", not a number", word, text));
      values_[key] = value;
    }
  }
  double get(const std::string& key) const {
    const auto found = values_.find(key);
    if (found == values_.end()) fail("the header has no " + key);
    return found->second;
  }
  int count(const char* key) const {
    const double value = get(key);
    if (!(value >= 1) || value != std::floor(value) || value > most_cells)
      fail(fmt::format("{} must be a whole number above 0", key));
    return int(value);
  }
  /// The centre of the first cell along an axis, from its corner or as it stands.
  double center(const std::string& axis, double size) const {
    if (values_.contains(axis + "llcenter")) return get(axis + "llcenter");
    return get(axis + "llcorner") + 0.5 * size;
  }
  double number(std::string_view word, int row, int column) const {
    double value = 0;
    if (word.empty()) fail(fmt::format("the heights end before row {}, column {}", row, column));
    if (!WordReader::number(word, value))
      fail(fmt::format("\"{}\" is no height (row {}, column {})", word, row, column));
    return value;
  }
  double fill(std::optional<double> no_data, const std::array<double, 2>& corner, double size,
              int column, int row) const {
    if (no_data) return *no_data;
    throw GeometryFault("file",
                        fmt::format("has a cell without data, the first at ({:.9g}, {:.9g}) "
                                    "of the map; cut it off, fill it, or give all such "
                                    "cells a height with no_data",
                                    corner[0] + column * size, corner[1] + row * size));
  }

  WordReader words_;
  std::map<std::string, double> values_;
};

}  // namespace

HeightRaster read_esri_raster(const std::string& path, double scale,
                              const std::array<double, 3>& shift, std::optional<double> no_data) {
  const std::string text = read_geometry_file(path);
  return EsriRaster(text).read(scale, shift, no_data);
}

}  // namespace scree
