#include "incognita/io/scenario/terrain_file.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/image_file.hpp"
#include "incognita/io/scenario/located.hpp"
#include "incognita/io/scenario/scenario_file.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

/// Fractions of white with rows along x and columns along y. In the image, x points right and y up.
Eigen::MatrixXd seen_from_above(const Eigen::MatrixXd& image) {
  return image.colwise().reverse().transpose();
}

void check_cover(const LoadedScenario& loaded, const HeightMap& map, double length_m, double width_m) {
  for (const Eigen::Vector3d& start : loaded.scenario.team_start.positions_m)
    if (!map.contains(start.x(), start.y()))
      throw InputError(located(
          loaded,
          UnfitSetting({"terrain.size_m", "start.positions_m"},
                       fmt::format("the image reaches {:.4g} m by {:.4g} m about the origin, and a vehicle "
                                   "starts at [{:g}, {:g}]: make the image larger or terrain.size_m more",
                                   length_m, width_m, start.x(), start.y()))));
}

Terrain image_terrain(const LoadedScenario& loaded, const ImageTerrain& t) {
  const std::filesystem::path file = find_named_file(loaded, "terrain.file", t.file);
  const auto refuse = [&](const std::string& why) {
    throw InputError(
        located(loaded, UnfitSetting({"terrain.file"},
                                     why + ": take a gray image of 8 or 16 bits, PNG or PGM for instance")));
  };
  Eigen::MatrixXd image;
  try {
    image = read_shares_of_white(file);
  } catch (const std::runtime_error& error) {
    refuse(error.what());
  }
  if (image.rows() < 2 || image.cols() < 2)
    refuse(fmt::format("{}: has {} x {} pixels, and a height map needs 2 x 2 at the least", shown(file),
                       image.cols(), image.rows()));
  const double spacing_m = t.size_m / static_cast<double>(image.cols() - 1);
  const double width_m = spacing_m * static_cast<double>(image.rows() - 1);
  const HeightMap map(t.height_m * seen_from_above(image), spacing_m, {-t.size_m / 2, -width_m / 2});
  check_cover(loaded, map, t.size_m, width_m);
  return map;
}

}  // namespace

Terrain terrain_of(const LoadedScenario& loaded) {
  const auto& terrain = loaded.scenario.terrain.type;
  if (const auto* image = std::get_if<ImageTerrain>(&terrain)) return image_terrain(loaded, *image);
  if (const auto* plane = std::get_if<PlaneTerrain>(&terrain))
    return TiltedPlane{0, plane->slope_x, plane->slope_y};
  constexpr double quarter = 1.5707963267948966;
  const auto& t = std::get<WavesTerrain>(terrain);
  return Waves{0, {{t.amplitude_m, t.length_m, 0, 0}, {t.amplitude_m, t.length_m, quarter, quarter}}};
}

}  // namespace incognita
