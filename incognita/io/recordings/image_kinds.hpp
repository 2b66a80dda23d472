// Whether the images of a folder are of one camera: colour and depth, or left and right, often lie side by
// side.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace incognita {

/// As a shell does: `*` for anything, `?` for one letter.
bool fits_pattern(const std::string& pattern, const std::string& name);

/// Names are of one kind when they differ in their numbers alone. Throws InputError with the kinds, their
/// counts and the remedy where a second kind has its share of the folder; else says, in words, what stands
/// out, or nothing.
std::string check_names(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// The same of sizes, channels and bits of each sample, by the headers of the files; channels alone, which
/// become grey anyway, are never refused. Formats other than PNG, JPEG and PGM or PPM are not looked into.
std::string check_headers(const std::filesystem::path& folder, const std::vector<std::string>& names);

}  // namespace incognita
