#include "incognita/slam/target_pose.hpp"

#include <algorithm>
#include <cmath>

namespace incognita {
namespace {

constexpr double min_correlation = 0.7;  // of a corner's patch: seen from another distance it is never quite alike
constexpr int max_places = 5;            // per corner; all combinations of places are tried
constexpr double max_rms_px = 1.5;       // of a right combination

struct Place {
  Eigen::Vector2d pixel;
  double correlation;
};

/// The best few local maxima of correlation over the whole image.
std::vector<Place> best_places(const SummedImage& image, const PatchTemplate& patch, CorrelationSheet& sheet) {
  const int width = image.image().width(), height = image.image().height();
  sheet.start(image, patch, 0, width - 1, 0, height - 1);
  std::vector<Place> places;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const double here = sheet.at(u, v);
      if (here < min_correlation) continue;
      bool peak = true;
      for (int dv = -1; dv <= 1 && peak; ++dv)
        for (int du = -1; du <= 1 && peak; ++du) peak = (du == 0 && dv == 0) || sheet.at(u + du, v + dv) <= here;
      if (peak) places.push_back({sheet.refine(u, v), here});
    }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.correlation > b.correlation; });
  if (places.size() > max_places) places.resize(max_places);
  return places;
}

std::optional<PatchTemplate> as_template(const Image& patch, int size) {
  const double middle = patch.width() / 2;
  return warp({patch, {middle, middle}}, Eigen::Matrix2d::Identity(), std::min(size, patch.width()));
}

/// Tries every combination of places, one per corner.
void try_combinations(const Target& target, const Camera& camera, const std::vector<std::vector<Place>>& places,
                      double sigma_pixel_px, std::optional<TargetPose>& best) {
  std::vector<Eigen::Vector3d> points;
  for (const auto& corner : target.corners) points.push_back(corner.position);
  std::vector<std::size_t> index(places.size(), 0);
  double best_score = -1e9;
  for (bool more = true; more;) {
    std::vector<Eigen::Vector2d> pixels;
    double correlation = 0;
    bool apart = true;
    for (std::size_t c = 0; c < places.size(); ++c) {
      const Place& place = places[c][index[c]];
      for (const auto& other : pixels) apart = apart && (other - place.pixel).norm() > 6;
      pixels.push_back(place.pixel);
      correlation += place.correlation / places.size();
    }
    if (apart) {
      const auto poses = solve_pose(points, pixels, camera, sigma_pixel_px);
      const bool good = !poses.empty() && poses[0].rms_px < max_rms_px &&
                        target.normal.dot(poses[0].position - points[0]) > 0;
      // Half a pixel of misfit weighs as much as 0.1 of correlation
      if (good && correlation - 0.2 * poses[0].rms_px > best_score) {
        best_score = correlation - 0.2 * poses[0].rms_px;
        best = poses[0];
      }
    }
    more = false;
    for (std::size_t c = 0; c < places.size() && !more; ++c) {
      more = ++index[c] < places[c].size();
      if (!more) index[c] = 0;
    }
  }
}

}  // namespace

TargetSearch find_target(const Target& target, const Camera& camera, const SummedImage& image,
                         double sigma_pixel_px, int patch_size_px) {
  std::vector<std::vector<Place>> places;
  CorrelationSheet sheet;
  for (std::size_t c = 0; c < target.corners.size(); ++c) {
    const auto patch = as_template(target.corners[c].patch, patch_size_px);
    if (!patch) return {std::nullopt, "corner " + std::to_string(c) + " of target " + target.name + " has no contrast"};
    places.push_back(best_places(image, *patch, sheet));
    if (places.back().empty())
      return {std::nullopt, "corner " + std::to_string(c) + " of target " + target.name +
                                " is nowhere in the image (correlation below 0.7)"};
  }
  TargetSearch result;
  try_combinations(target, camera, places, sigma_pixel_px, result.pose);
  if (!result.pose) result.reason = "places like the corners of target " + target.name + " fit no camera pose";
  return result;
}

}  // namespace incognita
