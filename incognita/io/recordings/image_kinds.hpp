// Checks that the images of a folder are from one camera: color and depth, or left and right images, are
// often stored together.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "incognita/io/formats/image_names.hpp"

namespace incognita {

/// Matches as a shell does: `*` for any text, `?` for one character.
bool fits_pattern(const std::string& pattern, const std::string& name);

/// Names are of one kind if they differ in their numbers only. Throws InputError with the kinds, their counts
/// and the remedy if a second kind makes up a considerable share of the folder; else returns a note on
/// irregularities, or an empty text.
std::string check_names(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// The same for size, channels and bit depth, from the file headers. A difference in channels only is never
/// refused, as images are converted to gray. Formats other than PNG, JPEG, PGM and PPM are not checked.
std::string check_headers(const std::filesystem::path& folder, const std::vector<std::string>& names);

}  // namespace incognita
