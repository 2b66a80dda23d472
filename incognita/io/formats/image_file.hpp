// Grey images from files, whole or not at all.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string_view>

#include "incognita/vision/image.hpp"

namespace incognita {

/// The image as 8-bit grey, in the sensor's own orientation (a rotation noted in the file is not applied: the
/// calibration belongs to the sensor). Throws std::runtime_error naming the file when it is missing, cut
/// short or not an image.
Image read_image(const std::filesystem::path& path);

/// The image as shares of white, 0 to 1, to the full depth of a file of 8 or 16 bits; rows as in the image.
/// Throws likewise.
Eigen::MatrixXd read_shares_of_white(const std::filesystem::path& path);

struct ImageHeader {
  int width = 0, height = 0, channels = 1, bits = 8;  ///< bits of each sample
};

/// What the first bytes of a PNG, JPEG, PGM or PPM file say of it; nothing for other formats, or where the
/// bytes end before its header does.
std::optional<ImageHeader> image_header(std::string_view bytes);

/// Why the bytes cannot be a whole image file, or nothing. Decoders fill what is missing with grey without a
/// word.
const char* why_cut_short(std::string_view bytes);

}  // namespace incognita
