#include "incognita/io/recordings/image_kinds.hpp"

#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "incognita/io/formats/image_file.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

/// "frame-000012.color.png" becomes "frame-*.color.png", a valid recording.pattern.
std::string kind_of(const std::string& name) {
  std::string kind;
  for (const char c : name)
    if (!is_digit(c))
      kind += c;
    else if (kind.empty() || kind.back() != '*')
      kind += '*';
  return kind;
}

struct Kind {
  std::string words, first;
  std::size_t count = 0;
};

void count(std::vector<Kind>& kinds, const std::string& words, const std::string& name) {
  auto found = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.words == words; });
  if (found == kinds.end()) found = kinds.insert(found, {words, name, 0});
  ++found->count;
}

/// Most frequent first.
void sort(std::vector<Kind>& kinds) {
  std::stable_sort(kinds.begin(), kinds.end(),
                   [](const Kind& a, const Kind& b) { return a.count > b.count; });
}

/// A few odd names are accidental; a tenth of the folder is a second camera.
bool is_another_camera(const std::vector<Kind>& kinds, std::size_t images) {
  return kinds.size() > 1 && kinds[1].count >= 2 && 10 * kinds[1].count >= images;
}

std::string list_of(const std::vector<Kind>& kinds) {
  constexpr std::size_t most = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(kinds.size(), most); ++i)
    text += fmt::format("{}{} {} (the first {})", text.empty() ? "" : ", ", kinds[i].count, kinds[i].words,
                        kinds[i].first);
  return kinds.size() > most ? fmt::format("{}, and {} kinds more", text, kinds.size() - most) : text;
}

/// Whether the kind as a pattern matches no other kind: "*.png" also matches "1_depth.png".
bool takes_only_its_own(const Kind& kind, const std::vector<std::string>& names) {
  const auto taken = std::count_if(names.begin(), names.end(),
                                   [&](const std::string& name) { return fits_pattern(kind.words, name); });
  return static_cast<std::size_t>(taken) == kind.count;
}

/// "cam1_0007.png" becomes {"cam1_", "0007.png"}: split at the second number.
std::pair<std::string, std::string> at_second_number(const std::string& name) {
  const auto first = std::find_if(name.begin(), name.end(), is_digit);
  const auto second = std::find_if(std::find_if_not(first, name.end(), is_digit), name.end(), is_digit);
  return {{name.begin(), second}, {second, name.end()}};
}

/// The name prefixes if a few prefixes have identical second numbers, as for two cameras "cam0_" and "cam1_";
/// else empty. Only used for a note, because minutes before seconds look the same.
std::vector<std::string> cameras_by_number(const std::vector<std::string>& names) {
  std::map<std::string, std::set<std::string>> rest;
  for (const std::string& name : names) {
    const auto [first, second] = at_second_number(name);
    if (second.empty()) return {};
    rest[first].insert(second);
  }
  constexpr std::size_t most_cameras = 8;
  if (rest.size() < 2 || rest.size() > most_cameras || rest.begin()->second.size() < 2) return {};
  std::vector<std::string> cameras;
  for (const auto& [first, second] : rest) {
    if (second != rest.begin()->second) return {};
    cameras.push_back(first);
  }
  return cameras;
}

}  // namespace

bool fits_pattern(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

std::string check_names(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  std::vector<Kind> kinds;
  for (const std::string& name : names) count(kinds, kind_of(name), name);
  sort(kinds);
  if (is_another_camera(kinds, names.size()))
    throw InputError(
        fmt::format("{}: the {} images have names of {} kinds: {}. A recording is of one camera: {}; "
                    "recording.pattern = \"*\" selects all",
                    folder.string(), names.size(), kinds.size(), list_of(kinds),
                    takes_only_its_own(kinds[0], names)
                        ? fmt::format("select, e.g. recording.pattern = \"{}\"", kinds[0].words)
                        : "put its images into their own folder"));
  if (const auto cameras = cameras_by_number(names); !cameras.empty())
    return fmt::format(
        "the same numbers follow {}: if these are cameras, select one, e.g. "
        "recording.pattern = \"{}*\"",
        fmt::join(cameras, ", "), cameras.front());
  if (kinds.size() < 2 || kinds[0].count < 2) return "";
  return fmt::format("names of {} kinds: {}; all are used unless recording.pattern selects", kinds.size(),
                     list_of(kinds));
}

std::string check_headers(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  std::vector<Kind> sizes, channels;
  for (const std::string& name : names) {
    const auto header = read_image_header(folder / name);
    if (!header) continue;
    count(sizes, fmt::format("of {}x{} px with {} bits", header->width, header->height, header->bits), name);
    count(channels, header->channels == 1 ? "gray" : "in color", name);
  }
  sort(sizes), sort(channels);
  if (is_another_camera(sizes, names.size()))
    throw InputError(fmt::format(
        "{}: the {} images differ: {}. A recording is of one camera: select its images with "
        "recording.pattern, as in recording.pattern = \"*color*\", or put them into their own folder",
        folder.string(), names.size(), list_of(sizes)));
  if (sizes.size() > 1) return fmt::format("the images differ: {}", list_of(sizes));
  if (is_another_camera(channels, names.size()))
    return fmt::format("images of two kinds: {}", list_of(channels));
  return "";
}

}  // namespace incognita
