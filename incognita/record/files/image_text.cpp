#include "incognita/record/files/image_text.hpp"

#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace incognita {
namespace {

constexpr int jpeg_quality = 65;

}  // namespace

std::string jpeg(const Image& image) {
  const cv::Mat gray(image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.row(0)));
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", gray, bytes, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality});
  return {bytes.begin(), bytes.end()};
}

std::string base64(std::string_view bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
  };
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (const int shift : {18, 12, 6, 0}) text += digits[group >> shift & 63];
  }
  const std::size_t missing = (3 - bytes.size() % 3) % 3;
  text.replace(text.size() - missing, missing, missing, '=');
  return text;
}

}  // namespace incognita
