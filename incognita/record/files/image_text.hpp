// An image as text, small: what JSON can carry.
#pragma once

#include <string>
#include <string_view>

#include "incognita/vision/image.hpp"

namespace incognita {

/// The bytes of a grey JPEG file, made to be looked at.
std::string jpeg(const Image& image);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace incognita
