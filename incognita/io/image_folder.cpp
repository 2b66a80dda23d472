#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <system_error>

#include "incognita/io/recording_formats.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

bool is_image_name(const std::filesystem::path& path) {
  static constexpr const char* endings[] = {".pgm", ".png",  ".jpg", ".jpeg", ".ppm",
                                            ".bmp", ".tiff", ".tif", ".webp", ".pnm"};
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(std::begin(endings), std::end(endings), ending) != std::end(endings);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Where the run of digits at `at` ends, and its start past leading zeros.
std::pair<std::size_t, std::size_t> digits(const std::string& name, std::size_t at) {
  std::size_t end = at;
  while (end < name.size() && is_digit(name[end])) ++end;
  while (at + 1 < end && name[at] == '0') ++at;
  return {at, end};
}

/// Runs of digits compare as numbers, of any length.
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
  return a < b;  // the same but for leading zeros
}

}  // namespace

Recording read_image_folder(const std::filesystem::path& folder, double rate_hz) {
  std::vector<std::string> names;
  std::string folders;
  int others = 0;
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    const std::string name = it->path().filename().string();
    if (it->is_directory(ignored)) {
      folders += (folders.empty() ? "" : ", ") + name;
    } else if (is_image_name(it->path())) {
      names.push_back(name);
    } else {
      ++others;
    }
  }
  if (error) throw InputError(fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
  if (names.empty()) {
    throw InputError(fmt::format("{}: there are no images in this folder{}", folder.string(),
                                 folders.empty() ? "" : "; it has the folders " + folders));
  }
  std::sort(names.begin(), names.end(), naturally_before);
  Recording recording{"images", folder, {}, {}, {}};
  for (const std::string& name : names) {
    recording.frames.push_back({static_cast<double>(recording.frames.size()) / rate_hz, folder / name});
  }
  recording.notes.push_back(fmt::format("{} images, {} to {}, at {} Hz by run.rate_hz", names.size(),
                                        names.front(), names.back(), rate_hz));
  if (others > 0) recording.notes.push_back(fmt::format("{} files that are not images are left out", others));
  return recording;
}

}  // namespace incognita
