// Active search: where in an ellipse a patch is seen, by normalised cross-correlation.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "incognita/vision/image.hpp"
#include "incognita/vision/patch.hpp"

namespace incognita {

/// Sums of pixels and of their squares over any rectangle in four look-ups. Made once per image.
class SummedImage {
 public:
  /// Keeps a pointer to the image, which must outlive it.
  void assign(const Image& image);
  const Image& image() const { return *image_; }

  struct Sums {
    double sum, squares;
  };
  /// Over columns u .. u+size-1 and rows v .. v+size-1, which must lie in the image.
  Sums over(int u, int v, int size) const;

 private:
  const Image* image_ = nullptr;
  int stride_ = 0;
  /// Sum of greys * 2^32 + sum of squares, modulo 2^64: of a rectangle of up to 66051 pixels the difference
  /// has both apart again.
  std::vector<std::uint64_t> sums_;
};

/// Correlations of one patch with one image, each place computed at most once however many ellipses cover it.
class CorrelationSheet {
 public:
  /// A sheet for centres inside the given range; what leaves no room for the patch in the image is cut off.
  void start(const SummedImage& image, const PatchTemplate& patch, int u_min, int u_max, int v_min,
             int v_max);

  /// Normalised cross-correlation in [-1, 1] with the patch centred there; -2 outside the range.
  double at(int u, int v);
  bool contains(int u, int v) const { return u >= u_min_ && u <= u_max_ && v >= v_min_ && v <= v_max_; }
  /// How many correlations were computed since start().
  int computed() const { return computed_; }

  /// The peak around an integer maximum, by a quadratic through its eight neighbours.
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

struct Found {
  Eigen::Vector2d pixel;
  double correlation = 0;
};

/// Best place of the patch inside the ellipse and nowhere else; nothing when no place in it can be tried.
/// The caller compares `correlation` with what it demands.
std::optional<Found> search(CorrelationSheet& sheet, const SummedImage& image, const PatchTemplate& patch,
                            const Ellipse& ellipse, double max_half_axis_px);

/// The same on a sheet that was started before, e.g. one that several ellipses of the same patch share.
std::optional<Found> search(CorrelationSheet& sheet, const Ellipse& ellipse, double max_half_axis_px);

}  // namespace incognita
