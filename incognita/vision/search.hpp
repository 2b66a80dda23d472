// Active search: normalized cross-correlation of a patch inside the search ellipse of its landmark.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "incognita/vision/image.hpp"
#include "incognita/vision/patch.hpp"

namespace incognita {

/// Integral images of the gray values and of their squares: the sums over any square by four lookups.
class SummedImage {
 public:
  /// Keeps a pointer to the image, which must outlive this object.
  void assign(const Image& image);
  const Image& image() const { return *image_; }
  /// Takes a copy of the image in place of the image.
  void refer_to(const Image& copy) { image_ = &copy; }

  struct Sums {
    double sum, squares;
  };
  /// Sums over columns u .. u+size-1 and rows v .. v+size-1, which must lie in the image.
  Sums over(int u, int v, int size) const;

 private:
  const Image* image_ = nullptr;
  int stride_ = 0;
  /// Sum of gray values * 2^32 + sum of squares, modulo 2^64. Differences over up to 66051 pixels separate
  /// again into the two sums.
  std::vector<std::uint64_t> sums_;
};

/// Correlations of one patch with one image, each pixel computed at most once however many ellipses cover it.
class CorrelationSheet {
 public:
  /// Accepts patch centers in the given range, cropped so that the patch lies inside the image.
  void start(const SummedImage& image, const PatchTemplate& patch, int u_min, int u_max, int v_min,
             int v_max);

  /// Normalized cross-correlation in [-1, 1] with the patch centered at (u, v); -2 outside the range.
  double at(int u, int v);
  bool contains(int u, int v) const { return u >= u_min_ && u <= u_max_ && v >= v_min_ && v <= v_max_; }
  /// Number of correlations computed since start().
  int computed() const { return computed_; }

  /// Subpixel peak near an integer maximum: maximum of a quadratic through it and its eight neighbors.
  Eigen::Vector2d refine(int u, int v);

 private:
  double correlate(int u, int v) const;

  const SummedImage* image_ = nullptr;
  const PatchTemplate* patch_ = nullptr;
  int u_min_ = 0, u_max_ = -1, v_min_ = 0, v_max_ = -1;
  int computed_ = 0;
  std::vector<float> values_;
};

struct Ellipse {
  Eigen::Vector2d center;      ///< px
  Eigen::Matrix2d covariance;  ///< px^2
  double gate_sigmas = 3;
};

/// The ellipse to search for peaks in `gate`. Peaks lie between pixels, and the pixel nearest to one in the gate may lie outside:
/// a search of the gate alone would cut it off at the rim, and its match would be nearer to the prediction than the feature is.
/// Half axes below 1.4 px are widened by up to half a pixel diagonal; of the peaks in larger gates some at the rim are left out.
Ellipse with_nearest_pixels(const Ellipse& gate);

struct Found {
  Eigen::Vector2d pixel;
  double correlation = 0;
};

/// The best match of the patch inside the ellipse; nothing when no pixel in it can be tried. The caller
/// thresholds `correlation`.
std::optional<Found> search(CorrelationSheet& sheet, const SummedImage& image, const PatchTemplate& patch,
                            const Ellipse& ellipse, double max_half_axis_px);

/// The same with a sheet that was started before, e.g. shared by several ellipses of the same patch.
std::optional<Found> search(CorrelationSheet& sheet, const Ellipse& ellipse, double max_half_axis_px);

}  // namespace incognita
