#include "incognita/io/targets/target_files.hpp"

#include <fmt/format.h>

#include <sstream>

#include "incognita/io/formats/toml_value.hpp"

namespace incognita {
namespace {

std::string pgm_bytes(const Image& image) {
  std::string bytes = fmt::format("P5\n{} {}\n255\n", image.width(), image.height());
  bytes.append(reinterpret_cast<const char*>(image.row(0)),
               static_cast<std::size_t>(image.width()) * image.height());
  return bytes;
}

/// Rounded, so that 0.105 is not written as 0.10500000000000001: to 1e-7 m and px.
std::string rounded(double value) { return toml_number(std::round(value * 1e7) / 1e7 + 0.0); }

std::string comment_of(const std::string& text) {
  std::string comment;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) comment += "# " + line + "\n";
  return comment;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> target_files(const NewTarget& target,
                                                              const std::string& name) {
  const std::string picture = name + ".pgm";
  std::vector<std::pair<std::string, std::string>> files(1);
  std::string toml =
      comment_of(target.comment) +
      fmt::format("name = {}\nnormal = [-1, 0, 0]     # out of the printed side\npicture = {}\n",
                  toml_string(name), toml_string(picture));
  for (std::size_t i = 0; i < target.corners.size(); ++i) {
    const NewTarget::Corner& corner = target.corners[i];
    const std::string patch = fmt::format("{}-{}.pgm", name, i);
    // x forward, y left, z up
    toml += fmt::format("\n[[corner]]\nposition_m = [0, {}, {}]\npatch = {}\npicture_px = [{}, {}]\n",
                        rounded(-corner.position_m.x()), rounded(-corner.position_m.y()), toml_string(patch),
                        rounded(corner.picture_px.x()), rounded(corner.picture_px.y()));
    files.emplace_back(patch, pgm_bytes(corner.patch));
  }
  files.emplace_back(picture, pgm_bytes(target.picture));
  files.front() = {name + ".toml", toml};
  return files;
}

bool is_written_target(std::string_view toml) {
  const std::string_view first = toml.substr(0, toml.find('\n'));
  return first.starts_with("# ") && first.find("`incognita target") != std::string_view::npos;
}

}  // namespace incognita
