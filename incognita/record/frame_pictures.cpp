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
#include "incognita/record/snapshot/look_colour.hpp"

namespace incognita {
namespace {

constexpr int min_picture_width_px = 640;  // smaller images are enlarged: thin lines need room
constexpr int band_height_px = 40;         // for the text, below the image
constexpr int subpixel_bits = 4;

cv::Scalar colour(LookOutcome outcome) {
  const auto [red, green, blue] = look_colour(outcome);
  return {double(blue), double(green), double(red)};
}

/// A picture in progress: a canvas of `scale` picture pixels per image pixel.
struct Picture {
  cv::Mat canvas;
  double scale = 1;

  /// In fractions of a picture pixel. The centre of image pixel (0,0) is the centre of the square it becomes.
  cv::Point at(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d p = (((pixel.array() + 0.5) * scale - 0.5) * (1 << subpixel_bits)).matrix();
    return {cvRound(std::clamp(p.x(), -1e6, 1e6)), cvRound(std::clamp(p.y(), -1e6, 1e6))};
  }
  void text(const std::string& words, cv::Point place, double size, const cv::Scalar& ink) {
    cv::putText(canvas, words, place, cv::FONT_HERSHEY_SIMPLEX, size, ink, 1, cv::LINE_AA);
  }
};

Picture picture_of(const Image& image) {
  Picture picture;
  picture.scale = std::max(1, (min_picture_width_px + image.width() - 1) / image.width());
  const cv::Mat grey(image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.row(0)));
  cv::Mat enlarged;
  cv::resize(grey, enlarged, {}, picture.scale, picture.scale, cv::INTER_NEAREST);
  cv::cvtColor(enlarged, enlarged, cv::COLOR_GRAY2BGR);
  cv::copyMakeBorder(enlarged, picture.canvas, 0, band_height_px, 0, 0, cv::BORDER_CONSTANT,
                     cv::Scalar(32, 26, 24));
  return picture;
}

void draw_ellipse(Picture& picture, const SnapshotLook& look) {
  if (!look.innovation_cov.allFinite() || !look.predicted.allFinite()) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(look.innovation_cov);
  const Eigen::Vector2d axes = 3 * picture.scale * solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  const Eigen::Vector2d major = solver.eigenvectors().col(1);
  const double degrees = std::atan2(major.y(), major.x()) * 180 / std::numbers::pi;
  const auto length = [](double a) { return cvRound(std::clamp(a, 1.0, 1e4) * (1 << subpixel_bits)); };
  cv::ellipse(picture.canvas, picture.at(look.predicted), {length(axes[1]), length(axes[0])}, degrees, 0, 360,
              colour(look.outcome), look.line ? 1 : 2, cv::LINE_AA, subpixel_bits);
}

void draw_patch(Picture& picture, const SnapshotLook& look, int patch_size_px) {
  if (!look.measured || look.outcome == LookOutcome::not_tried || !look.measured->allFinite()) return;
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * patch_size_px);
  cv::rectangle(picture.canvas, picture.at(*look.measured - half), picture.at(*look.measured + half),
                colour(look.outcome), 1, cv::LINE_AA, subpixel_bits);
}

void draw_label(Picture& picture, const SnapshotLook& look) {
  const Eigen::Vector2d& pixel = look.measured.value_or(look.predicted);
  if (!pixel.allFinite()) return;
  const cv::Point place(picture.at(pixel).x / (1 << subpixel_bits) + 6,
                        picture.at(pixel).y / (1 << subpixel_bits) - 6);
  const std::string words = fmt::format("{}{}", look.anchor ? "A" : "", look.id);
  picture.text(words, place + cv::Point(1, 1), 0.4, {0, 0, 0});  // a shadow, to be read on white walls too
  picture.text(words, place, 0.4, colour(look.outcome));
}

std::string chosen_action(const SnapshotAdvice& advice) {
  if (advice.chosen < 0 || static_cast<std::size_t>(advice.chosen) >= advice.actions.size()) return "";
  const auto i = static_cast<std::size_t>(advice.chosen);
  const std::string score = i < advice.scores.size() ? fmt::format(" ({:.2f} nats)", advice.scores[i]) : "";
  return "action: " + advice.actions[i] + score;
}

void draw_band(Picture& picture, const Snapshot& snapshot) {
  const TrackingStatus& status = snapshot.status;
  const int top = picture.canvas.rows - band_height_px;
  const cv::Scalar ink(235, 235, 235);
  const std::string reason = status.reason.empty() ? "" : ": " + status.reason;
  picture.text(fmt::format("{:8.3f} s  {}{}", snapshot.tick.t, name(status.state), reason), {8, top + 16},
               0.42, ink);
  picture.text(fmt::format("{} of {} matched   {}", snapshot.matched, snapshot.predicted,
                           chosen_action(snapshot.advice)),
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
  for (const SnapshotLook& look : snapshot.looks) draw_ellipse(picture, look);
  for (const SnapshotLook& look : snapshot.looks) draw_patch(picture, look, patch_size_px_);
  for (const SnapshotLook& look : snapshot.looks) draw_label(picture, look);
  draw_band(picture, snapshot);
  std::vector<unsigned char> png;
  cv::imencode(".png", picture.canvas, png);
  write_whole_file(folder_ / fmt::format("frame-{:06}.png", snapshot.tick.frame),
                   {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace incognita
