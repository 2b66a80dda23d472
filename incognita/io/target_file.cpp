#include "incognita/io/target_file.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

#include "incognita/io/data_folder.hpp"
#include "incognita/io/files.hpp"
#include "incognita/io/image_file.hpp"
#include "incognita/io/scenario_file.hpp"
#include "incognita/io/toml_value.hpp"
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

Eigen::Vector3d vector_of(const TomlEntry& entry, const std::string& file) {
  const auto* items = std::get_if<TomlArray>(&entry.value.value);
  Eigen::Vector3d vector(NAN, NAN, NAN);
  for (std::size_t i = 0; items && items->size() == 3 && i < 3; ++i) {
    const TomlValue& item = (*items)[i];
    if (const auto* whole = std::get_if<std::int64_t>(&item.value)) vector[i] = static_cast<double>(*whole);
    if (const auto* real = std::get_if<double>(&item.value)) vector[i] = *real;
  }
  if (!vector.allFinite() || vector.cwiseAbs().maxCoeff() > 1e6) {
    refuse(file, entry.line, entry.key,
           "must be a list of three finite numbers up to 1e6, and is " + entry.value.written());
  }
  return vector;
}

/// SceneLib: x left, y up, z forward. Here: x forward, y left, z up. Both are right-handed.
Eigen::Vector3d from_scenelib(const Eigen::Vector3d& v) { return {v.z(), v.x(), v.y()}; }

Image read_patch(const TomlEntry& entry, const std::string& file, const Folders& folders) {
  const std::string name = text_of(entry, file);
  std::optional<std::filesystem::path> path;
  for (const std::filesystem::path& folder : folders) {
    if (!path && file_exists(folder / name)) path = folder / name;
  }
  if (!path) {
    std::string looked;
    for (const std::filesystem::path& folder : folders)
      looked += (looked.empty() ? "" : ", ") + shown(folder / name);
    refuse(file, entry.line, entry.key,
           fmt::format("{} is not there (looked for {}); see docs/data.md", name, looked));
  }
  Image patch;
  try {
    patch = read_image(*path);
  } catch (const std::runtime_error& error) {
    refuse(file, entry.line, entry.key, error.what());
  }
  const int size = patch.width();
  if (size != patch.height() || size % 2 == 0 || size < smallest_patch_px || size > largest_patch_px) {
    refuse(file, entry.line, entry.key,
           fmt::format("{} must be an odd square of {} to {} px, and is {}x{}", name, smallest_patch_px,
                       largest_patch_px, patch.width(), patch.height()));
  }
  const auto [least, most] = std::minmax_element(patch.row(0), patch.row(0) + size * size);
  if (*most - *least < 8) refuse(file, entry.line, entry.key, name + " is of one grey: nothing to recognise");
  return patch;
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
  // Eigenvalues grow: the spread across the plane of the corners, within it, and along their longest extent
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
  refuse_unknown(*corner, {"position_m", "patch"}, file);
  const Eigen::Vector3d position = vector_of(need(*corner, "position_m", file, value.line), file);
  return {scenelib ? from_scenelib(position) : position,
          read_patch(need(*corner, "patch", file, value.line), file, folders)};
}

}  // namespace

Target read_target(const std::filesystem::path& path, const Folders& patch_folders) {
  const std::string file = shown(path);
  const TomlTable table = parse_toml(read_file(path, largest_target), file);
  refuse_unknown(table, {"name", "normal", "axes", "corner"}, file);
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
  target.normal = vector_of(normal, file);
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
  return target;
}

std::filesystem::path find_target(const LoadedScenario& loaded) {
  return find_named_file(loaded, "start.target", loaded.scenario.start.target);
}

Target load_target(const LoadedScenario& loaded) {
  return read_target(find_target(loaded), data_folders(loaded.file));
}

}  // namespace incognita
