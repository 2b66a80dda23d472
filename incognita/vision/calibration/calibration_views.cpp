#include "incognita/vision/calibration/calibration_views.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace incognita {
namespace {

/// Sharp lenses give edges of 2 to 3.5 px at this width. Larger images resolve the blur of the lens: the limit grows with the
/// square root of the width.
constexpr double max_edge_px = 6, edge_width_at_px = 640;
/// Below, the windows in which corners are refined have too few pixels.
constexpr double min_side_px = 7;
/// Wider edges of small squares blur into each other.
constexpr double max_edge_of_side = 0.5;
/// Mean distance of the corners of two views, as a part of the width of the image, below which the second adds only its noise.
constexpr double min_difference = 0.015;

}  // namespace

std::string CalibrationViews::why_similar(const CalibrationView& view) const {
  const double least_px = min_difference * width_px_;
  for (const CalibrationView& other : views_) {
    if (!other.refusal.empty()) continue;
    const double apart_px = mean_distance_px(view.corners, other.corners);
    if (apart_px < least_px)
      return fmt::format(
          "nearly the same as {}: its corners are {:.1f} px apart in the mean, and must be {:.1f}",
          other.name, apart_px, least_px);
  }
  return "";
}

std::string CalibrationViews::why_refused(const Image& image, CalibrationView& view) const {
  if (image.width() != width_px_ || image.height() != height_px_)
    return fmt::format(
        "is {}x{} px, and the first image is {}x{}: a calibration holds for one size of images",
        image.width(), image.height(), width_px_, height_px_);
  const auto found = find_chessboard(image, board_);
  if (!found)
    return fmt::format(
        "no board with {}x{} inner corners: all of it must be in the image, with a white margin",
        board_.columns, board_.rows);
  view.corners = found->corners;
  view.edge_width_px = found->edge_width_px;
  if (!(found->least_side_px >= min_side_px))
    return fmt::format(
        "too oblique or too far: the shortest side of a square is {:.1f} px, and must be {:.0f}",
        found->least_side_px, min_side_px);
  const double limit_px = std::min(max_edge_px * std::sqrt(std::max(1.0, width_px_ / edge_width_at_px)),
                                   max_edge_of_side * found->least_side_px);
  if (found->edge_width_px > limit_px)
    return fmt::format("blurred: the edges of its squares are {:.1f} px wide, and may be {:.1f}",
                       found->edge_width_px, limit_px);
  return why_similar(view);
}

const CalibrationView& CalibrationViews::add(const std::string& name, const Image& image) {
  if (width_px_ == 0) width_px_ = image.width(), height_px_ = image.height();
  CalibrationView view{name, {}, 0, ""};
  view.refusal = why_refused(image, view);
  views_.push_back(std::move(view));
  return views_.back();
}

void CalibrationViews::add_unreadable(const std::string& name, const std::string& reason) {
  views_.push_back({name, {}, 0, reason});
}

std::size_t CalibrationViews::used() const {
  return static_cast<std::size_t>(
      std::count_if(views_.begin(), views_.end(), [](const auto& view) { return view.refusal.empty(); }));
}

/// Farthest point first: each next view is the one whose nearest chosen view is the farthest.
void CalibrationViews::keep_most_different(std::size_t most) {
  if (used() <= most) return;
  std::vector<double> nearest_px(views_.size(), 0);
  for (std::size_t i = 0; i < views_.size(); ++i)
    if (views_[i].refusal.empty()) nearest_px[i] = std::numeric_limits<double>::infinity();
  std::vector<bool> chosen(views_.size(), false);
  for (std::size_t n = 0; n < most; ++n) {
    const auto next =
        static_cast<std::size_t>(std::max_element(nearest_px.begin(), nearest_px.end()) - nearest_px.begin());
    chosen[next] = true;
    for (std::size_t i = 0; i < views_.size(); ++i)
      if (nearest_px[i] > 0)
        nearest_px[i] =
            i == next ? 0
                      : std::min(nearest_px[i], mean_distance_px(views_[i].corners, views_[next].corners));
  }
  for (std::size_t i = 0; i < views_.size(); ++i)
    if (views_[i].refusal.empty() && !chosen[i])
      refuse(i, fmt::format("not needed: {} views that differ more from each other are used", most));
}

Coverage CalibrationViews::coverage() const {
  Coverage coverage(std::max(1, width_px_), std::max(1, height_px_));
  for (const CalibrationView& view : views_)
    if (view.refusal.empty()) coverage.add(view.corners);
  return coverage;
}

}  // namespace incognita
