// A scenario: all settings of a run as plain structs.
#pragma once

#include <cstdint>
#include <string>

#include "incognita/control/settings.hpp"
#include "incognita/decision/settings.hpp"
#include "incognita/io/scenario/team_scenario.hpp"
#include "incognita/slam/features/settings.hpp"
#include "incognita/slam/points/planar_settings.hpp"
#include "incognita/world/settings.hpp"

namespace incognita {

struct RunSettings {
  std::string world = "room";     ///< `room` (rendered, closed loop), `points` (simulated) or `recording`
  std::string sensor = "camera";  ///< `camera`, `range-bearing`; with `points` also e.g. `bearing`, `stereo`
  std::int64_t seed = 1;
  double duration_s = 60;     ///< upper limit; a recording may end earlier
  double rate_hz = 30;        ///< frame rate of simulations and of recordings without time stamps
  bool observability = true;  ///< whether the observability of the filter is analyzed
};

struct CameraSettings {
  std::string model = "wide-angle";  ///< `wide-angle` (5.26) or `pinhole` (OpenCV's k1 k2 p1 p2 k3)
  int width_px = 320;
  int height_px = 240;
  double fu_px = 195;
  double fv_px = 195;
  double u0_px = 159.5;
  double v0_px = 119.5;
  double kd1_per_px2 = 0;                         ///< `wide-angle`
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;  ///< `pinhole`
};

struct RecordingSettings {
  std::string folder;             ///< relative to the data folder
  std::string format = "auto";    ///< `auto`, `images`, `tum`, `euroc`, `acfr`, `mrclam`, `tables`
  std::string pattern;            ///< `images`: shell pattern of file names; empty: all
  bool check_calibration = true;  ///< `euroc`: compare the camera with the recorded calibration
  int robot = 1;                  ///< `mrclam`: which of the five robots
  bool team = false;              ///< `mrclam`: all five robots in one belief
};

struct Scenario {
  RunSettings run;
  CameraSettings camera;
  RecordingSettings recording;
  StartSettings start;
  CameraSlamSettings slam;
  DecisionSettings decision;
  ExplorationSettings exploration;
  PlanarSlamSettings planar;
  ControlSettings control;
  OperatorSettings operator_settings;
  RoomSettings room;
  TeamScenario team;
};

}  // namespace incognita
