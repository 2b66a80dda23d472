#include "incognita/app/view/page_camera.hpp"

#include <stdexcept>

#include "incognita/io/formats/image_file.hpp"

namespace incognita {
namespace {

constexpr int most_px = 8192;  // per side: a small file may be a huge image

void check_size(const std::string& bytes) {
  const auto header = image_header(bytes);
  if (!header) throw std::runtime_error("an image of the page's camera is no JPEG");
  if (header->width > most_px || header->height > most_px)
    throw std::runtime_error("an image of the page's camera has " + std::to_string(header->width) + "x" +
                             std::to_string(header->height) + " px");
}

}  // namespace

std::optional<LiveReading> PageCamera::read(double wait_s) {
  const auto received = camera_->receive(wait_s);
  if (!received) return std::nullopt;
  try {
    check_size(received->jpeg);
    return LiveReading{received->t, std::make_shared<const Image>(
                                        decode_image(received->jpeg, "an image of the page's camera"))};
  } catch (const std::runtime_error& error) {
    if (++damaged_ == 1) events_.push_back(std::string(error.what()) + "; such images are skipped");
    return std::nullopt;
  }
}

std::vector<std::string> PageCamera::take_events() {
  std::vector<std::string> events = std::exchange(events_, {});
  for (std::string& event : camera_->take_events()) events.push_back(std::move(event));
  return events;
}

std::vector<std::pair<std::string, std::int64_t>> PageCamera::counts() const {
  return {{"camera_dropped_images", camera_->dropped()}, {"camera_damaged_images", damaged_}};
}

}  // namespace incognita
