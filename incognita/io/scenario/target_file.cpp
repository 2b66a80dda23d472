#include "incognita/io/scenario/target_file.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/image_file.hpp"
#include "incognita/io/formats/target_image.hpp"
#include "incognita/io/formats/toml_value.hpp"
#include "incognita/io/scenario/scenario_file.hpp"
#include "incognita/math/nearest_name.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::size_t largest_target = 1 << 20;
constexpr int smallest_patch_px = 9, largest_patch_px = 101;
constexpr std::size_t most_corners = 100;
using Folders = std::vector<std::filesystem::path>;

[[noreturn]] void refuse(const std::string& file, int line, const std::string& key, const std::string& why) {
  throw InputError(fmt::format("{}:{}: {}: {}", file, line, key, why));
}

const TomlEntry* find(const TomlTable& table, const std::string& key) {
  for (const TomlEntry& entry : table) {
    if (entry.key == key) return &entry;
  }
  return nullptr;
}

const TomlEntry& need(const TomlTable& table, const std::string& key, const std::string& file, int line) {
  if (const TomlEntry* entry = find(table, key)) return *entry;
  refuse(file, line, key, "is missing");
}

void refuse_unknown(const TomlTable& table, const std::vector<std::string>& known, const std::string& file) {
  for (const TomlEntry& entry : table) {
    bool found = false;
    for (const std::string& name : known) found = found || name == entry.key;
    if (!found) {
      refuse(file, entry.line, entry.key,
             fmt::format("there is no such key in a target file; the nearest is `{}`",
                         nearest_name(entry.key, known)));
    }
  }
}

std::string text_of(const TomlEntry& entry, const std::string& file) {
  if (const auto* text = std::get_if<std::string>(&entry.value.value)) return *text;
  refuse(file, entry.line, entry.key, "must be a text, and is " + entry.value.kind());
}

template <int size>
Eigen::Vector<double, size> vector_of(const TomlEntry& entry, const std::string& file) {
  const auto* items = std::get_if<TomlArray>(&entry.value.value);
  Eigen::Vector<double, size> vector = Eigen::Vector<double, size>::Constant(NAN);
  for (std::size_t i = 0; items && items->size() == size && i < size; ++i) {
    const TomlValue& item = (*items)[i];
    const auto at = static_cast<Eigen::Index>(i);
    if (const auto* whole = std::get_if<std::int64_t>(&item.value)) vector[at] = static_cast<double>(*whole);
    if (const auto* real = std::get_if<double>(&item.value)) vector[at] = *real;
  }
  if (!vector.allFinite() || vector.cwiseAbs().maxCoeff() > 1e6) {
    refuse(file, entry.line, entry.key,
           fmt::format("must be a list of {} finite numbers up to 1e6, and is {}",
                       size == 2 ? "two" : "three", entry.value.written()));
  }
  return vector;
}

/// SceneLib: x left, y up, z forward. Here: x forward, y left, z up. Both are right-handed.
Eigen::Vector3d from_scenelib(const Eigen::Vector3d& v) { return {v.z(), v.x(), v.y()}; }

/// The first file of that name in the folders; refuses an image of uniform gray.
Image read_named_image(const TomlEntry& entry, const std::string& file, const Folders& folders) {
  const std::string name = text_of(entry, file);
  std::optional<std::filesystem::path> path;
  for (const std::filesystem::path& folder : folders) {
    if (!path && file_exists(folder / name)) path = folder / name;
  }
  if (!path) {
    std::string looked;
    for (const std::filesystem::path& folder : folders)
      looked +=
          (looked.empty() ? "" : ", ") + (is_embedded(folder) ? "those built in" : shown(folder / name));
    refuse(file, entry.line, entry.key,
           fmt::format("{} is not there (looked for {}); see docs/data.md", name, looked));
  }
  Image image;
  try {
    image = read_image(*path);
  } catch (const std::runtime_error& error) {
    refuse(file, entry.line, entry.key, error.what());
  }
  const int pixels = image.width() * image.height();
  const auto [least, most] = std::minmax_element(image.row(0), image.row(0) + pixels);
  if (*most - *least < 8) refuse(file, entry.line, entry.key, name + " is of one gray: nothing to recognize");
  return image;
}

Image read_patch(const TomlEntry& entry, const std::string& file, const Folders& folders) {
  Image patch = read_named_image(entry, file, folders);
  const int size = patch.width();
  if (size != patch.height() || size % 2 == 0 || size < smallest_patch_px || size > largest_patch_px) {
    refuse(file, entry.line, entry.key,
           fmt::format("{} must be an odd square of {} to {} px, and is {}x{}", text_of(entry, file),
                       smallest_patch_px, largest_patch_px, patch.width(), patch.height()));
  }
  return patch;
}

Target::Picture read_picture(const TomlEntry& entry, const Target& target, const Eigen::MatrixX2d& pixels,
                             const std::string& file, const Folders& folders) {
  const Image whole = read_named_image(entry, file, folders);
  try {
    return target_picture_from(target, whole, pixels);
  } catch (const std::invalid_argument& error) {
    refuse(file, entry.line, entry.key, error.what());
  }
}

