#include "incognita/vision/calibration/calibrate_camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "incognita/math/median.hpp"

namespace incognita {
namespace {

constexpr double outlier_ratio = 3,
                 outlier_px = 0.5;         // a view is an outlier above both: 3 times the median, and 0.5 px
constexpr double max_rms_px = 2;           // of a fit at 640 px of width; grows with it
constexpr double max_focal_sigma = 0.01;   // of the focal length
constexpr double max_center_sigma = 0.01;  // of the size of the image
constexpr double min_coverage = 0.4, good_coverage = 0.75;
constexpr double significant_sigmas = 3;  // beyond which k3 is kept
constexpr double better_rms = 0.9;        // of the pinhole's: then the fisheye is taken
constexpr double good_tilt_rad = 0.35;    // 20 degrees

struct Corners {
  std::vector<std::size_t> which;  ///< views in use
  std::vector<std::vector<Eigen::Vector2d>> corners;
};

Corners in_use(const CalibrationViews& views) {
  Corners used;
  for (std::size_t i = 0; i < views.views().size(); ++i) {
    const CalibrationView& view = views.views()[i];
    if (!view.refusal.empty()) continue;
    used.which.push_back(i);
    used.corners.push_back(view.corners);
  }
  return used;
}

LensFit fit(const CalibrationViews& views, const Corners& used, LensModel model, bool third_radial) {
  return fit_lens(used.corners, views.board(), views.width_px(), views.height_px(), {model, third_radial});
}

/// A pinhole without k3, unless the views determine k3 and it differs from 0.
LensFit fit_pinhole(const CalibrationViews& views, const Corners& used, bool allow_third_radial) {
  LensFit two = fit(views, used, LensModel::pinhole, false);
  if (!allow_third_radial) return two;
  const LensFit three = fit(views, used, LensModel::pinhole, true);
  if (!three.failure.empty()) return two;
  const FittedValue k3 = three.distortion.back();
  return !two.failure.empty() || std::abs(k3.value) > significant_sigmas * k3.sigma ? three : two;
}

LensFit fit_chosen(const CalibrationViews& views, const Corners& used, const CalibrationSettings& settings,
                   std::vector<std::string>& notes) {
  using Model = CalibrationSettings::Model;
  if (settings.model == Model::fisheye) return fit(views, used, LensModel::fisheye, false);
  LensFit pinhole = fit_pinhole(views, used, settings.allow_third_radial);
  if (settings.model == Model::pinhole) return pinhole;
  LensFit fisheye = fit(views, used, LensModel::fisheye, false);
  if (!fisheye.failure.empty()) {
    notes.push_back("model pinhole: as a fisheye, " + fisheye.failure);
    return pinhole;
  }
  if (!pinhole.failure.empty()) {
    notes.push_back("model fisheye: as a pinhole, " + pinhole.failure);
    return fisheye;
  }
  const bool take_fisheye = fisheye.rms_px < better_rms * pinhole.rms_px;
  notes.push_back(fmt::format("model {}: rms {:.3f} px as a pinhole, {:.3f} px as a fisheye",
                              take_fisheye ? "fisheye" : "pinhole", pinhole.rms_px, fisheye.rms_px));
  return take_fisheye ? fisheye : pinhole;
}

/// Refuses views whose corners are off by much more than those of the others. Returns whether there was one.
bool refuse_outliers(CalibrationViews& views, const Corners& used, const LensFit& lens) {
  std::vector<double> sorted = lens.view_rms_px;
  const double limit_px = std::max(outlier_px, outlier_ratio * median(sorted));
  bool found = false;
  for (std::size_t i = 0; i < used.which.size(); ++i) {
    if (!(lens.view_rms_px[i] > limit_px)) continue;
    views.refuse(
        used.which[i],
        fmt::format(
            "outlier: its corners are off by {:.2f} px rms, and the limit is {:.2f} (3 times the median, or 0.5)",
            lens.view_rms_px[i], limit_px));
    found = true;
  }
  return found;
}

std::string why_too_few(const CalibrationViews& views) {
  const std::size_t used = views.used(), all = views.views().size();
  if (used >= least_views) return "";
  if (used == 0) return fmt::format("no view of the {} board can be used", views.board().text());
  if (all == 1)
    return fmt::format(
        "one view does not determine a focal length: it trades against the distance of the board; take {} views or more, "
        "10 to 20 are good, each tilted differently",
        least_views);
  return fmt::format(
      "{} of {} images can be used, and {} are needed; 10 to 20 are good, each tilted differently", used, all,
      least_views);
}

std::string why_undetermined(const LensFit& lens, int width_px, int height_px) {
  const char* remedy = "add views in which the board is tilted by 20 to 45 degrees about different axes";
  for (const auto& [name, f] : {std::pair{"fu", lens.fu}, {"fv", lens.fv}})
    if (!(f.value > 0 && f.sigma < max_focal_sigma * f.value))
      return fmt::format(
          "the views do not determine the focal length: {} = {:.1f} px with a standard deviation of {:.1f} px (limit: 1 %); {}",
          name, f.value, f.sigma, remedy);
  for (const auto& [name, center, size] : {std::tuple{"u0", lens.u0, width_px}, {"v0", lens.v0, height_px}}) {
    if (!(center.sigma < max_center_sigma * size))
      return fmt::format(
          "the views do not determine the principal point: {} = {:.1f} px with a standard deviation of {:.1f} px (limit: {:.1f} px, "
          "1 % of the image); {}",
          name, center.value, center.sigma, max_center_sigma * size, remedy);
    if (!(center.value > 0 && center.value < size))
      return fmt::format(
          "the principal point is outside of the image ({} = {:.1f} px of {}): the views contradict the model, or the images are cropped",
          name, center.value, size);
  }
  return "";
}

std::string why_refused(const CalibrationViews& views, const LensFit& lens) {
  const double limit_px = max_rms_px * std::max(1.0, views.width_px() / 640.0);
  if (!(lens.rms_px < limit_px))
    return fmt::format(
        "the corners are off by {:.2f} px rms (limit: {:.1f}): the board is not flat, or the lens is of another model",
        lens.rms_px, limit_px);
  const Coverage coverage = views.coverage();
  if (coverage.share() < min_coverage)
    return fmt::format(
        "the boards cover {:.0f} % of the image, and must cover {:.0f} %; nothing is known of the distortion elsewhere. Move the board to: {}",
        100 * coverage.share(), 100 * min_coverage, coverage.gaps());
  return why_undetermined(lens, views.width_px(), views.height_px());
}

void add_notes(const CalibrationViews& views, const LensFit& lens, std::vector<std::string>& notes) {
  const Coverage coverage = views.coverage();
  if (coverage.share() < good_coverage && !coverage.gaps().empty())
    notes.push_back(
        fmt::format("the boards cover {:.0f} % of the image; the distortion is extrapolated in: {}",
                    100 * coverage.share(), coverage.gaps()));
  double most_rad = 0;
  for (const BoardPose& board : lens.boards) most_rad = std::max(most_rad, board.tilt_rad);
  if (most_rad < good_tilt_rad)
    notes.push_back(fmt::format(
        "the board is tilted by {:.0f} degrees at most; 20 to 45 degrees determine the focal length better",
        most_rad * 57.29577951308232));
}

}  // namespace

CameraCalibration calibrate_camera(CalibrationViews& views, const CalibrationSettings& settings) {
  CameraCalibration result;
  result.view_rms_px.assign(views.views().size(), std::numeric_limits<double>::quiet_NaN());
  result.boards.assign(views.views().size(), std::nullopt);
  views.keep_most_different(settings.most_views);
  constexpr int most_rounds = 5;
  for (int round = 0; round < most_rounds; ++round) {
    result.refusal = why_too_few(views);
    if (!result.refusal.empty()) return result;
    const Corners used = in_use(views);
    std::vector<std::string> notes;
    const LensFit lens = fit_chosen(views, used, settings, notes);
    result.notes = notes;
    result.refusal = lens.failure;
    if (!lens.failure.empty()) return result;
    result.lens = lens;
    if (round + 1 < most_rounds && refuse_outliers(views, used, lens)) continue;
    for (std::size_t i = 0; i < used.which.size(); ++i) {
      result.view_rms_px[used.which[i]] = lens.view_rms_px[i];
      result.boards[used.which[i]] = lens.boards[i];
    }
    break;
  }
  result.refusal = why_refused(views, *result.lens);
  add_notes(views, *result.lens, result.notes);
  return result;
}

}  // namespace incognita
