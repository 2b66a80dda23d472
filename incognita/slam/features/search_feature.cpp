#include "incognita/slam/features/search_feature.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "incognita/vision/align_patch.hpp"

namespace incognita {
namespace {

constexpr double small_px = 10;  // half axis, in pixels of a level, of a search that is cheap
constexpr double refine_px = 3;  // half axis of the search at a level, around the result of the coarser one
constexpr double guided_share = 0.02;  // of the image width: how far the alignment of whole images may be off

std::optional<PatchTemplate> patch_at_level(const PatchView& view, const Eigen::Matrix2d& texture_from_view,
                                            int size, int level) {
  if (level == 0) return warp(view.texture, texture_from_view, size);
  if (level > static_cast<int>(view.coarse.size())) return std::nullopt;
  return warp(view.coarse[static_cast<std::size_t>(level - 1)], texture_from_view, size);
}

/// A circle around a pixel.
Ellipse around(const Eigen::Vector2d& pixel, double radius_px) {
  return {pixel, radius_px * radius_px * Eigen::Matrix2d::Identity(), 1};
}

Ellipse ellipse_at_level(const Ellipse& ellipse, int level) {
  return {at_level(ellipse.center, level), ellipse.covariance / static_cast<double>(1 << (2 * level)),
          ellipse.gate_sigmas};
}

Ellipse gate_of(const FeatureMatch& match, const SearchSettings& settings) {
  return {match.predicted, match.innovation_cov, settings.gate_sigmas};
}

double half_axis(const Ellipse& ellipse, double limit_px) {
  return std::min(limit_px,
                  ellipse.gate_sigmas * std::sqrt(std::max(0.0, ellipse.covariance.diagonal().maxCoeff())));
}

bool is_inside(const Eigen::Vector2d& pixel, const Ellipse& ellipse) {
  const Eigen::Vector2d off = pixel - ellipse.center;
  return off.dot(ellipse.covariance.inverse() * off) <= ellipse.gate_sigmas * ellipse.gate_sigmas;
}

/// Whether one of the four pixels around a position is inside: alignment may move a match by less than a pixel out of the ellipse.
bool is_beside(const Eigen::Vector2d& position, const Ellipse& ellipse) {
  const Eigen::Vector2d first = position.array().floor(), last = position.array().ceil();
  return is_inside(first, ellipse) || is_inside(last, ellipse) || is_inside({first.x(), last.y()}, ellipse) ||
         is_inside({last.x(), first.y()}, ellipse);
}

/// The finest level at which the ellipse is small.
int level_of(double half_axis_px, int levels) {
  int level = 0;
  while (level + 1 < levels && half_axis_px > small_px * (1 << level)) ++level;
  return level;
}

class Searcher {
 public:
  Searcher(CorrelationSheet& sheet, const ImagePyramid& pyramid, const PatchView& view,
           const FeatureMatch& match, const SearchSettings& settings)
      : sheet_(sheet), pyramid_(pyramid), view_(view), match_(match), settings_(settings) {}

  /// `ellipse` in pixels of level 0, the result in those of `level`.
  std::optional<Found> search_level(const Ellipse& ellipse, int level) {
    const auto patch = patch_at_level(view_, match_.texture_from_view, settings_.patch_size_px, level);
    if (!patch) return std::nullopt;
    return search(sheet_, pyramid_.summed(level), *patch,
                  with_nearest_pixels(ellipse_at_level(ellipse, level)),
                  settings_.max_half_axis_px / (1 << level));
  }

  /// From `level` down to 0; nothing when the refined position lies outside the ellipse.
  std::optional<Found> search_down(const Ellipse& ellipse, int level) {
    std::optional<Found> found = search_level(ellipse, level);
    if (level == 0) return aligned(found, ellipse);
    while (found && level > 0) {
      const Eigen::Vector2d pixel = found->pixel * static_cast<double>(1 << level);
      --level;
      found = search_level(around(pixel, refine_px * (1 << level)), level);
    }
    if (!found || !is_inside(found->pixel.array().round().matrix(), with_nearest_pixels(ellipse)))
      return std::nullopt;
    return aligned(found, ellipse);
  }

  /// A match at level 0 at the position where the patch fits best, a fraction of a pixel from the peak of the correlation. As it
  /// is if that cannot be found, or lies outside the ellipse in which the match was searched.
  std::optional<Found> aligned(std::optional<Found> found, const Ellipse& ellipse) const {
    if (!found || found->correlation < settings_.min_correlation) return found;
    const auto at = align_patch(pyramid_.image(), view_.texture, match_.texture_from_view,
                                settings_.patch_size_px, found->pixel);
    if (at && is_beside(*at, with_nearest_pixels(ellipse))) found->pixel = *at;
    return found;
  }

 private:
  CorrelationSheet& sheet_;
  const ImagePyramid& pyramid_;
  const PatchView& view_;
  const FeatureMatch& match_;
  const SearchSettings& settings_;
};

}  // namespace

std::optional<Eigen::Vector2d> guided_pixel(const FeatureMatch& match, const TrackedCamera& camera) {
  if (!camera.guide) return std::nullopt;
  const auto ray = camera.camera.unproject(match.predicted);
  if (!ray) return std::nullopt;
  const auto projected = camera.camera.project(*camera.guide * *ray);
  if (!projected) return std::nullopt;
  return projected->pixel;
}

std::optional<Found> search_feature(CorrelationSheet& sheet, const ImagePyramid& pyramid,
                                    const PatchView& view, const FeatureMatch& match,
                                    const TrackedCamera& camera) {
  const SearchSettings& settings = camera.settings.search;
  Searcher searcher(sheet, pyramid, view, match, settings);
  const Ellipse whole = gate_of(match, settings);
  const double guided_px = guided_share * camera.camera.width();
  const double size_px = half_axis(whole, settings.max_half_axis_px);
  if (const auto guided = guided_pixel(match, camera); guided && size_px > guided_px) {
    const Ellipse near_guided = around(*guided, guided_px);
    const auto found = searcher.search_level(near_guided, 0);
    if (found && found->correlation >= settings.min_correlation) return searcher.aligned(found, near_guided);
  }
  // Patches at the border of their image have no coarse levels
  const int levels = std::min(pyramid.levels(), 1 + static_cast<int>(view.coarse.size()));
  return searcher.search_down(whole, level_of(size_px, levels));
}

std::optional<Found> search_feature_at_level(CorrelationSheet& sheet, const ImagePyramid& pyramid,
                                             const PatchView& view, const FeatureMatch& match,
                                             const TrackedCamera& camera, int level) {
  const SearchSettings& settings = camera.settings.search;
  Searcher searcher(sheet, pyramid, view, match, settings);
  Ellipse where = gate_of(match, settings);
  const double guided_px = guided_share * camera.camera.width();
  if (const auto guided = guided_pixel(match, camera);
      guided && half_axis(where, settings.max_half_axis_px) > guided_px)
    where = around(*guided, guided_px);
  auto found = searcher.search_level(where, level);
  if (found) found->pixel *= static_cast<double>(1 << level);
  return found;
}

}  // namespace incognita
