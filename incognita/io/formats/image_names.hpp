// Names of image files, and the files of a folder in the order of their names.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace incognita {

/// Of ASCII, whatever the locale.
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether the file is an image by the ending of its name.
bool is_image_name(const std::filesystem::path& path);

/// Natural order: digit sequences of any length compare as numbers.
bool naturally_before(const std::string& a, const std::string& b);

/// Names of what `takes` takes of a folder, in natural order. Throws InputError if the folder cannot be read.
std::vector<std::string> names_in(const std::filesystem::path& folder,
                                  const std::function<bool(const std::filesystem::directory_entry&)>& takes);

/// The image files of a folder, in natural order. Throws InputError if the folder cannot be read.
std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder);

}  // namespace incognita
