// Images encoded as short text, to be embedded in JSON.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "incognita/vision/image.hpp"

namespace incognita {

/// The bytes of a gray JPEG file. `quality`: 0 to 100; by default for viewing only.
std::string jpeg(const Image& image, int quality = 65);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);
/// The bytes of such a text; nothing if it is not one.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace incognita
