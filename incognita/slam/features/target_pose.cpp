#include "incognita/slam/features/target_pose.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "incognita/slam/features/target_picture.hpp"
#include "incognita/vision/corners.hpp"

namespace incognita {
namespace {

constexpr double min_correlation =
    0.7;                            // of a corner's patch: seen from another distance it is never quite alike
constexpr int max_candidates = 14;  // per corner; all combinations of places are tried
constexpr double max_affine_residual = 0.25;  // of the target's size in the image: perspective allows no more
constexpr double max_sigma_m = 0.3;  // a pose less sure than this, from corners nearly in one place, is none
constexpr double max_rms_px = 1.5;   // of a right combination
constexpr int rounded_px = 5;        // of a corner: by the blur of camera and print
constexpr double max_refinement_px = 2;  // from where the pose puts a corner to where its edges meet
// Likeness less 0.2 per pixel of misfit. A target gives 0.9 and more, even seen from 60 degrees aside; what
// only happens to stand as its corners do hardly ever gives 0.85, and every textured room has such places.
constexpr double min_score = 0.87;
// To the picture, where there is one. In the rendered room a target gives 0.98 and more where its pose is
// right, mostly less where it is tilted wrongly, for it is flat and far, and other things give 0.4.
constexpr double min_initial_similarity = 0.7, min_similarity = 0.98;
constexpr double gate_sigmas = 3;  // within which two poses fit alike

struct ImageCandidate {
  Eigen::Vector2d pixel;
  double correlation;
  double dark, bright;  ///< grey levels there of what is darkest and brightest in the patch
};

/// What correlation does not look at: how much brighter and richer in contrast the place is than the patch.
ImageCandidate candidate_at(const SummedImage& image, const PatchTemplate& patch, int u, int v) {
  const double n = static_cast<double>(patch.size) * patch.size;
  const SummedImage::Sums here = image.over(u - patch.size / 2, v - patch.size / 2, patch.size);
  const double mean = here.sum / n, sigma = std::sqrt(std::max(0.0, here.squares / n - mean * mean));
  const double gain = sigma * std::sqrt(n) / patch.norm;
  const auto [least, most] = std::minmax_element(patch.values.begin(), patch.values.end());
  return {{u, v}, 0, mean + gain * *least, mean + gain * *most};
}

/// The best few local maxima of correlation over the whole image.
std::vector<ImageCandidate> best_candidates(const SummedImage& image, const PatchTemplate& patch,
                                            CorrelationSheet& sheet) {
  const int width = image.image().width(), height = image.image().height();
  sheet.start(image, patch, 0, width - 1, 0, height - 1);
  std::vector<ImageCandidate> places;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const double here = sheet.at(u, v);
      if (here < min_correlation) continue;
      bool peak = true;
      for (int dv = -1; dv <= 1 && peak; ++dv)
        for (int du = -1; du <= 1 && peak; ++du)
          peak = (du == 0 && dv == 0) || sheet.at(u + du, v + dv) <= here;
      if (!peak) continue;
      places.push_back(candidate_at(image, patch, u, v));
      places.back().pixel = sheet.refine(u, v);
      places.back().correlation = here;
    }
  std::sort(places.begin(), places.end(),
            [](const ImageCandidate& a, const ImageCandidate& b) { return a.correlation > b.correlation; });
  if (places.size() > max_candidates) places.resize(max_candidates);
  return places;
}

std::optional<PatchTemplate> as_template(const Image& patch) {
  const double middle = std::floor(patch.width() / 2.0);
  return warp({patch, {middle, middle}}, Eigen::Matrix2d::Identity(),
              std::min(max_patch_size, patch.width()));
}

/// A quick look at a combination before a pose is solved: seen from its printed side and not too near, a flat
/// target looks nearly like its plan under an affine map, and corners must be further apart than a patch is
/// wide.
class QuickCheck {
 public:
  QuickCheck(const Target& target, double least_apart_px) : least_apart_px_(least_apart_px) {
    // Plan of the target with x to the right and y down for someone facing it
    const Eigen::Vector3d any =
        std::abs(target.normal.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    const Eigen::Vector3d right = any.cross(target.normal).normalized(), down = right.cross(-target.normal);
    plan_.resize(static_cast<Eigen::Index>(target.corners.size()), 3);
    for (Eigen::Index i = 0; i < plan_.rows(); ++i) {
      const Eigen::Vector3d at =
          target.corners[static_cast<std::size_t>(i)].position - target.corners[0].position;
      plan_.row(i) << at.dot(right), -at.dot(down), 1;
    }
    // Least squares; four_of() takes no four on one line
    solve_ = (plan_.transpose() * plan_).inverse() * plan_.transpose();
  }

  bool plausible(const std::vector<Eigen::Vector2d>& pixels) const {
    Eigen::MatrixX2d observed_px(plan_.rows(), 2);
    for (Eigen::Index i = 0; i < plan_.rows(); ++i) {
      observed_px.row(i) = pixels[static_cast<std::size_t>(i)];
      for (Eigen::Index k = 0; k < i; ++k)
        if ((observed_px.row(i) - observed_px.row(k)).norm() < least_apart_px_) return false;
    }
    const Eigen::Matrix<double, 3, 2> affine = solve_ * observed_px;
    if (affine.topRows<2>().determinant() <= 0) return false;  // mirrored: seen from behind
    const double residual = (plan_ * affine - observed_px).rowwise().norm().maxCoeff();
    const double size = (observed_px.rowwise() - observed_px.colwise().mean()).rowwise().norm().maxCoeff();
    return residual < max_affine_residual * size;
  }

 private:
  double least_apart_px_;
  Eigen::MatrixX3d plan_;
  Eigen::Matrix3Xd solve_;
};

/// Mean correlation, less what tells the corners of one thing in one light from corners of different things:
/// how far apart their dark and bright levels are, as a share of the contrast.
double similarity(const std::vector<const ImageCandidate*>& corners) {
  double correlation = 0, contrast = 0;
  double dark[] = {1e9, -1e9}, bright[] = {1e9, -1e9};  // least, most
  for (const ImageCandidate* corner : corners) {
    correlation += corner->correlation / static_cast<double>(corners.size());
    contrast += (corner->bright - corner->dark) / static_cast<double>(corners.size());
    dark[0] = std::min(dark[0], corner->dark), dark[1] = std::max(dark[1], corner->dark);
    bright[0] = std::min(bright[0], corner->bright), bright[1] = std::max(bright[1], corner->bright);
  }
  return correlation - 0.2 * std::max(dark[1] - dark[0], bright[1] - bright[0]) / contrast;
}

/// Of what is seen from the pose to the target's picture; 1 where there is none.
double similarity_at_pose(const Target& target, const Camera& camera, const Image& image,
                          const TargetPose& pose) {
  return target.picture ? correlation_with_picture(target, camera, image, pose) : 1;
}

struct Best {
  std::optional<TargetPose> pose;
  std::optional<double> unlike;  ///< the most likeness to the picture, of poses that were not like it enough
};

/// The next choice of one place for each corner, as an odometer counts; false after the last.
bool next(std::vector<std::size_t>& index, const std::vector<std::vector<ImageCandidate>>& places) {
  for (std::size_t c = 0; c < places.size(); ++c) {
    if (++index[c] < places[c].size()) return true;
    index[c] = 0;
  }
  return false;
}

/// Tries every combination of places, one per corner.
Best try_combinations(const Target& target, const Camera& camera, const Image& image,
                      const std::vector<std::vector<ImageCandidate>>& places, double sigma_pixel_px) {
  Best best;
  const QuickCheck quick(target, std::min(max_patch_size, target.corners.front().patch.width()));
  std::vector<Eigen::Vector3d> points;
  for (const auto& corner : target.corners) points.push_back(corner.position);
  std::vector<std::size_t> index(places.size(), 0);
  double best_score = min_score;
  do {
    std::vector<Eigen::Vector2d> pixels;
    std::vector<const ImageCandidate*> corners;
    for (std::size_t c = 0; c < places.size(); ++c) {
      corners.push_back(&places[c][index[c]]);
      pixels.push_back(corners.back()->pixel);
    }
    const double alike = similarity(corners);
    if (alike > best_score && quick.plausible(pixels)) {
      const auto poses = solve_pose(points, pixels, camera, sigma_pixel_px);
      const bool good = !poses.empty() && poses[0].rms_px < max_rms_px &&
                        poses[0].covariance.diagonal().head<3>().maxCoeff() < max_sigma_m * max_sigma_m &&
                        target.normal.dot(poses[0].position - points[0]) > 0;
      // Half a pixel of misfit weighs as much as 0.1 of correlation
      const double score = good ? alike - 0.2 * poses[0].rms_px : 0;
      if (score <= best_score) continue;
      const double like = similarity_at_pose(target, camera, image, poses[0]);
      if (like > min_initial_similarity)
        best_score = score, best.pose = poses[0];
      else
        best.unlike = std::max(best.unlike.value_or(like), like);
    }
  } while (next(index, places));
  return best;
}

/// `least`: the likeness that it would need.
std::string not_like(const Target& target, double similarity, double least) {
  std::ostringstream why;
  why << "what stands as the corners of target " << target.name;
  if (similarity <= -1) {
    why << " has less than half of its picture in the image, or is of one grey there";
  } else {
    why << " is like its picture to " << std::floor(1000 * similarity) / 1000 << " only, and must be to "
        << least;
    if (least == min_similarity)
      why << ": start nearer, or see whether picture_px are right to a quarter of a pixel";
  }
  return why.str();
}

std::string no_pose(const Target& target) {
  return "places like the corners of target " + target.name + " fit no camera pose";
}

/// Four corners far apart and not on one line: combinations of more would take time exponential in their
/// number, and four are enough for a pose.
Target four_of(const Target& target) {
  Target four = target;
  four.corners = {target.corners.front()};
  const auto add_farthest = [&](auto distance) {
    four.corners.push_back(
        *std::max_element(target.corners.begin(), target.corners.end(),
                          [&](const auto& a, const auto& b) { return distance(a) < distance(b); }));
  };
  const auto from_taken = [&](const Target::Corner& corner) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& taken : four.corners)
      nearest = std::min(nearest, (corner.position - taken.position).norm());
    return nearest;
  };
  const auto from_their_line = [&](const Target::Corner& corner) {
    const Eigen::Vector3d& a = four.corners[0].position;
    return (corner.position - a).cross(four.corners[1].position - a).norm();
  };
  add_farthest(from_taken);
  add_farthest(from_their_line);
  add_farthest(from_taken);
  return four;
}

