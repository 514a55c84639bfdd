// SPDX-License-Identifier: Apache-2.0
#include "postproc/plot/canvas.hpp"

#include <vtkFreeTypeTools.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "solver/base/error.hpp"
#include "solver/io/durable_file.hpp"

namespace scree {
namespace {

constexpr Colour ink{0.13, 0.13, 0.13};

double length(Pixel a, Pixel b) { return std::hypot(b.x - a.x, b.y - a.y); }

double distance_to_segment(Pixel p, Pixel a, Pixel b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double along = square > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return length(p, {a.x + t * dx, a.y + t * dy});
}

/// The parts of a line that dashes draw, as pairs of points.
std::vector<std::pair<Pixel, Pixel>> pieces(const std::vector<Pixel>& points, double dash) {
  std::vector<std::pair<Pixel, Pixel>> result;
  double walked = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Pixel a = points[i - 1], b = points[i];
    const double whole = length(a, b);
    const auto at = [&](double s) {
      return Pixel{a.x + (b.x - a.x) * s / whole, a.y + (b.y - a.y) * s / whole};
    };
    if (dash <= 0) result.push_back({a, b});
    for (double s = 0; dash > 0 && s < whole;) {
      const double phase = std::fmod(walked + s, 2 * dash);
      const double end = std::min(whole, s + (phase < dash ? dash : 2 * dash) - phase + 1e-6);
      if (phase < dash) result.push_back({at(s), at(end)});
      s = end;
    }
    walked += whole;
  }
  return result;
}

/// How much of each pixel of a rectangle is covered.
class Coverage {
 public:
  explicit Coverage(const Frame& box)
      : box_(box),
        left_(static_cast<int>(box.left)),
        bottom_(static_cast<int>(box.bottom)),
        columns_(static_cast<int>(box.right) - left_ + 1),
        rows_(static_cast<int>(box.top) - bottom_ + 1),
        share_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0F) {}

  /// A segment with round ends.
  void add(Pixel a, Pixel b, double radius) {
    const double reach = radius + 1;
    const int x0 = static_cast<int>(std::max(box_.left, std::floor(std::min(a.x, b.x) - reach)));
    const int x1 = static_cast<int>(std::min(box_.right, std::ceil(std::max(a.x, b.x) + reach)));
    const int y0 = static_cast<int>(std::max(box_.bottom, std::floor(std::min(a.y, b.y) - reach)));
    const int y1 = static_cast<int>(std::min(box_.top, std::ceil(std::max(a.y, b.y) + reach)));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double d = distance_to_segment({x + 0.5, y + 0.5}, a, b);
        float& share = at(x, y);
        share = std::max(share, static_cast<float>(std::clamp(radius + 0.5 - d, 0.0, 1.0)));
      }
    }
  }

  template <class Visit>
  void for_each(Visit visit) {
    for (int y = bottom_; y < bottom_ + rows_; ++y) {
      for (int x = left_; x < left_ + columns_; ++x) {
        if (at(x, y) > 0) visit(x, y, static_cast<double>(at(x, y)));
      }
    }
  }

 private:
  float& at(int x, int y) {
    return share_[static_cast<std::size_t>(y - bottom_) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(x - left_)];
  }

  Frame box_;
  int left_, bottom_, columns_, rows_;
  std::vector<float> share_;
};

}  // namespace

Canvas::Canvas(int width, int height)
    : width_(width),
      height_(height),
      pixels_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255) {}

void Canvas::blend(int x, int y, const Colour& colour, double share) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_ || share <= 0) return;
  std::uint8_t* p = &pixels_[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                  static_cast<std::size_t>(x))];
  for (std::size_t c = 0; c < 3; ++c) {
    const double mixed = p[c] + share * (255 * colour[c] - p[c]);
    p[c] = static_cast<std::uint8_t>(std::lround(std::clamp(mixed, 0.0, 255.0)));
  }
}

