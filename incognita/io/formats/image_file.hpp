// Reads gray images from files and detects incomplete ones.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "incognita/vision/image.hpp"

namespace incognita {

/// The image as 8-bit gray in the orientation of the sensor (a rotation stored in the file is ignored,
/// because the calibration belongs to the sensor). Throws std::runtime_error naming the file if it is
/// missing, truncated or not an image.
Image read_image(const std::filesystem::path& path);
/// The same of the bytes of a file; `what` names it in errors.
Image decode_image(std::string_view bytes, const std::string& what);

/// The image as fractions of white, 0 to 1, at the full depth of an 8- or 16-bit file; rows as in the image.
/// Throws like read_image().
Eigen::MatrixXd read_shares_of_white(const std::filesystem::path& path);

struct ImageHeader {
  int width = 0, height = 0, channels = 1, bits = 8;  ///< bits per sample
};

/// The header of a PNG, JPEG, PGM or PPM file from its first bytes; nullopt for other formats or a truncated header.
std::optional<ImageHeader> image_header(std::string_view bytes);
/// The same of a file, of which it reads no more than that; also nullopt if it cannot be read.
std::optional<ImageHeader> read_image_header(const std::filesystem::path& path);

/// Why the bytes cannot be a complete image file, or null. Checked because decoders silently fill missing
/// parts with gray.
const char* why_cut_short(std::string_view bytes);

}  // namespace incognita
