#include "incognita/record/frame_pictures.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <system_error>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/row_file.hpp"
#include "incognita/record/snapshot/outcome_color.hpp"

namespace incognita {
namespace {

constexpr int min_picture_width_px = 640;  // smaller images are enlarged to fit thin lines
constexpr int band_height_px = 40;         // text band below the image
constexpr int subpixel_bits = 4;

cv::Scalar color(MatchOutcome outcome) {
  const auto [red, green, blue] = outcome_color(outcome);
  return {double(blue), double(green), double(red)};
}

/// A picture in progress: a canvas of `scale` picture pixels per image pixel.
struct Picture {
  cv::Mat canvas;
  double scale = 1;

  /// Fixed-point picture coordinates. The center of image pixel (0,0) maps to the center of its enlarged square.
  cv::Point at(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d p = (((pixel.array() + 0.5) * scale - 0.5) * (1 << subpixel_bits)).matrix();
    return {cvRound(std::clamp(p.x(), -1e6, 1e6)), cvRound(std::clamp(p.y(), -1e6, 1e6))};
  }
  void text(const std::string& words, cv::Point position, double size, const cv::Scalar& ink) {
    cv::putText(canvas, words, position, cv::FONT_HERSHEY_SIMPLEX, size, ink, 1, cv::LINE_AA);
  }
};

Picture picture_of(const Image& image) {
  Picture picture;
  picture.scale = std::max(1, (min_picture_width_px + image.width() - 1) / image.width());
  const cv::Mat gray(image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.row(0)));
  cv::Mat enlarged;
  cv::resize(gray, enlarged, {}, picture.scale, picture.scale, cv::INTER_NEAREST);
  cv::cvtColor(enlarged, enlarged, cv::COLOR_GRAY2BGR);
  cv::copyMakeBorder(enlarged, picture.canvas, 0, band_height_px, 0, 0, cv::BORDER_CONSTANT,
                     cv::Scalar(32, 26, 24));
  return picture;
}

void draw_ellipse(Picture& picture, const SnapshotMatch& match) {
  if (!match.innovation_cov.allFinite() || !match.predicted.allFinite()) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(match.innovation_cov);
  const Eigen::Vector2d axes = 3 * picture.scale * solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  const Eigen::Vector2d major = solver.eigenvectors().col(1);
  const double degrees = std::atan2(major.y(), major.x()) * 180 / std::numbers::pi;
  const auto length = [](double a) { return cvRound(std::clamp(a, 1.0, 1e4) * (1 << subpixel_bits)); };
  cv::ellipse(picture.canvas, picture.at(match.predicted), {length(axes[1]), length(axes[0])}, degrees, 0,
              360, color(match.outcome), match.ray ? 1 : 2, cv::LINE_AA, subpixel_bits);
}

void draw_patch(Picture& picture, const SnapshotMatch& match, int patch_size_px) {
  if (!match.measured || match.outcome == MatchOutcome::not_searched || !match.measured->allFinite()) return;
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * patch_size_px);
  cv::rectangle(picture.canvas, picture.at(*match.measured - half), picture.at(*match.measured + half),
                color(match.outcome), 1, cv::LINE_AA, subpixel_bits);
}

void draw_label(Picture& picture, const SnapshotMatch& match) {
  const Eigen::Vector2d& pixel = match.measured.value_or(match.predicted);
  if (!pixel.allFinite()) return;
  const cv::Point position(picture.at(pixel).x / (1 << subpixel_bits) + 6,
                           picture.at(pixel).y / (1 << subpixel_bits) - 6);
  const std::string words = fmt::format("{}{}", match.anchor ? "A" : "", match.id);
  picture.text(words, position + cv::Point(1, 1), 0.4, {0, 0, 0});  // a shadow for readability on white
  picture.text(words, position, 0.4, color(match.outcome));
}

std::string action_in_words(const Snapshot& snapshot) {
  if (snapshot.bodies.empty()) return "";
  const SnapshotDecision& decision = snapshot.bodies.front().decision;
  const std::string action = chosen_action(decision);
  if (action.empty()) return "";
  const auto i = static_cast<std::size_t>(decision.chosen);
  return "action: " + action +
         (i < decision.scores.size() ? fmt::format(" (score {:.2f})", decision.scores[i]) : "");
}

void draw_band(Picture& picture, const Snapshot& snapshot) {
  const TrackingStatus& status = snapshot.status;
  const int top = picture.canvas.rows - band_height_px;
  const cv::Scalar ink(235, 235, 235);
  const std::string reason = status.reason.empty() ? "" : ": " + status.reason;
  picture.text(fmt::format("{:8.3f} s  {}{}", snapshot.tick.t, name(status.state), reason), {8, top + 16},
               0.42, ink);
  picture.text(
      fmt::format("{} of {} matched   {}", snapshot.matched, snapshot.predicted, action_in_words(snapshot)),
      {8, top + 33}, 0.42, ink);
}

}  // namespace

FramePictures::FramePictures(const std::filesystem::path& run_directory, int patch_size_px)
    : folder_(run_directory / "frames"), patch_size_px_(patch_size_px) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw RecordError(write_failure(folder_, error.value()));
}

void FramePictures::publish(const Snapshot& snapshot) {
  if (!snapshot.image || snapshot.image->empty()) return;
  Picture picture = picture_of(*snapshot.image);
  const std::vector<SnapshotMatch> matches = matches_of_first_camera(snapshot);
  for (const SnapshotMatch& match : matches) draw_ellipse(picture, match);
  for (const SnapshotMatch& match : matches) draw_patch(picture, match, patch_size_px_);
  for (const SnapshotMatch& match : matches) draw_label(picture, match);
  draw_band(picture, snapshot);
  std::vector<unsigned char> png;
  cv::imencode(".png", picture.canvas, png);
  write_whole_file(folder_ / fmt::format("frame-{:06}.png", snapshot.tick.frame),
                   {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace incognita
