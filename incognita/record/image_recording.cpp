#include "incognita/record/image_recording.hpp"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>
#include <system_error>
#include <vector>

#include "incognita/messages/errors.hpp"
#include "incognita/record/snapshot/pose_rows.hpp"

namespace incognita {
namespace {

std::filesystem::path created(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder / "rgb", error);
  if (error) throw RecordError(write_failure(folder / "rgb", error.value()));
  return folder;
}

std::vector<unsigned char> png_of(const Image& image) {
  const cv::Mat gray(image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.row(0)));
  std::vector<unsigned char> png;
  cv::imencode(".png", gray, png);
  return png;
}

}  // namespace

ImageRecording::ImageRecording(const std::filesystem::path& run_directory)
    : folder_(created(run_directory / "recording")),
      times_(folder_ / "rgb.txt", "# timestamp filename"),
      truth_(folder_ / "groundtruth.txt", "# timestamp tx ty tz qx qy qz qw") {}

void ImageRecording::publish(const Snapshot& snapshot) {
  if (!snapshot.image || snapshot.image->empty()) return;
  const std::string name = fmt::format("rgb/frame-{:06}.png", snapshot.tick.frame);
  const std::vector<unsigned char> png = png_of(*snapshot.image);
  write_whole_file(folder_ / name, {reinterpret_cast<const char*>(png.data()), png.size()});
  times_.append(fmt::format("{:.9f} {}", snapshot.tick.t, name), snapshot.tick.t);
  if (snapshot.bodies.empty()) return;
  const auto& truth = snapshot.bodies.front().truth;
  if (truth && truth->oriented) truth_.append(tum_row(*truth), snapshot.tick.t);
}

}  // namespace incognita
