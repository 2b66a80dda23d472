#include "incognita/models/motion/terrain.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace incognita {
namespace {

void need(bool ok, const char* what, double value) {
  if (!ok) throw std::invalid_argument(std::string(what) + ", got " + std::to_string(value));
}

/// Coefficients c of the natural cubic B-spline through the heights z of each column: (c[i-1] + 4 c[i] +
/// c[i+1])/6 = z[i] at every height, and zero curvature, c[i-1] - 2 c[i] + c[i+1] = 0, at the first and the
/// last. Row i of the result is c[i-1].
Eigen::MatrixXd spline_coefficients(const Eigen::MatrixXd& z) {
  const Eigen::Index n = z.rows();
  Eigen::MatrixXd c(n + 2, z.cols());
  auto inner = c.middleRows(1, n);
  inner = z;  // exact at both ends, where the two conditions give c = z
  // In between c[i-1] + 4 c[i] + c[i+1] = 6 z[i]: Thomas algorithm, stable by diagonal dominance
  Eigen::VectorXd above = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    const double pivot = 4 - above[i - 1];
    above[i] = 1 / pivot;
    inner.row(i) = (6 * z.row(i) - inner.row(i - 1)) / pivot;
  }
  for (Eigen::Index i = n - 2; i > 0; --i) inner.row(i) -= above[i] * inner.row(i + 1);
  c.row(0) = 2 * c.row(1) - c.row(2);
  c.row(n + 1) = 2 * c.row(n) - c.row(n - 1);
  return c;
}

}  // namespace

void TiltedPlane::check() const {
  need(std::isfinite(height_m), "terrain height_m must be finite", height_m);
  need(std::isfinite(slope_x), "terrain slope_x must be finite", slope_x);
  need(std::isfinite(slope_y), "terrain slope_y must be finite", slope_y);
}

void Waves::check() const {
  need(std::isfinite(height_m), "terrain height_m must be finite", height_m);
  for (const Wave& wave : waves) {
    need(std::isfinite(wave.amplitude_m), "terrain amplitude_m must be finite", wave.amplitude_m);
    need(std::isfinite(wave.length_m) && wave.length_m > 0, "terrain length_m must be positive",
         wave.length_m);
    need(std::isfinite(wave.direction_rad), "terrain direction_rad must be finite", wave.direction_rad);
    need(std::isfinite(wave.phase_rad), "terrain phase_rad must be finite", wave.phase_rad);
  }
}

HeightMap::HeightMap(const Eigen::MatrixXd& heights_m, double spacing_m, const Eigen::Vector2d& origin_m)
    : spacing_m_(spacing_m), origin_m_(origin_m) {
  const auto fewest = static_cast<double>(std::min(heights_m.rows(), heights_m.cols()));
  need(fewest >= 2, "a height map needs at least 2 heights along x and along y", fewest);
  need(heights_m.allFinite(), "the heights of a height map must be finite", heights_m.sum());
  need(std::isfinite(spacing_m) && spacing_m > 0, "height map spacing_m must be positive", spacing_m);
  need(origin_m.allFinite(), "height map origin_m must be finite", origin_m.sum());
  const Eigen::MatrixXd along_x = spline_coefficients(heights_m);
  coefficients_ = spline_coefficients(along_x.transpose()).transpose();
}

bool HeightMap::contains(double x, double y) const {
  const double along = (x - origin_m_.x()) / spacing_m_, across = (y - origin_m_.y()) / spacing_m_;
  return along >= 0 && across >= 0 && along <= static_cast<double>(coefficients_.rows() - 3) &&
         across <= static_cast<double>(coefficients_.cols() - 3);
}

}  // namespace incognita
