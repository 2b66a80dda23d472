#include "incognita/vision/calibration/live_calibration.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace incognita {
namespace {

constexpr std::size_t images_for_guess = 3;
constexpr std::size_t often_fitted = 10, views_between_fits = 5;
/// Mean speed of the corners, as a part of the width of the image per second. A board that moves faster is sheared by a rolling
/// shutter (30 ms from the first row to the last: 0.15 % of the width), even where it looks sharp.
constexpr double most_speed_per_s = 0.05;
constexpr double most_gap_s = 1;  // between two images whose corners are compared

}  // namespace

LiveCalibration::LiveCalibration(const LiveCalibrationSettings& settings) : settings_(settings) { restart(); }

void LiveCalibration::restart() {
  taken_.reset();
  fitted_views_.reset();
  last_.reset();
  shown_.clear();
  newest_ = {"show the board", {}};
  calibration_ = {};
  unfitted_ = 0;
  calibration_.refusal = "no view yet";
  if (!settings_.board) return;
  taken_.emplace(*settings_.board);
  fit();
}

void LiveCalibration::add(double t, const Image& image) {
  ++images_;
  newest_ = {};
  if (!taken_) return guess_board(image);
  if (taken_->used() == 0)
    taken_.emplace(taken_->board());  // the first view determines the size, not the first image
  if (is_full()) return;
  CalibrationView view = taken_->add(fmt::format("view {}", taken_->used() + 1), image);
  if (view.refusal.empty()) view.refusal = why_moving(t, view.corners);
  newest_ = {view.refusal, view.corners};
  if (view.corners.empty())
    last_.reset();
  else
    last_ = Seen{t, view.corners};
  if (view.refusal.empty())
    take(view);
  else
    taken_->drop_newest();
}

/// Views that do not determine the camera, all in its middle perhaps, leave place for better ones.
bool LiveCalibration::is_full() {
  const bool determined = calibration_.refusal.empty();
  const std::size_t most = determined ? most_views : 2 * most_views;
  if (taken_->used() < most) return false;
  newest_.refusal =
      determined
          ? fmt::format("{} views are enough: finish, or start again", most)
          : fmt::format("{} views do not determine the camera: start again, and move the board more", most);
  return true;
}

void LiveCalibration::take(const CalibrationView& view) {
  ++unfitted_;
  if (taken_->used() <= often_fitted || unfitted_ == views_between_fits) return fit();
  fitted_views_->add(view);
  calibration_.view_rms_px.push_back(std::numeric_limits<double>::quiet_NaN());
  calibration_.boards.emplace_back();
}

void LiveCalibration::finish() {
  if (unfitted_ > 0) fit();
}

void LiveCalibration::guess_board(const Image& image) {
  const auto board = largest_board(image);
  newest_.refusal =
      board ? fmt::format("a board of {} inner corners: keep it in the image", board->text())
            : "no board: all of it must be in the image, with a white margin, sharp and evenly lit";
  if (!board) return;
  shown_.push_back(*board);
  if (shown_.size() < images_for_guess) return;
  taken_.emplace(*most_frequent(shown_));
  fit();
}

/// The board in the image before tells the speed: without one there, the next image decides.
std::string LiveCalibration::why_moving(double t, const std::vector<Eigen::Vector2d>& corners) const {
  if (!last_ || !(t > last_->t) || t - last_->t > most_gap_s) return "hold the board still";
  const double speed_px_s = mean_distance_px(corners, last_->corners) / (t - last_->t);
  const double most_px_s = most_speed_per_s * taken_->width_px();
  if (speed_px_s <= most_px_s) return "";
  return fmt::format("moves: hold the board still (its corners move by {:.0f} px/s, and may by {:.0f})",
                     speed_px_s, most_px_s);
}

void LiveCalibration::fit() {
  unfitted_ = 0;
  fitted_views_ = taken_;
  calibration_ = calibrate_camera(*fitted_views_, settings_.fit);
}

}  // namespace incognita