void check_geometry(const Target& target, const std::string& file, int line) {
  const std::size_t n = target.corners.size();
  Eigen::MatrixX3d points(n, 3);
  for (std::size_t i = 0; i < n; ++i) points.row(static_cast<Eigen::Index>(i)) = target.corners[i].position;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if ((target.corners[i].position - target.corners[j].position).norm() > 1e-4) continue;
      refuse(file, line, "position_m", fmt::format("corners {} and {} are at the same place", i, j));
    }
  }
  points.rowwise() -= points.colwise().mean().eval();
  // Ascending eigenvalues: spread normal to the plane of the corners, within it, and along the longest extent.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(points.transpose() * points);
  const double longest = spread.eigenvalues()[2];
  if (spread.eigenvalues()[1] < 1e-6 * longest)
    refuse(file, line, "position_m", "the corners are on one line");
  if (spread.eigenvalues()[0] > 1e-6 * longest)
    refuse(file, line, "position_m", "the corners are not in one plane");
  if (std::abs(spread.eigenvectors().col(0).dot(target.normal)) < std::cos(0.02)) {
    refuse(file, line, "normal", "is not perpendicular to the plane of the corners");
  }
}

Target::Corner read_corner(const TomlValue& value, bool scenelib, const std::string& file,
                           const Folders& folders) {
  const auto* corner = std::get_if<TomlTable>(&value.value);
  if (!corner) refuse(file, value.line, "corner", "must be a table, written [[corner]]");
  refuse_unknown(*corner, {"position_m", "patch", "picture_px"}, file);
  const auto position = vector_of<3>(need(*corner, "position_m", file, value.line), file);
  return {scenelib ? from_scenelib(position) : position,
          read_patch(need(*corner, "patch", file, value.line), file, folders)};
}

/// One row (u, v) per corner, px.
Eigen::MatrixX2d read_picture_pixels(const TomlArray& corners, const std::string& file) {
  Eigen::MatrixX2d pixels(corners.size(), 2);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& corner = std::get<TomlTable>(corners[i].value);
    pixels.row(static_cast<Eigen::Index>(i)) =
        vector_of<2>(need(corner, "picture_px", file, corners[i].line), file);
  }
  return pixels;
}

void refuse_pixels(const TomlArray& corners, const std::string& file) {
  for (const TomlValue& corner : corners)
    if (const TomlEntry* pixel = find(std::get<TomlTable>(corner.value), "picture_px"))
      refuse(file, pixel->line, pixel->key, "is of no use without `picture`");
}

}  // namespace

Target read_target(const std::filesystem::path& path, const Folders& patch_folders) {
  const std::string file = shown(path);
  const TomlTable table = parse_toml(read_file(path, largest_target), file);
  refuse_unknown(table, {"name", "normal", "axes", "picture", "corner"}, file);
  Folders folders = {path.parent_path()};
  folders.insert(folders.end(), patch_folders.begin(), patch_folders.end());

  const TomlEntry* axes = find(table, "axes");
  const bool scenelib = axes && text_of(*axes, file) == "scenelib";
  if (axes && !scenelib && text_of(*axes, file) != "world") {
    refuse(file, axes->line, "axes", "must be `world` or `scenelib`, and is " + axes->value.written());
  }
  Target target;
  target.name = text_of(need(table, "name", file, 1), file);
  const TomlEntry& normal = need(table, "normal", file, 1);
  target.normal = vector_of<3>(normal, file);
  if (target.normal.norm() < 1e-6) refuse(file, normal.line, "normal", "must not be zero");
  target.normal = (scenelib ? from_scenelib(target.normal) : target.normal).normalized();

  const TomlEntry& corner = need(table, "corner", file, 1);
  const auto* corners = std::get_if<TomlArray>(&corner.value.value);
  if (!corners || corners->size() < 4 || corners->size() > most_corners) {
    refuse(file, corner.line, "corner",
           fmt::format("must be 4 to {} tables, written [[corner]], and is {}", most_corners,
                       corners ? std::to_string(corners->size()) : corner.value.kind()));
  }
  for (const TomlValue& value : *corners)
    target.corners.push_back(read_corner(value, scenelib, file, folders));
  check_geometry(target, file, corner.line);
  if (const TomlEntry* picture = find(table, "picture"))
    target.picture = read_picture(*picture, target, read_picture_pixels(*corners, file), file, folders);
  else
    refuse_pixels(*corners, file);
  return target;
}

std::filesystem::path find_target(const LoadedScenario& loaded) {
  return find_named_file(loaded, "start.target", loaded.scenario.start.target);
}

Target load_target(const LoadedScenario& loaded) {
  Folders folders = data_folders(loaded.file);
  folders.push_back(std::filesystem::path(embedded_root) / "targets");
  return read_target(find_target(loaded), folders);
}

}  // namespace incognita
