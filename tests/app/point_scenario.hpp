// Scenarios of point landmarks for tests: any motion model with any sensor and any control law.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/app/loop/loop.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/models/any_sensor.hpp"
#include "tests/merged_toml.hpp"
#include "tests/scratch.hpp"

namespace incognita::testing {

/// The last snapshot of a run and the number of its ticks.
struct Ran {
  int ticks = 0;
  Snapshot last;
};

inline Ran run(const LoadedScenario& loaded) {
  Assembly assembly = assemble(loaded);
  Ran ran;
  run_loop(
      assembly.parts, [&](const Snapshot& s) { ran.last = s, ++ran.ticks; },
      [](const Tick&) { return true; });
  return ran;
}

inline LoadedScenario load(const std::string& text, const std::vector<std::string>& sets = {}) {
  const testing::Scratch scratch;
  return load_scenario(scratch.write("s.toml", testing::merged_toml(text)).string(), sets);
}

inline std::string complaint(const std::string& text, const std::vector<std::string>& sets = {}) {
  try {
    run(load(text, sets));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// A motion model, a sensor and a control law by their names in a scenario.
struct ModelChoice {
  std::string motion, sensor, law;
  const MotionTraits& traits() const { return motion_traits_of(motion); }
  bool line() const { return traits().on_line(); }
  bool plane() const { return traits().on_plane(); }
  bool body() const { return traits().in_space(); }
  /// A camera has one of three lenses.
  bool is_lens() const { return sensor == "wide-angle" || sensor == "pinhole" || sensor == "fisheye"; }
  std::string sensor_word() const { return is_lens() ? "camera" : sensor; }
  bool has_parameter(const std::string& key) const {
    for (const MotionEntry& entry : registered_motions())
      if (entry.traits.name == motion)
        for (const ParameterInfo& p : entry.parameters)
          if (p.quantity.key() == key) return true;
    return false;
  }

  bool can_measure() const {
    return incompatibility(make_motion(motion), make_sensor(sensor_word(), traits())).empty();
  }
  /// A car cannot turn at rest, and the regulator at rest does not model slopes.
  bool can_steer() const {
    const bool turns = plane() && traits().has_input("turn_rate");
    if (law == "tracking") return !traits().has_input("steering");
    if (law == "lqg") return line() || turns || body();
    return true;
  }
};

inline std::string control_of(const ModelChoice& c) {
  const std::string law = "[controller]\nlaw = \"" + c.law + "\"\n";
  if (c.law == "none")
    return law + (c.line()   ? "input = [0.1]\n"
                  : c.body() ? "input = [0.1, 0, 0, 0, 0.1, 0]\n"
                             : "input = [0.5, 0.1]\n");
  if (c.law == "active") return law;
  if (c.line() || c.law == "lqg")
    return law + "[path]\ntype = \"point\"\nposition_m = " +
           (c.line()   ? "[2, 0, 0]\n"
            : c.body() ? "[2, 0.5, 1]\n"
                       : "[2, 0.5, 0]\n");
  if (c.body()) return law + "[path]\ntype = \"back-and-forth\"\ncenter_m = [0, 0, 1]\nradius_m = 1.5\n";
  return law + "[path]\ntype = \"circle\"\nradius_m = 4\nrate_rad_s = 0.12\n";
}

inline std::string text_of(const ModelChoice& c) {
  std::string text = "[run]\nrate_hz = 20\nduration_s = 3\n[world]\ntype = \"points\"\n[sensor]\ntype = \"" +
                     c.sensor_word() + "\"\n[vehicle]\nmodel = \"" + c.motion + "\"\n";
  for (const auto& [key, value] : {std::pair{"sensor_forward_m", "0.4"},
                                   {"sensor_left_m", "0"},
                                   {"wheelbase_m", "1"},
                                   {"wheel_left_m", "0.3"}})
    if (c.has_parameter(key)) text += std::string(key) + " = " + value + "\n";
  if (c.sensor == "wide-angle") text += "[camera]\nkd1_per_px2 = 9e-6\n";
  if (c.sensor == "pinhole") text += "[camera]\nmodel = \"pinhole\"\n";
  if (c.sensor == "fisheye") text += "[camera]\nmodel = \"fisheye\"\nk1 = 0.0035\nk4 = 0.0002\n";
  if (!c.is_lens() && !measures_distance(make_sensor(c.sensor, c.traits())))
    text += "[landmark_initialization]\ninverse_depth_per_m = 0.15\nsigma_inverse_depth_per_m = 0.15\n";
  text += c.body() ? "[start]\npositions_m = [[-1.5, 0, 1]]\n" : "[start]\npositions_m = [[-2, 0, 0]]\n";
  return text + "[points]\ncount = 40\nsize_m = [12, 12, 2.5]\nknown = 8\n" + control_of(c);
}

using Words = std::tuple<std::string, std::string, const char*>;

/// A vehicle that follows a circle by a range-bearing sensor.
inline const std::string drive = text_of({"differential-drive", "range-bearing", "feedback-linearization"});

/// A camera that a vehicle carries over uneven ground, thesis Section 6.4.
inline const std::string carried =
    "[world]\ntype = \"points\"\n[sensor]\ntype = \"camera\"\n[run]\nrate_hz = 15\n"
    "duration_s = 4\n[vehicle]\nmodel = \"free-camera\"\n[plant]\nmotion = \"terrain\"\n"
    "[terrain]\namplitude_m = 0.1\nlength_m = 3\n[camera]\nkd1_per_px2 = 9e-6\n[points]\n"
    "count = 31\nsize_m = [6, 6, 2.5]\nknown = 6\n";

}  // namespace incognita::testing
