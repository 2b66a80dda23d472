#include "incognita/io/image_kinds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "incognita/io/image_file.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// "frame-000012.color.png" as "frame-*.color.png", which recording.pattern understands.
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

/// The most frequent first.
void sort(std::vector<Kind>& kinds) {
  std::stable_sort(kinds.begin(), kinds.end(),
                   [](const Kind& a, const Kind& b) { return a.count > b.count; });
}

/// A few that stand out are an accident; a tenth of the folder is another camera.
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

/// So much of a file holds its header; a JPEG may have a preview before it.
std::optional<ImageHeader> header_of(const std::filesystem::path& file) {
  constexpr std::size_t most = 1 << 17;
  std::string bytes(most, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(most));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return image_header(bytes);
}

}  // namespace

std::string check_names(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  std::vector<Kind> kinds;
  for (const std::string& name : names) count(kinds, kind_of(name), name);
  sort(kinds);
  if (is_another_camera(kinds, names.size()))
    throw InputError(
        fmt::format("{}: the {} images have names of {} kinds: {}. A recording is of one camera: choose with "
                    "recording.pattern, "
                    "e.g. recording.pattern = \"{}\"; \"*\" takes all",
                    folder.string(), names.size(), kinds.size(), list_of(kinds), kinds[0].words));
  if (kinds.size() < 2 || kinds[0].count < 2) return "";
  return fmt::format("names of {} kinds: {}; all are taken, unless recording.pattern chooses", kinds.size(),
                     list_of(kinds));
}

std::string check_headers(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  std::vector<Kind> sizes, channels;
  for (const std::string& name : names) {
    const auto header = header_of(folder / name);
    if (!header) continue;
    count(sizes, fmt::format("of {}x{} px with {} bits", header->width, header->height, header->bits), name);
    count(channels, header->channels == 1 ? "grey" : "in colour", name);
  }
  sort(sizes), sort(channels);
  if (is_another_camera(sizes, names.size()))
    throw InputError(fmt::format(
        "{}: the {} images are not alike: {}. A recording is of one camera: choose its images with "
        "recording.pattern, as in recording.pattern = \"*color*\", or put them in a folder of their own",
        folder.string(), names.size(), list_of(sizes)));
  if (sizes.size() > 1) return fmt::format("the images are not alike: {}", list_of(sizes));
  if (is_another_camera(channels, names.size()))
    return fmt::format("images of two kinds: {}", list_of(channels));
  return "";
}

}  // namespace incognita