/// Where all corners are seen from a pose; nothing when one of them is not.
std::optional<std::vector<Eigen::Vector2d>> seen_from(const TargetPose& pose, const Target& target,
                                                      const Camera& camera) {
  const Eigen::Matrix3d camera_from_world = rotation_matrix(pose.world_from_camera).transpose();
  std::vector<Eigen::Vector2d> pixels;
  for (const auto& corner : target.corners) {
    const auto projected = camera.project(camera_from_world * (corner.position - pose.position));
    if (!projected || !camera.contains(projected->pixel)) return std::nullopt;
    pixels.push_back(projected->pixel);
  }
  return pixels;
}

/// A patch from a file is never quite alike, so its correlation peaks a little beside the corner, the same
/// way in every run: the edges in the image itself say where the corner is.
std::vector<Eigen::Vector2d> to_edges(const Image& image, const std::vector<Eigen::Vector2d>& pixels,
                                      int window_px) {
  std::vector<Eigen::Vector2d> refined;
  for (const Eigen::Vector2d& at : pixels) {
    const auto center = center_of_corner(image, at, window_px, rounded_px);
    refined.push_back(center && (*center - at).norm() < max_refinement_px ? *center : at);
  }
  return refined;
}

/// Whether the pixels fit both poses that a flat target allows, and those are far apart: seen from far, and
/// nearly straight on, only the noise says which.
bool two_fit(const std::vector<TargetPose>& poses, double sigma_pixel_px) {
  if (poses.size() < 2) return false;
  const double worse = std::pow(poses[1].rms_px, 2) - std::pow(poses[0].rms_px, 2);
  return static_cast<double>(poses[0].pixels.size()) * worse < std::pow(gate_sigmas * sigma_pixel_px, 2) &&
         (poses[0].position - poses[1].position).norm() > 2 * max_sigma_m;
}