void Canvas::line(const std::vector<Pixel>& points, const Frame& frame, Colour colour,
                  double thickness, double dash) {
  if (points.empty()) return;
  // Points less than a third of a pixel apart look like one.
  std::vector<Pixel> kept{points.front()};
  for (const Pixel& p : points) {
    if (length(kept.back(), p) > 0.33) kept.push_back(p);
  }
  kept.push_back(points.back());
  Frame box{frame.right, frame.top, frame.left, frame.bottom};
  for (const Pixel& p : kept) {
    box = {std::min(box.left, p.x), std::min(box.bottom, p.y), std::max(box.right, p.x),
           std::max(box.top, p.y)};
  }
  const double reach = 0.5 * thickness + 2;
  box.left = std::floor(std::max({0.0, frame.left, box.left - reach}));
  box.bottom = std::floor(std::max({0.0, frame.bottom, box.bottom - reach}));
  box.right = std::min({width_ - 1.0, frame.right, box.right + reach});
  box.top = std::min({height_ - 1.0, frame.top, box.top + reach});
  if (box.right < box.left || box.top < box.bottom) return;
  // The largest share a pixel is covered by any piece: overlapping ends do not show.
  Coverage coverage(box);
  for (const auto& [a, b] : pieces(kept, dash)) coverage.add(a, b, 0.5 * thickness);
  coverage.for_each([&](int x, int y, double share) { blend(x, y, colour, share); });
}

void Canvas::dot(Pixel centre, double radius, Colour colour) {
  const Frame everything{0, 0, width_ - 1.0, height_ - 1.0};
  line({centre}, everything, colour, 2 * radius);
}

void Canvas::fill(const Frame& frame, Colour colour) {
  const auto first = [](double x) { return static_cast<int>(std::lround(x)); };
  for (int y = first(frame.bottom); y < first(frame.top); ++y) {
    for (int x = first(frame.left); x < first(frame.right); ++x) blend(x, y, colour, 1);
  }
}

int Canvas::text(Pixel at, const std::string& words, double size, Anchor along, Anchor across,
                 bool bold, bool upward) {
  vtkNew<vtkTextProperty> style;
  style->SetFontFamilyToArial();
  style->SetFontSize(static_cast<int>(std::lround(size)));
  style->SetColor(ink[0], ink[1], ink[2]);
  style->SetBold(bold);
  style->SetOrientation(upward ? 90 : 0);
  vtkNew<vtkImageData> image;
  int used[2] = {0, 0};
  vtkFreeTypeTools* tools = vtkFreeTypeTools::GetInstance();
  tools->ScaleToPowerTwoOff();
  if (words.empty() || !tools->RenderString(style, vtkStdString(words), 72, image, used)) return 0;
  const int* extent = image->GetExtent();
  const auto start = [](double place, int pixels, Anchor anchor) {
    const double share = anchor == Anchor::low ? 0 : anchor == Anchor::middle ? 0.5 : 1;
    return static_cast<int>(std::lround(place - share * pixels));
  };
  const int x0 = start(at.x, used[0], upward ? across : along);
  const int y0 = start(at.y, used[1], upward ? along : across);
  for (int y = 0; y < used[1]; ++y) {
    for (int x = 0; x < used[0]; ++x) {
      const auto* rgba = static_cast<const std::uint8_t*>(
          image->GetScalarPointer(extent[0] + x, extent[2] + y, 0));
      blend(x0 + x, y0 + y, ink, rgba[3] / 255.0);
    }
  }
  return upward ? used[1] : used[0];
}

Colour Canvas::pixel(int x, int y) const {
  const std::uint8_t* p =
      &pixels_[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(x))];
  return {p[0] / 255.0, p[1] / 255.0, p[2] / 255.0};
}

void Canvas::write_png(const std::string& path, const std::string& mark) const {
  vtkNew<vtkImageData> image;
  image->SetDimensions(width_, height_, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::memcpy(image->GetScalarPointer(), pixels_.data(), pixels_.size());
  vtkNew<vtkPNGWriter> writer;
  writer->WriteToMemoryOn();
  writer->SetCompressionLevel(9);
  writer->AddText("Software", mark.c_str());
  writer->SetInputData(image);
  writer->Write();
  vtkUnsignedCharArray* data = writer->GetResult();
  if (data == nullptr) throw RunFault(write_failure(path, ENOMEM));
  const auto count = static_cast<std::size_t>(data->GetNumberOfTuples());
  replace_file(path, std::string(reinterpret_cast<const char*>(data->GetPointer(0)), count));
}

}  // namespace scree
