#include "incognita/io/formats/image_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

/// Begin, without leading zeros, and end of the digits at `at`.
std::pair<std::size_t, std::size_t> digits(const std::string& name, std::size_t at) {
  std::size_t end = at;
  while (end < name.size() && is_digit(name[end])) ++end;
  while (at + 1 < end && name[at] == '0') ++at;
  return {at, end};
}

}  // namespace

bool is_image_name(const std::filesystem::path& path) {
  static constexpr const char* endings[] = {".pgm", ".png",  ".jpg", ".jpeg", ".ppm",
                                            ".bmp", ".tiff", ".tif", ".webp", ".pnm"};
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(std::begin(endings), std::end(endings), ending) != std::end(endings);
}

bool naturally_before(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const auto [a_begin, a_end] = digits(a, i);
      const auto [b_begin, b_end] = digits(b, j);
      if (a_end - a_begin != b_end - b_begin) return a_end - a_begin < b_end - b_begin;
      const int order = a.compare(a_begin, a_end - a_begin, b, b_begin, b_end - b_begin);
      if (order != 0) return order < 0;
      i = a_end;
      j = b_end;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;  // equal except for leading zeros
}

std::vector<std::string> names_in(const std::filesystem::path& folder,
                                  const std::function<bool(const std::filesystem::directory_entry&)>& takes) {
  std::vector<std::string> names;
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (takes(*it)) names.push_back(it->path().filename().string());
  if (error) throw InputError(fmt::format("{}: cannot be read: {}", shown(folder), error.message()));
  std::sort(names.begin(), names.end(), naturally_before);
  return names;
}

std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> images;
  for (const std::string& name :
       names_in(folder, [](const auto& entry) { return is_image_name(entry.path()); }))
    images.push_back(folder / name);
  return images;
}

}  // namespace incognita