/// Solved again from all corners, each taken from its edges. Of the two poses that a flat target allows, the
/// one nearer to what was found.
TargetSearch refined(const Target& target, const Camera& camera, const Image& image, double sigma_pixel_px,
                     const TargetPose& found) {
  std::vector<Eigen::Vector3d> points;
  for (const auto& corner : target.corners) points.push_back(corner.position);
  const auto expected = seen_from(found, target, camera);
  if (!expected) return {std::nullopt, "not all corners of target " + target.name + " are in the image"};
  const int window = std::min(max_patch_size, target.corners.front().patch.width());
  const auto poses = solve_pose(points, to_edges(image, *expected, window), camera, sigma_pixel_px);
  const auto nearest = std::min_element(poses.begin(), poses.end(), [&](const auto& a, const auto& b) {
    return (a.position - found.position).norm() < (b.position - found.position).norm();
  });
  if (nearest == poses.end() || nearest->rms_px > max_rms_px) return {std::nullopt, no_pose(target)};
  const double like = similarity_at_pose(target, camera, image, *nearest);
  if (like < min_similarity) return {std::nullopt, not_like(target, like, min_similarity)};
  if (two_fit(poses, sigma_pixel_px))
    return {std::nullopt, "two poses fit the corners of target " + target.name +
                              ", as it is flat and far: start nearer, or more from aside"};
  return {*nearest, ""};
}

}  // namespace

TargetSearch find_target(const Target& target, const Camera& camera, const SummedImage& image,
                         double sigma_pixel_px) {
  std::vector<std::vector<ImageCandidate>> places;
  CorrelationSheet sheet;
  const Target four = four_of(target);
  for (std::size_t c = 0; c < four.corners.size(); ++c) {
    const auto patch = as_template(four.corners[c].patch);
    if (!patch)
      return {std::nullopt, "corner " + std::to_string(c) + " of target " + target.name + " has no contrast"};
    places.push_back(best_candidates(image, *patch, sheet));
    if (places.back().empty())
      return {std::nullopt, "corner " + std::to_string(c) + " of target " + target.name +
                                " is nowhere in the image (correlation below 0.7)"};
  }
  const Best best = try_combinations(four, camera, image.image(), places, sigma_pixel_px);
  if (best.pose) return refined(target, camera, image.image(), sigma_pixel_px, *best.pose);
  return {std::nullopt,
          best.unlike ? not_like(target, *best.unlike, min_initial_similarity) : no_pose(target)};
}

}  // namespace incognita
