#include "incognita/vision/align_patch.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

namespace incognita {
namespace {

constexpr int max_steps = 3;
constexpr double converged_px = 0.01;
constexpr double farthest_px = 1;     // from the start
constexpr double least_gradient = 1;  // rms over the patch along its weakest direction, gray levels per pixel

/// A square of gray values with a side of up to max_patch_size + 4.
class Window {
 public:
  explicit Window(int side) : side_(side) {}
  double& operator()(int row, int column) { return values_[static_cast<std::size_t>(row * side_ + column)]; }
  double operator()(int row, int column) const {
    return values_[static_cast<std::size_t>(row * side_ + column)];
  }

  /// Without its rim, smoothed by 1 2 1 along rows and columns: the gradients of sharp edges reach farther, and what
  /// interpolation between pixels gets wrong is damped.
  Window smoothed() const {
    Window result(side_ - 2);
    for (int r = 1; r + 1 < side_; ++r)
      for (int c = 1; c + 1 < side_; ++c)
        result(r - 1, c - 1) = (row_sum(r - 1, c) + 2 * row_sum(r, c) + row_sum(r + 1, c)) / 16;
    return result;
  }

 private:
  double row_sum(int r, int c) const { return (*this)(r, c - 1) + 2 * (*this)(r, c) + (*this)(r, c + 1); }

  int side_;
  std::array<double, (max_patch_size + 4) * (max_patch_size + 4)> values_;
};

/// Image values around the pixel (u, v), `half` to each side.
Window window_of(const Image& image, int u, int v, int half) {
  Window window(2 * half + 1);
  for (int r = -half; r <= half; ++r)
    for (int c = -half; c <= half; ++c) window(r + half, c + half) = image(u + c, v + r);
  return window;
}

/// The texture as it appears in the same pixels if the landmark is `off` px from the one in the middle.
Window window_of(const WarpedTexture& texture, const Eigen::Vector2d& off, int half) {
  Window window(2 * half + 1);
  for (int r = -half; r <= half; ++r)
    for (int c = -half; c <= half; ++c) window(r + half, c + half) = texture.at(Eigen::Vector2d(c, r) - off);
  return window;
}

/// One Gauss-Newton step. With the texture T, smoothed, and its gradient G (1x2), the image is gain * T + shift - gain * G *
/// step: linear in gain, shift and gain * step, so least squares give all at once. `image`: side `size`; `texture`: with one
/// pixel more on each side.
std::optional<Eigen::Vector2d> step_towards(const Window& image, const Window& texture, int size) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  for (int r = 0; r < size; ++r)
    for (int c = 0; c < size; ++c) {
      const Eigen::Vector4d row((texture(r + 1, c + 2) - texture(r + 1, c)) / 2,
                                (texture(r + 2, c + 1) - texture(r, c + 1)) / 2, texture(r + 1, c + 1), 1);
      A.noalias() += row * row.transpose();
      b += row * image(r, c);
    }
  const Eigen::Matrix2d gradients = A.topLeftCorner<2, 2>() / (size * size);
  const double mean = gradients.trace() / 2,
               spread = std::hypot((gradients(0, 0) - gradients(1, 1)) / 2, gradients(0, 1));
  if (!(mean - spread > least_gradient * least_gradient)) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix4d> decomposed(A);
  const Eigen::Vector4d x = decomposed.solve(b);
  const double gain = x[2];
  if (!(gain > 0)) return std::nullopt;
  return Eigen::Vector2d(-x.head<2>() / gain);
}

}  // namespace

std::optional<Eigen::Vector2d> align_patch(const Image& image, const PatchTexture& texture,
                                           const Eigen::Matrix2d& texture_from_view, int size,
                                           const Eigen::Vector2d& start) {
  const int half = size / 2;
  const WarpedTexture warped(texture, texture_from_view);
  const Eigen::Vector2d middle = start.array().round();
  const int rim = half + 1;
  if (!warped.covers(half + 2) || !(middle.x() >= rim) || !(middle.y() >= rim) ||
      !(middle.x() < image.width() - rim) || !(middle.y() < image.height() - rim))
    return std::nullopt;
  const Window seen =
      window_of(image, static_cast<int>(middle.x()), static_cast<int>(middle.y()), rim).smoothed();
  Eigen::Vector2d at = start;
  for (int i = 0; i < max_steps; ++i) {
    const Window expected = window_of(warped, at - middle, half + 2).smoothed();
    const auto step = step_towards(seen, expected, size);
    if (!step) return std::nullopt;
    at += *step;
    if (!((at - start).cwiseAbs().maxCoeff() <= farthest_px)) return std::nullopt;
    if (step->norm() < converged_px) break;
  }
  return at;
}

}  // namespace incognita
