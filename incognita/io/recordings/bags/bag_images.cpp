#include "incognita/io/recordings/bags/bag_images.hpp"

#include <fmt/format.h>

#include <array>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "incognita/io/formats/gray_image.hpp"
#include "incognita/io/formats/image_file.hpp"
#include "incognita/io/recordings/bags/bag_topics.hpp"

namespace incognita {
namespace {

constexpr std::uint32_t most_side_px = 16384;  // as camera.width_px

/// How an encoding becomes gray.
struct PixelFormat {
  std::string_view encoding;
  int type;     ///< of OpenCV
  int to_gray;  ///< of cv::cvtColor; or one of the two below
};
constexpr int is_gray = -1;
constexpr int has_luma_first = -2, has_luma_second = -3;  ///< of two bytes per pixel

/// ROS names a Bayer pattern by the first two pixels of the first row and the first two of the second, OpenCV by the second row
/// and column.
constexpr auto pixel_formats = std::to_array<PixelFormat>({{"mono8", CV_8UC1, is_gray},
                                                           {"8UC1", CV_8UC1, is_gray},
                                                           {"mono16", CV_16UC1, is_gray},
                                                           {"rgb8", CV_8UC3, cv::COLOR_RGB2GRAY},
                                                           {"bgr8", CV_8UC3, cv::COLOR_BGR2GRAY},
                                                           {"8UC3", CV_8UC3, cv::COLOR_BGR2GRAY},
                                                           {"rgba8", CV_8UC4, cv::COLOR_RGBA2GRAY},
                                                           {"bgra8", CV_8UC4, cv::COLOR_BGRA2GRAY},
                                                           {"8UC4", CV_8UC4, cv::COLOR_BGRA2GRAY},
                                                           {"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2GRAY},
                                                           {"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2GRAY},
                                                           {"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2GRAY},
                                                           {"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2GRAY},
                                                           {"yuv422", CV_8UC2, has_luma_second},
                                                           {"uyvy", CV_8UC2, has_luma_second},
                                                           {"yuv422_yuy2", CV_8UC2, has_luma_first},
                                                           {"yuyv", CV_8UC2, has_luma_first}});

const PixelFormat& format_of(const std::string& encoding) {
  for (const PixelFormat& format : pixel_formats)
    if (format.encoding == encoding) return format;
  throw std::runtime_error(fmt::format(
      "an image of encoding `{:.40}` is not read; republish it as mono8, rgb8, bgr8 or another 8-bit encoding",
      encoding));
}

void check_size(const bags::ImageMessage& m, std::size_t pixel_bytes) {
  if (m.width < 1 || m.height < 1 || m.width > most_side_px || m.height > most_side_px)
    throw std::runtime_error(fmt::format("an image of {}x{} px", m.width, m.height));
  const std::uint64_t row = m.width * pixel_bytes, needed = std::uint64_t{m.step} * (m.height - 1) + row;
  if (m.step < row || m.data.size() < needed)
    throw std::runtime_error(fmt::format("an image of {}x{} px ({}) has rows of {} bytes and {} bytes in all",
                                         m.width, m.height, m.encoding, m.step, m.data.size()));
}

/// The upper byte of each pixel.
cv::Mat upper_bytes(const bags::ImageMessage& m) {
  cv::Mat pairs(static_cast<int>(m.height), static_cast<int>(m.width), CV_8UC2,
                const_cast<char*>(m.data.data()), m.step);
  cv::Mat upper;
  cv::extractChannel(pairs, upper, m.is_big_endian ? 0 : 1);
  return upper;
}

class BagImages final : public IndexedImages {
 public:
  BagImages(std::shared_ptr<const bags::Bag> bag, const bags::BagTopic& topic,
            std::vector<bags::BagMessage> messages)
      : bag_(std::move(bag)),
        serialization_(serialization_of(topic)),
        is_compressed_(is_compressed_image(topic)),
        messages_(std::move(messages)) {}

  std::shared_ptr<const Image> read(std::size_t frame) override {
    const bags::BagMessage& message = messages_.at(frame);
    const std::string content = bag_->content(message);
    try {
      bags::MessageCursor cursor(content, serialization_);
      return std::make_shared<const Image>(is_compressed_ ? gray_image(bags::read_compressed_image(cursor))
                                                          : gray_image(bags::read_image(cursor)));
    } catch (const std::exception& error) {  // also cv::Exception
      throw std::runtime_error(fmt::format("{}: {}", bag_->where(message), error.what()));
    }
  }

 private:
  std::shared_ptr<const bags::Bag> bag_;
  bags::Serialization serialization_;
  bool is_compressed_;
  std::vector<bags::BagMessage> messages_;
};

}  // namespace

Image gray_image(const bags::ImageMessage& m) {
  const PixelFormat& format = format_of(m.encoding);
  check_size(m, static_cast<std::size_t>(CV_ELEM_SIZE(format.type)));
  if (format.type == CV_16UC1) return gray_image(upper_bytes(m));
  const cv::Mat pixels(static_cast<int>(m.height), static_cast<int>(m.width), format.type,
                       const_cast<char*>(m.data.data()), m.step);
  cv::Mat gray;
  if (format.to_gray == is_gray)
    gray = pixels;
  else if (format.to_gray == has_luma_first || format.to_gray == has_luma_second)
    cv::extractChannel(pixels, gray, format.to_gray == has_luma_first ? 0 : 1);
  else
    cv::cvtColor(pixels, gray, format.to_gray);
  return gray_image(gray);
}

Image gray_image(const bags::CompressedImageMessage& m) {
  const auto header = image_header(m.data);
  if (header &&
      (header->width > static_cast<int>(most_side_px) || header->height > static_cast<int>(most_side_px)))
    throw std::runtime_error(fmt::format("an image of {}x{} px", header->width, header->height));
  return decode_image(m.data, fmt::format("an image of format `{:.60}`", m.format));
}

std::shared_ptr<IndexedImages> bag_images(std::shared_ptr<const bags::Bag> bag, const bags::BagTopic& topic,
                                          std::vector<bags::BagMessage> messages) {
  return std::make_shared<BagImages>(std::move(bag), topic, std::move(messages));
}

}  // namespace incognita
