#include "incognita/io/formats/image_file.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cstring>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <stdexcept>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/gray_image.hpp"

namespace incognita {
namespace {

constexpr std::size_t largest_image_file = std::size_t{256} << 20;
constexpr const char* cut_short = "the file is truncated";

std::uint32_t byte(std::string_view bytes, std::size_t i) { return static_cast<unsigned char>(bytes[i]); }

/// The next decimal number of a netpbm header, after white space and comments.
std::optional<std::uint64_t> netpbm_number(std::string_view bytes, std::size_t& at) {
  while (at < bytes.size() && (std::isspace(static_cast<int>(byte(bytes, at))) || bytes[at] == '#')) {
    if (bytes[at] == '#') {
      while (at < bytes.size() && bytes[at] != '\n') ++at;
    } else {
      ++at;
    }
  }
  std::uint64_t number = 0;
  const std::size_t begin = at;
  for (; at < bytes.size() && std::isdigit(static_cast<int>(byte(bytes, at))); ++at) {
    if (at - begin == 9) return std::nullopt;  // no image has a billion columns
    number = number * 10 + (byte(bytes, at) - '0');
  }
  if (at == begin) return std::nullopt;
  return number;
}

/// Big-endian 16-bit number.
int two_bytes(std::string_view bytes, std::size_t at) {
  return static_cast<int>(byte(bytes, at) << 8 | byte(bytes, at + 1));
}

std::optional<ImageHeader> netpbm_header(std::string_view bytes) {
  std::size_t at = 2;
  const auto width = netpbm_number(bytes, at), height = netpbm_number(bytes, at),
             most = netpbm_number(bytes, at);
  if (!width || !height || !most) return std::nullopt;
  const bool color = bytes[1] == '3' || bytes[1] == '6';
  return ImageHeader{static_cast<int>(*width), static_cast<int>(*height), color ? 3 : 1,
                     *most > 255 ? 16 : 8};
}

/// IHDR is the first chunk. Color types: 0 gray, 2 color, 3 palette; plus 4 with alpha.
std::optional<ImageHeader> png_header(std::string_view bytes) {
  if (bytes.size() < 26 || bytes.substr(12, 4) != "IHDR") return std::nullopt;
  const int type = static_cast<int>(byte(bytes, 25));
  const int width = two_bytes(bytes, 16) << 16 | two_bytes(bytes, 18),
            height = two_bytes(bytes, 20) << 16 | two_bytes(bytes, 22);
  return ImageHeader{width, height, type == 0 || type == 4 ? 1 : 3, static_cast<int>(byte(bytes, 24))};
}

/// Frame segments are SOF0 to SOF15 except DHT, JPG and DAC, which are in the same range.
std::optional<ImageHeader> jpeg_header(std::string_view bytes) {
  std::size_t at = 2;
  while (at + 10 <= bytes.size() && byte(bytes, at) == 0xff) {
    const std::uint32_t marker = byte(bytes, at + 1);
    const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (frame)
      return ImageHeader{two_bytes(bytes, at + 7), two_bytes(bytes, at + 5),
                         static_cast<int>(byte(bytes, at + 9)), static_cast<int>(byte(bytes, at + 4))};
    at += marker == 0xff ? 1 : 2 + static_cast<std::size_t>(two_bytes(bytes, at + 2));
  }
  return std::nullopt;
}

/// P5 and P6: header, one white space, raw samples. P2 and P3: one number per sample.
const char* check_netpbm(std::string_view bytes) {
  const char type = bytes[1];
  std::size_t at = 2;
  const auto width = netpbm_number(bytes, at), height = netpbm_number(bytes, at),
             most = netpbm_number(bytes, at);
  if (!width || !height || !most) return "its PGM or PPM header cannot be read";
  const std::uint64_t samples = *width * *height * (type == '6' || type == '3' ? 3 : 1);
  if (type == '5' || type == '6') {
    return bytes.size() < at + 1 + samples * (*most > 255 ? 2 : 1) ? cut_short : nullptr;
  }
  for (std::uint64_t i = 0; i < samples; ++i) {
    if (!netpbm_number(bytes, at)) return cut_short;
  }
  return nullptr;
}

/// Skips segments by their lengths up to the scan, so that the end marker of an embedded preview is not
/// mistaken for that of the image.
const char* check_jpeg(std::string_view bytes) {
  std::size_t at = 2;
  while (at + 4 <= bytes.size()) {
    if (byte(bytes, at) != 0xff) return "its JPEG segments are broken";
    const std::uint32_t marker = byte(bytes, at + 1);
    if (marker == 0xff) {  // padding
      ++at;
      continue;
    }
    at += 2 + (byte(bytes, at + 2) << 8 | byte(bytes, at + 3));
    if (marker == 0xda) {
      const bool ended = at < bytes.size() && bytes.find("\xff\xd9", at) != std::string_view::npos;
      return ended ? nullptr : cut_short;
    }
  }
  return cut_short;
}

const char* check_png(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.find("\0\0\0\0IEND\xae\x42\x60\x82"sv) == std::string_view::npos ? cut_short : nullptr;
}

const char* check_bmp(std::string_view bytes) {
  if (bytes.size() < 54) return cut_short;
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 2, 4);  // BMP and all supported machines are little-endian
  return bytes.size() < size ? cut_short : nullptr;
}

}  // namespace

