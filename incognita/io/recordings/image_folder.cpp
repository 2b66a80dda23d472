#include <fmt/format.h>

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

struct FolderContents {
  std::vector<std::string> names;  ///< of the chosen images, in natural order
  std::string folders;             ///< their names
  int others = 0;                  ///< files that are no images
  int unchosen = 0;                ///< images that the pattern does not choose
};

FolderContents contents_of(const std::filesystem::path& folder, const std::string& pattern) {
  FolderContents found;
  found.names = names_in(folder, [&](const std::filesystem::directory_entry& entry) {
    std::error_code ignored;
    const std::string name = entry.path().filename().string();
    if (entry.is_directory(ignored)) {
      found.folders += (found.folders.empty() ? "" : ", ") + name;
      return false;
    }
    if (!is_image_name(entry.path())) {
      ++found.others;
      return false;
    }
    const bool is_chosen = pattern.empty() || fits_pattern(pattern, name);
    found.unchosen += is_chosen ? 0 : 1;
    return is_chosen;
  });
  return found;
}

}  // namespace

Recording read_image_folder(const std::filesystem::path& folder, double rate_hz, const std::string& pattern) {
  const FolderContents found = contents_of(folder, pattern);
  const std::vector<std::string>& names = found.names;
  if (names.empty() && found.unchosen > 0)
    throw InputError(fmt::format("{}: recording.pattern = \"{}\" matches none of its {} images",
                                 folder.string(), pattern, found.unchosen));
  if (names.empty())
    throw InputError(fmt::format("{}: there are no images in this folder{}", folder.string(),
                                 found.folders.empty() ? "" : "; it has the folders " + found.folders));
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
  if (found.unchosen > 0)
    recording.notes.push_back(
        fmt::format("{} images that do not match recording.pattern are ignored", found.unchosen));
  if (found.others > 0)
    recording.notes.push_back(fmt::format("{} files that are not images are ignored", found.others));
  return recording;
}

}  // namespace incognita
