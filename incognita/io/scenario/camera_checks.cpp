#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/scenario_checks.hpp"
#include "incognita/io/scenario/settings.hpp"

namespace incognita {
namespace {

using List = std::vector<Contradiction>;

/// The message of make_camera() names the key.
void check_lens(const Scenario& s, List& found) {
  try {
    make_camera(s.camera);
  } catch (const std::invalid_argument& error) {
    const std::string what = error.what();
    Scenario copy = s;
    std::string key = "camera.model";
    for (const Setting& setting : list_settings(copy)) {
      const std::string mention = "camera " + name_in_section(setting.key) + " ";
      if (section_of(setting.key) == "camera" && what.starts_with(mention)) key = setting.key;
    }
    found.push_back({key, what});
  }
}

/// Refuses parameters of the other lens model, which would be ignored.
void check_model(const CameraSettings& camera, List& found) {
  const bool wide = camera.model == "wide-angle";
  const std::pair<const char*, double> strangers[] = {{"camera.kd1_per_px2", wide ? 0 : camera.kd1_per_px2},
                                                      {"camera.k1", wide ? camera.k1 : 0},
                                                      {"camera.k2", wide ? camera.k2 : 0},
                                                      {"camera.p1", wide ? camera.p1 : 0},
                                                      {"camera.p2", wide ? camera.p2 : 0},
                                                      {"camera.k3", wide ? camera.k3 : 0}};
  for (const auto& [key, value] : strangers) {
    if (value != 0) found.push_back({key, fmt::format("must be 0, camera.model being `{}`", camera.model)});
  }
}

}  // namespace

void check_camera(const Scenario& s, List& found) {
  check_model(s.camera, found);
  check_lens(s, found);
}

}  // namespace incognita
