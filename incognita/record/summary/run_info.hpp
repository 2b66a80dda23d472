// What is known of a run before it starts.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "incognita/record/summary/map_survey.hpp"

namespace incognita {

using SummaryValue = std::variant<bool, std::int64_t, double, std::string>;

/// The pinhole part of a camera model, px; the center of the first pixel is (0,0).
struct CameraIntrinsics {
  int width = 0, height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
};

/// Axis-aligned in the world, m.
struct BoxOutline {
  Eigen::Vector3d min{0, 0, 0}, max{0, 0, 0};
};

struct RoomOutline {
  BoxOutline inside;
  std::vector<BoxOutline> boxes;
};

/// Heights of uneven ground at the points of a grid.
struct TerrainGrid {
  Eigen::Vector2d origin_m{0, 0};  ///< world: the first point
  double step_m = 0;
  int columns = 0, rows = 0;      ///< along x, along y
  std::vector<double> heights_m;  ///< world z, rows one after the other
};

struct RunInfo {
  std::string name;            ///< of the scenario
  std::string effective_toml;  ///< all settings in force with their sources
  std::int64_t seed = 0;
  std::string version;
  std::string ate_alignment = "none";  ///< `none` if anchors fix the frame, `sim3` if the scale is free
  bool truth_recorded = false;         ///< a recording with truth, even if the first frames lack it
  std::string body = "camera";         ///< whose pose is estimated: `camera` or `vehicle`
  int bodies = 1;
  std::optional<double> rate_hz = {};        ///< frames per second; of a recording the mean
  std::optional<CameraIntrinsics> camera{};  ///< of each camera; none without
  std::optional<RoomOutline> room = {};      ///< of the rendered room
  std::optional<TerrainGrid> terrain = {};   ///< none on the plane z = 0
  Eigen::Vector2d steered_m{0, 0};           ///< controlled point, ahead and left of the body's origin
  std::vector<std::string> inputs = {};      ///< of each body: names with units, e.g. "speed_m_s"
  int patch_size_px = 11;                    ///< side of the matched patches, for drawing
  std::vector<std::string> warnings = {};    ///< likely problems of the input
  Survey survey = {};                        ///< true landmarks, for evaluation; empty if unknown
  std::vector<std::pair<std::string, SummaryValue>> extra;  ///< further fields of summary.json
};

/// Whether estimate and truth can be compared without alignment.
bool same_frame_as_truth(const RunInfo& info);
/// Whether lengths of the estimate are in m; else their unit is arbitrary.
bool scale_is_known(const RunInfo& info);

}  // namespace incognita
