#include "incognita/io/team_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "incognita/io/team_setting_list.hpp"

namespace incognita {
namespace {

using List = std::vector<Contradiction>;

void check_recorded(const Scenario& s, List& found) {
  if (s.recording.folder.empty())
    found.push_back({"recording.folder", "must name the recording of the team"});
  if (s.recording.format != "mrclam" && s.recording.format != "auto")
    found.push_back({"recording.format", "must be `mrclam` or `auto`: a recording of a team"});
  if (s.run.sensor != "range-bearing")
    found.push_back({"run.sensor", "must be `range-bearing`: so the recorded teams see"});
  if (s.planar.vehicle.model != "differential-drive")
    found.push_back({"vehicle.model", "must be `differential-drive`: so the recorded teams move"});
}

/// A list with one number stands for all the same.
void check_length(const char* key, std::size_t size, std::size_t wanted, const char* what, List& found) {
  if (size == 1 || size == wanted) return;
  found.push_back({key, fmt::format("must have 1 number or {}, {}, and has {}", wanted, what, size)});
}

void check_starts(const Scenario& s, List& found) {
  const TeamStartSettings& start = s.team.start;
  const std::size_t vehicles = start.positions_m.size();
  constexpr std::size_t most = 1000;
  if (vehicles == 0 || vehicles > most)
    found.push_back(
        {"team.positions_m", fmt::format("must have 1 to {} starts, one for each vehicle", most)});
  check_length("team.headings_rad", start.headings_rad.size(), vehicles, "one for each vehicle", found);
  const std::size_t offsets = s.team.path.offsets_m.size();
  if (offsets != 0 && offsets != vehicles)
    found.push_back({"path.offsets_m", fmt::format("must have {}, one for each vehicle, or none, and has {}",
                                                   vehicles, offsets)});
}

/// What (5.1) and (5.9) weigh, and what is held, by what the motion has.
void check_gains(const Scenario& s, List& found) {
  const std::string& model = s.planar.vehicle.model;
  const bool line = model == "monobot", body = model == "free-camera";
  const std::size_t inputs = line   ? 1
                             : body ? 6
                                    : 2,
                    axes = line ? 1 : 2,
                    regulated = line   ? 1
                                : body ? 12
                                       : 2;
  const SteerChoice& c = s.team.steer;
  check_length("steer.input", c.input.size(), inputs, "one for each input of the motion", found);
  check_length("steer.gain_per_s", c.gain_per_s.size(), axes, "one for each axis", found);
  check_length("steer.weight_state", c.weight_state.size(), regulated,
               "one for each number that is regulated", found);
  check_length("steer.weight_input", c.weight_input.size(), inputs, "one for each input of the motion",
               found);
}

void check_path(const Scenario& s, List& found) {
  if (s.team.steer.law == "none" || s.team.steer.law == "active") return;
  const PathChoice& p = s.team.path;
  if (p.kind == "way-points" && p.points_m.empty())
    found.push_back({"path.points_m", "must have way-points, path.kind being `way-points`"});
  if (p.kind == "file" && p.file.empty())
    found.push_back({"path.file", "must name a table, path.kind being `file`"});
  if (p.kind == "circle" && p.rate_rad_s == 0)
    found.push_back({"path.rate_rad_s", "must not be 0: on a circle one goes round"});
}

void check_plant(const Scenario& s, List& found) {
  const VehicleSettings& v = s.planar.vehicle;
  if (s.team.plant.motion == "terrain" && (v.sensor_forward_m != 0 || v.sensor_left_m != 0))
    found.push_back({"plant.motion",
                     "must be `as-believed` unless vehicle.sensor_forward_m and "
                     "vehicle.sensor_left_m are 0: on uneven ground the middle of the axle is "
                     "followed"});
}

void check_ticks(const Scenario& s, List& found) {
  constexpr double most_ticks = 1e9;
  if (s.run.duration_s * s.run.rate_hz > most_ticks)
    found.push_back({"run.duration_s", fmt::format("must make at most {:g} ticks, run.rate_hz being {}",
                                                   most_ticks, s.run.rate_hz)});
}

}  // namespace

void check_team(const Scenario& s, List& found) {
  if (s.run.world == "recording") return check_recorded(s, found);
  check_ticks(s, found);
  check_starts(s, found);
  check_gains(s, found);
  check_path(s, found);
  check_plant(s, found);
  if (s.run.sensor == "camera" || s.run.sensor == "stereo") check_camera(s, found);
}

}  // namespace incognita
