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

constexpr double min_correlation = 0.7;       // of a corner patch; scale and blur differ from the file
constexpr int max_candidates = 14;            // per corner; all combinations are tried
constexpr double max_affine_residual = 0.25;  // of the target's image size: limit of the perspective effect
constexpr double max_sigma_m = 0.3;           // upper limit, exceeded by nearly coincident corners
constexpr double max_rms_px = 1.5;            // of a correct combination
constexpr int rounded_px = 5;                 // of a corner, by the blur of camera and print
constexpr double max_refinement_px = 2;       // from the projected corner to the intersection of its edges
// Similarity minus 0.2 per pixel of reprojection error. Targets give 0.9 and more, even at 60 degrees.
// Accidental constellations, which every textured room contains, hardly ever give 0.85.
constexpr double min_score = 0.87;
// Correlation with the picture, if there is one. In the rendered room a target gives 0.98 and more at the correct
// pose, mostly less at a wrong tilt (the ambiguity of a distant flat target), and other objects give 0.4.
constexpr double min_initial_similarity = 0.7, min_similarity = 0.98;
constexpr double gate_sigmas = 3;  // within which two poses fit equally well

struct ImageCandidate {
  Eigen::Vector2d pixel;
  double correlation;
  double dark, bright;  ///< gray levels of the darkest and brightest part of the patch
};

/// The brightness and contrast of a candidate, to which correlation is invariant.
ImageCandidate candidate_at(const SummedImage& image, const PatchTemplate& patch, int u, int v) {
  const double n = static_cast<double>(patch.size) * patch.size;
  const SummedImage::Sums here = image.over(u - patch.size / 2, v - patch.size / 2, patch.size);
  const double mean = here.sum / n, sigma = std::sqrt(std::max(0.0, here.squares / n - mean * mean));
  const double gain = sigma * std::sqrt(n) / patch.norm;
  const auto [least, most] = std::minmax_element(patch.values.begin(), patch.values.end());
  return {{u, v}, 0, mean + gain * *least, mean + gain * *most};
}

/// The highest local maxima of the correlation over the whole image.
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

/// Cheap test of a combination before its pose is solved. From the printed side and a sufficient distance, a flat
/// target is nearly an affine image of its plan, and corners must be further apart than the width of a patch.
class QuickCheck {
 public:
  QuickCheck(const Target& target, double least_apart_px) : least_apart_px_(least_apart_px) {
    // Plan of the target in the view of an observer facing it, x to the right and y down
    const Eigen::Vector3d any =
        std::abs(target.normal.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    const Eigen::Vector3d right = any.cross(target.normal).normalized(), down = right.cross(-target.normal);
    plan_.resize(static_cast<Eigen::Index>(target.corners.size()), 3);
    for (Eigen::Index i = 0; i < plan_.rows(); ++i) {
      const Eigen::Vector3d at =
          target.corners[static_cast<std::size_t>(i)].position - target.corners[0].position;
      plan_.row(i) << at.dot(right), -at.dot(down), 1;
    }
    // Least squares; four_of() avoids collinear corners
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

/// Mean correlation minus a penalty for different illumination of the corners: the spread of their dark and
/// bright levels relative to the contrast.
double similarity(const std::vector<const ImageCandidate*>& corners) {
  double correlation = 0, contrast = 0;
  double dark[] = {1e9, -1e9}, bright[] = {1e9, -1e9};  // minimum, maximum
  for (const ImageCandidate* corner : corners) {
    correlation += corner->correlation / static_cast<double>(corners.size());
    contrast += (corner->bright - corner->dark) / static_cast<double>(corners.size());
    dark[0] = std::min(dark[0], corner->dark), dark[1] = std::max(dark[1], corner->dark);
    bright[0] = std::min(bright[0], corner->bright), bright[1] = std::max(bright[1], corner->bright);
  }
  return correlation - 0.2 * std::max(dark[1] - dark[0], bright[1] - bright[0]) / contrast;
}

/// Correlation of the image at this pose with the target's picture; 1 without a picture.
double similarity_at_pose(const Target& target, const Camera& camera, const Image& image,
                          const TargetPose& pose) {
  return target.picture ? correlation_with_picture(target, camera, image, pose) : 1;
}

struct Best {
  std::optional<TargetPose> pose;
  std::optional<double> unlike;  ///< highest correlation of the poses rejected by the picture
};

/// The next combination of one candidate per corner; false after the last.
bool next(std::vector<std::size_t>& index, const std::vector<std::vector<ImageCandidate>>& places) {
  for (std::size_t c = 0; c < places.size(); ++c) {
    if (++index[c] < places[c].size()) return true;
    index[c] = 0;
  }
  return false;
}

/// Tests all combinations of one candidate per corner.
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
      // Half a pixel of reprojection error weighs as much as 0.1 of correlation
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

/// `least`: the required correlation.
std::string not_like(const Target& target, double similarity, double least) {
  std::ostringstream why;
  why << "what stands as the corners of target " << target.name;
  if (similarity <= -1) {
    why << " has less than half of its picture in the image, or is of one gray there";
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

/// Four distant, non-collinear corners: the time of the search is exponential in their number, and four
/// suffice for a pose.
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

/// Projection of all corners; nothing when one of them is out of view.
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

/// Refines corners at the intersection of the image's own edges. The correlation with a patch from a file
/// peaks beside the corner, with a systematic error.
std::vector<Eigen::Vector2d> to_edges(const Image& image, const std::vector<Eigen::Vector2d>& pixels,
                                      int window_px) {
  std::vector<Eigen::Vector2d> refined;
  for (const Eigen::Vector2d& at : pixels) {
    const auto center = center_of_corner(image, at, window_px, rounded_px);
    refined.push_back(center && (*center - at).norm() < max_refinement_px ? *center : at);
  }
  return refined;
}

/// Whether both poses of a flat target fit the pixels and are far apart: from a distance and nearly frontal,
/// only noise distinguishes them. In a single image, of which nothing is known yet, a corner may be off by more than the noise.
bool two_fit(const std::vector<TargetPose>& poses, double sigma_pixel_px) {
  constexpr double least_sigma_px = 0.4;
  if (poses.size() < 2) return false;
  const double worse = std::pow(poses[1].rms_px, 2) - std::pow(poses[0].rms_px, 2);
  return static_cast<double>(poses[0].pixels.size()) * worse <
             std::pow(gate_sigmas * std::max(least_sigma_px, sigma_pixel_px), 2) &&
         (poses[0].position - poses[1].position).norm() > 2 * max_sigma_m;
}

/// The pose from all corners, each at the intersection of its edges. Of the two poses of a flat target the
/// one nearer to `found` is taken.
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
