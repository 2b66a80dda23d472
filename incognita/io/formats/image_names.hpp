// Names of image files.
#pragma once

#include <filesystem>
#include <string>

namespace incognita {

/// Of ASCII, whatever the locale.
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether the file is an image by the ending of its name.
bool is_image_name(const std::filesystem::path& path);

/// Natural order: digit sequences of any length compare as numbers.
bool naturally_before(const std::string& a, const std::string& b);

}  // namespace incognita
