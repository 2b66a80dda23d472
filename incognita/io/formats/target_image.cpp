#include "incognita/io/formats/target_image.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace incognita {
namespace {

constexpr int smallest_px = 9, largest_px = 100;              // per side; larger pictures are reduced
constexpr double least_apart_px = 4, max_residual_px = 0.25;  // of corners, in the reduced picture
constexpr double max_skew = 0.05;  // cosine between pixel sides; relative difference of their lengths

/// Means over squares of `side` pixels; incomplete squares at the right and bottom are dropped.
Image shrunk(const Image& whole, int side) {
  Image small(whole.width() / side, whole.height() / side);
  for (int v = 0; v < small.height(); ++v)
    for (int u = 0; u < small.width(); ++u) {
      int sum = 0;
      for (int y = v * side; y < (v + 1) * side; ++y)
        for (int x = u * side; x < (u + 1) * side; ++x) sum += whole(x, y);
      small(u, v) = static_cast<std::uint8_t>((sum + side * side / 2) / (side * side));
    }
  return small;
}

void check_inside(const Image& whole, const Eigen::MatrixX2d& px) {
  for (Eigen::Index i = 0; i < px.rows(); ++i)
    if (px.row(i).minCoeff() < 0 || px(i, 0) > whole.width() - 1 || px(i, 1) > whole.height() - 1)
      throw std::invalid_argument(
          fmt::format("must show the whole target, but picture_px of corner {} is outside", i));
}

void check_apart(const Eigen::MatrixX2d& px) {
  for (Eigen::Index i = 0; i < px.rows(); ++i)
    for (Eigen::Index k = 0; k < i; ++k)
      if ((px.row(i) - px.row(k)).norm() < least_apart_px)
        throw std::invalid_argument(fmt::format(
            "has too little detail: corners {} and {} are less than {} px apart after reduction to {} px", k,
            i, least_apart_px, largest_px));
}

/// Least squares over the corners.
Eigen::Matrix3d world_from(const Eigen::MatrixX2d& px, const std::vector<Target::Corner>& corners) {
  Eigen::MatrixX3d at(px.rows(), 3), positions(px.rows(), 3);
  at << px, Eigen::VectorXd::Ones(px.rows());
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    positions.row(i) = corners[static_cast<std::size_t>(i)].position;
  const Eigen::Matrix3d world_from_px = at.colPivHouseholderQr().solve(positions).transpose();
  const double wide = world_from_px.col(0).norm(), high = world_from_px.col(1).norm();
  const double cosine = world_from_px.col(0).dot(world_from_px.col(1)) / (wide * high);
  // The negated form also refuses NaN.
  if (!(std::abs(cosine) < max_skew && std::abs(wide - high) < max_skew * wide))
    throw std::invalid_argument(fmt::format(
        "must be a frontal view with square pixels; by picture_px a pixel is {:.3g} m wide and {:.3g} m high, with {:.0f} degrees between rows and columns",
        wide, high, std::acos(cosine) * 180 / std::numbers::pi));
  const double residual_px = (at * world_from_px.transpose() - positions).rowwise().norm().maxCoeff() / wide;
  if (!(residual_px < max_residual_px))
    throw std::invalid_argument(fmt::format(
        "must be a frontal view with picture_px at its corners; the positions of the corners are up to {:.2g} px from there",
        residual_px));
  return world_from_px;
}

}  // namespace

Target::Picture target_picture_from(const Target& target, const Image& whole,
                                    const Eigen::MatrixX2d& corner_px) {
  check_inside(whole, corner_px);
  const int side = (std::max(whole.width(), whole.height()) + largest_px - 1) / largest_px;
  if (std::min(whole.width(), whole.height()) < side * smallest_px)
    throw std::invalid_argument(
        fmt::format("must be {} px or more in width and height, and not too elongated; it is {}x{}",
                    smallest_px, whole.width(), whole.height()));
  const Eigen::MatrixX2d kept_px = (corner_px.array() - (side - 1) / 2.0) / side;
  check_apart(kept_px);
  Target::Picture picture{shrunk(whole, side), world_from(kept_px, target.corners)};
  const Eigen::Vector3d right = picture.world_from_px.col(0), down = picture.world_from_px.col(1);
  if (right.cross(down).dot(target.normal) >= 0)
    throw std::invalid_argument("is mirrored: the normal points away from the viewer");
  return picture;
}

}  // namespace incognita
