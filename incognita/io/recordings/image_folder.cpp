#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <system_error>

#include "incognita/io/formats/image_names.hpp"
#include "incognita/io/recordings/image_kinds.hpp"
#include "incognita/io/recordings/recording_formats.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

/// The last number in a name; nullopt if there is none or it is too long for a frame number.
std::optional<std::int64_t> number_in(const std::string& name) {
  constexpr std::size_t longest = 9;  // longer ones are time stamps
  std::size_t end = name.size();
  while (end > 0 && !is_digit(name[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && is_digit(name[begin - 1])) --begin;
  if (begin == end || end - begin > longest) return std::nullopt;
  return std::stoll(name.substr(begin, end - begin));
}

/// Warning about gaps in names numbered one by one; empty if there are none or names are not numbered so.
std::string missing_numbers(const std::vector<std::string>& names) {
  std::int64_t missing = 0;
  std::size_t steps_of_one = 0;
  std::string first;
  for (std::size_t i = 1; i < names.size(); ++i) {
    const auto before = number_in(names[i - 1]), here = number_in(names[i]);
    if (!before || !here || *here <= *before) return "";
    steps_of_one += *here == *before + 1;
    missing += *here - *before - 1;
    if (first.empty() && *here > *before + 1) first = names[i - 1] + " and " + names[i];
  }
  if (missing == 0 || 2 * steps_of_one < names.size()) return "";
  return fmt::format("{} numbers are missing, the first between {}; the images are treated as consecutive",
                     missing, first);
}

}  // namespace

Recording read_image_folder(const std::filesystem::path& folder, double rate_hz, const std::string& pattern) {
  std::vector<std::string> names;
  std::string folders;
  int others = 0, unchosen = 0;
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    const std::string name = it->path().filename().string();
    if (it->is_directory(ignored)) {
      folders += (folders.empty() ? "" : ", ") + name;
    } else if (is_image_name(it->path())) {
      if (pattern.empty() || fits_pattern(pattern, name))
        names.push_back(name);
      else
        ++unchosen;
    } else {
      ++others;
    }
  }
  if (error) throw InputError(fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
  if (names.empty() && unchosen > 0)
    throw InputError(fmt::format("{}: recording.pattern = \"{}\" matches none of its {} images",
                                 folder.string(), pattern, unchosen));
  if (names.empty()) {
    throw InputError(fmt::format("{}: there are no images in this folder{}", folder.string(),
                                 folders.empty() ? "" : "; it has the folders " + folders));
  }
  std::sort(names.begin(), names.end(), naturally_before);
  const std::string odd_names = pattern == "*" ? "" : check_names(folder, names),
                    odd_headers = check_headers(folder, names);
  Recording recording{"images", folder, {}, {}, {}, {}};
  for (const std::string& name : names) {
    recording.frames.push_back({static_cast<double>(recording.frames.size()) / rate_hz, folder / name});
  }
  recording.notes.push_back(fmt::format("{} images, {} to {}, at {} Hz by run.rate_hz", names.size(),
                                        names.front(), names.back(), rate_hz));
  if (const std::string gaps = missing_numbers(names); !gaps.empty()) recording.notes.push_back(gaps);
  for (const std::string& odd : {odd_names, odd_headers})
    if (!odd.empty()) recording.notes.push_back(odd);
  if (unchosen > 0)
    recording.notes.push_back(
        fmt::format("{} images that do not match recording.pattern are ignored", unchosen));
  if (others > 0) recording.notes.push_back(fmt::format("{} files that are not images are ignored", others));
  return recording;
}

}  // namespace incognita
