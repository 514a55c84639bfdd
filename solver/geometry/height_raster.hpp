// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace scree {

/// Heights on a regular raster, continued over the plane: bilinear between the centres of its
/// cells, constant from the outermost centres on.
class HeightRaster {
 public:
  /// \param height row by row from south to north, columns * rows of them, finite, m
  /// \param center of the cell in the south-west, m; \param cell_size m, > 0
  HeightRaster(int columns, int rows, std::array<double, 2> center, double cell_size,
               std::vector<double> height);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double cell_size() const { return cell_size_; }                  ///< m
  const std::array<double, 2>& center() const { return center_; }  ///< m
  /// The outer rims of the outermost cells, m.
  std::array<double, 2> lower() const;
  std::array<double, 2> upper() const;
  double lowest() const;                       ///< m
  double highest() const;                      ///< m
  std::array<double, 2> lowest_place() const;  ///< the centre of the lowest cell, m

  /// Height at (x, y), m; with its slopes if `slope` is given: along a line between cells those of
  /// the eastern or northern one.
  double height(double x, double y, double slope[2] = nullptr) const;
  /// A bound of the slope's magnitude everywhere.
  double steepest() const;
  /// The integral of the height over the raster's cells, m^3.
  double integral() const;

 private:
  double at(int i, int j) const {
    return height_[std::size_t(j) * std::size_t(columns_) + std::size_t(i)];
  }

  int columns_, rows_;
  std::array<double, 2> center_;
  double cell_size_;
  std::vector<double> height_;
};

/// Reads an ESRI ASCII raster: ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter,
/// cellsize, NODATA_value (-9999 unless given), then the rows from north to south.
/// \param scale m per unit of the file
/// \param no_data height of cells without data, in the file's unit; without it they are a fault
/// \throws GeometryFault
HeightRaster read_esri_raster(const std::string& path, double scale,
                              const std::array<double, 3>& shift, std::optional<double> no_data);

/// Height along a line, made of parabolas (a line through bilinear cells), constant beyond its
/// ends.
class HeightProfile {
 public:
  /// Along a straight line on the map, the coordinate s from 0 at `from`, m.
  HeightProfile(const HeightRaster& raster, const std::array<double, 2>& from,
                const std::array<double, 2>& to);
  /// Along the single row of a raster, s = x.
  explicit HeightProfile(const HeightRaster& row);

  double lower() const { return s_.front(); }  ///< m
  double upper() const { return s_.back(); }   ///< m
  double highest() const;                      ///< m
  double lowest() const;                       ///< m
  double height(double s, double* slope = nullptr) const;
  double steepest() const;
  double integral() const;  ///< m^2
  /// s -> s + along, height -> height + up.
  void move(double along, double up);

 private:
  /// h(s) = value + slope (s - s_k) + bend (s - s_k)^2 from s_k to s_(k+1)
  struct Piece {
    double value, slope, bend;
  };
  void cut(const HeightRaster& raster, const std::array<double, 2>& from,
           const std::array<double, 2>& direction, std::vector<double> places);
  std::vector<double> s_;
  std::vector<Piece> pieces_;
};

}  // namespace scree