std::optional<ImageHeader> image_header(std::string_view bytes) {
  if (bytes.size() < 4) return std::nullopt;
  if (bytes[0] == 'P' && (bytes[1] == '5' || bytes[1] == '6' || bytes[1] == '2' || bytes[1] == '3'))
    return netpbm_header(bytes);
  if (bytes.starts_with("\xff\xd8")) return jpeg_header(bytes);
  if (bytes.starts_with("\x89PNG")) return png_header(bytes);
  return std::nullopt;
}

std::optional<ImageHeader> read_image_header(const std::filesystem::path& path) {
  constexpr std::size_t most = 1 << 17;  // in a JPEG, a preview may precede the header
  std::string bytes(most, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(most));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return image_header(bytes);
}

const char* why_cut_short(std::string_view bytes) {
  if (bytes.empty()) return "the file is empty";
  if (bytes.size() < 4) return cut_short;
  if (bytes[0] == 'P' && (bytes[1] == '5' || bytes[1] == '6' || bytes[1] == '2' || bytes[1] == '3')) {
    return check_netpbm(bytes);
  }
  if (bytes.starts_with("\xff\xd8")) return check_jpeg(bytes);
  if (bytes.starts_with("\x89PNG")) return check_png(bytes);
  if (bytes.starts_with("BM")) return check_bmp(bytes);
  return nullptr;  // other formats are left to their decoders
}

namespace {

/// Gray image, read with additional OpenCV flags `more`; empty if it cannot be decoded. `what`: its name in errors.
cv::Mat decoded_bytes(std::string_view bytes, const std::string& what, int more) {
  if (const char* why = why_cut_short(bytes)) throw std::runtime_error(fmt::format("{}: {}", what, why));
  try {
    const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    return cv::imdecode(raw, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION | more);
  } catch (const cv::Exception& error) {
    throw std::runtime_error(fmt::format("{}: cannot be decoded: {}", what, error.err));
  }
}

cv::Mat decoded(const std::filesystem::path& path, int more) {
  return decoded_bytes(read_file(path, largest_image_file), shown(path), more);
}

}  // namespace

Eigen::MatrixXd read_shares_of_white(const std::filesystem::path& path) {
  const cv::Mat gray = decoded(path, cv::IMREAD_ANYDEPTH);
  if (gray.empty() || (gray.type() != CV_8U && gray.type() != CV_16U))
    throw std::runtime_error(
        fmt::format("{}: is not an image of 8 or 16 bits that can be decoded", shown(path)));
  const bool fine = gray.type() == CV_16U;
  Eigen::MatrixXd shares(gray.rows, gray.cols);
  for (int v = 0; v < gray.rows; ++v)
    for (int u = 0; u < gray.cols; ++u)
      shares(v, u) = fine ? gray.at<std::uint16_t>(v, u) / 65535.0 : gray.at<std::uint8_t>(v, u) / 255.0;
  return shares;
}

Image decode_image(std::string_view bytes, const std::string& what) {
  const cv::Mat gray = decoded_bytes(bytes, what, 0);
  if (gray.empty() || gray.type() != CV_8U)
    throw std::runtime_error(fmt::format("{}: is not an image that can be decoded", what));
  return gray_image(gray);
}

Image read_image(const std::filesystem::path& path) {
  return decode_image(read_file(path, largest_image_file), shown(path));
}

}  // namespace incognita
