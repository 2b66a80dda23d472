#include "incognita/app/loop/assemble_team.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "incognita/app/loop/assemble_ranges.hpp"
#include "incognita/app/loop/operator_assembly.hpp"
#include "incognita/app/loop/team_models.hpp"
#include "incognita/control/team_controller.hpp"
#include "incognita/decision/no_decision.hpp"
#include "incognita/decision/team_decision.hpp"
#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/recordings/clock_warnings.hpp"
#include "incognita/io/recordings/range_formats.hpp"
#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"
#include "incognita/world/replay/range_replay.hpp"
#include "incognita/world/room_clock.hpp"

namespace incognita {
namespace {

/// Attributes an exception of a component to its most relevant setting.
template <class Make>
auto made(const LoadedScenario& loaded, const std::string& key, const std::string& value, const Make& make) {
  try {
    return make();
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {} = {}: {}", loaded.source_of(key), key, value, error.what()));
  }
}

std::unique_ptr<Estimator> estimator_of(const LoadedScenario& loaded, const EstimatorSettings& team) {
  const Scenario& s = loaded.scenario;
  const BodyModel& first = team.bodies.front();
  made(loaded, "sensor.type", s.sensor.type, [&] {
    const std::string problem = incompatibility(first.motion, first.sensors.front().sensor);
    if (!problem.empty()) throw std::invalid_argument(problem);
    return 0;
  });
  return made(loaded, "estimator.linearization", word_of(s.planar.filter.linearization),
              [&] { return std::make_unique<SlamEstimator>(team); });
}

/// Makes the first `known` landmarks (all if negative) anchors.
void set_anchors(EstimatorSettings& team, const PointLandmarks& place, int known) {
  for (const auto& [identity, point] : place) {
    if (known >= 0 && static_cast<int>(team.anchors.size()) >= known) return;
    team.anchors.emplace(identity, point);
  }
}

TeamDecisionSettings decision_of(const Scenario& s) {
  TeamDecisionSettings out;
  out.decision = s.decision;
  out.tick_s = 1 / s.run.rate_hz;
  out.exploration = s.exploration;
  out.seed = static_cast<std::uint64_t>(s.run.seed);
  if (s.has_carried_camera()) {
    const ControllerSettings& can = s.controller;
    out.carrier = CarrierSettings{mount_of(s), can.max_speed_m_s, can.max_turn_rate_rad_s};
  }
  return out;
}

std::unique_ptr<Strategy> strategy_of(const Scenario& s, const EstimatorSettings& team) {
  if (!s.decides()) return std::make_unique<NoDecision>();
  return std::make_unique<TeamDecision>(team, decision_of(s));
}

/// Warns if the initial inverse depth does not fit the scene: such landmarks do not recover.
std::vector<std::string> notes_of(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  const PointsSettings& points = s.points;
  const bool all_known = points.known < 0 || points.known >= points.count;
  if (measures_distance(sensor_of(s)) || !points.file.empty() || all_known) return {};
  const double near_m =
      1 / (s.slam.initialization.inverse_depth_per_m + 2 * s.slam.initialization.sigma_inverse_depth_per_m);
  const double assumed_m = 1 / s.slam.initialization.inverse_depth_per_m,
               place_m = s.points.size_m.norm() / 2;
  if (assumed_m > place_m / 6 && near_m < place_m) return {};
  return {fmt::format(
      "landmark_initialization.inverse_depth_per_m = {} (from {}): a new landmark is first estimated {:.3g} m away, "
      "and the landmarks reach to {:.3g} m: set a prior that fits them, or the map may diverge",
      s.slam.initialization.inverse_depth_per_m,
      loaded.source_of("landmark_initialization.inverse_depth_per_m"), assumed_m, place_m)};
}

std::unique_ptr<World> world_of(const Scenario& s, const std::vector<SimulatedVehicle>& vehicles,
                                const Terrain& ground) {
  const auto seed = static_cast<std::uint64_t>(s.run.seed);
  if (!s.has_carried_camera()) {
    std::vector<OperatorActuator> actuators;
    for (std::size_t i = 0; s.operator_settings.holds && i < vehicles.size(); ++i)
      actuators.push_back(operator_of(s, i));
    return std::make_unique<TeamWorld>(vehicles, seed, std::move(actuators));
  }
  std::vector<CameraCarrier> carriers;
  for (std::size_t i = 0; i < vehicles.size(); ++i) carriers.push_back(carrier_of(s, i, ground));
  return std::make_unique<CarriedCameraWorld>(std::move(carriers), seed);
}

/// Identities that a sensor provides; nullopt: all. Anchors are recognized like the fiducial points of Section 6.3.1.
std::optional<std::set<std::int64_t>> names_of(const EstimatorSettings& team) {
  if (team.association.method == DataAssociationSettings::Method::known) return std::nullopt;
  std::set<std::int64_t> named;
  for (const auto& [identity, anchor] : team.anchors) named.insert(identity);
  return named;
}

Survey survey_of(const PointLandmarks& place) {
  Survey survey;
  survey.identified = true;
  for (const auto& [identity, point] : place) {
    survey.landmarks.push_back({identity, Eigen::Vector3d::Zero()});
    survey.landmarks.back().position.head(point.size()) = point;
  }
  return survey;
}

TeamAssembly simulated(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  const double period_s = 1 / s.run.rate_hz;
  const auto seed = static_cast<std::uint64_t>(s.run.seed);
  const PointLandmarks point_landmarks = point_landmarks_of(loaded);
  const Terrain ground = ground_of(loaded);
  EstimatorSettings team;
  team.filter = filter_of(s);
  team.health.max_sigma_position_m = s.planar.lost.max_sigma_position_m;
  team.association = s.planar.association;
  set_anchors(team, point_landmarks, s.points.known);
  if (s.points.known > static_cast<int>(point_landmarks.size()))
    throw InputError(fmt::format("{}: points.known = {}: there are {} landmarks",
                                 loaded.source_of("points.known"), s.points.known, point_landmarks.size()));
  std::vector<SimulatedVehicle> vehicles;
  std::vector<VehicleSteering> steering;
  for (std::size_t i = 0; i < vehicles_of(s); ++i) {
    team.bodies.push_back(member_of(s, i, ground));
    vehicles.push_back(simulated_vehicle(s, i, ground));
    steering.push_back(steering_of(loaded, i, ground));
  }
  auto estimator = estimator_of(loaded, team);
  const bool held = s.controller.law == ControllerSettings::Law::none && !s.controller.input.empty();
  auto controller = made(
      loaded, held ? "controller.input" : "controller.law",
      held ? fmt::format("[{}]", fmt::join(s.controller.input, ", ")) : word_of(s.controller.law), [&] {
        return std::make_unique<TeamController>(std::move(steering), period_s, s.operator_settings.holds);
      });
  auto points = std::make_unique<TeamSensor>(vehicles, point_landmarks, s.sensor.measures_vehicles, seed,
                                             names_of(team));
  auto association_truth = names_of(team) ? points->truth() : nullptr;
  return {{std::make_unique<FixedRateClock>(s.run.rate_hz, s.run.duration_s), world_of(s, vehicles, ground),
           std::move(points), std::move(estimator), strategy_of(s, team), std::move(controller)},
          team,
          notes_of(loaded),
          std::move(association_truth),
          names_of(team) ? Survey{} : survey_of(point_landmarks)};
}

/// The team with each robot starting at its motion-capture pose at time t.
EstimatorSettings recorded_team(const LoadedScenario& loaded, const std::vector<RangeRecording>& robots,
                                double t) {
  const Scenario& s = loaded.scenario;
  EstimatorSettings team;
  team.filter = filter_of(s);
  team.health.max_sigma_position_m = s.planar.lost.max_sigma_position_m;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const auto reference = true_position(robots[i], t);
    if (!reference || !reference->heading_rad)
      throw InputError(
          fmt::format("{}: recording.folder: where robot {} starts is not known: its ground truth is "
                      "wanted at t = {:.3f} s",
                      loaded.source_of("recording.folder"), i + 1, t));
    Scenario at_start = s;
    at_start.team_start.positions_m = {{reference->position.x(), reference->position.y(), 0}};
    at_start.team_start.headings_rad = {*reference->heading_rad};
    team.bodies.push_back(member_of(at_start, 0, {}));
  }
  return team;
}

TeamAssembly recorded(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  const auto robots = std::make_shared<const std::vector<RangeRecording>>(read_mrclam_team(find_data(
      s.recording.folder, loaded.file, loaded.source_of("recording.folder") + ": recording.folder")));
  auto clock = std::make_unique<RangeClock>(robots, s.run.duration_s);
  RangeClock glance(robots, s.run.duration_s);
  const Tick first = glance.next();
  if (!first)
    throw InputError(fmt::format("{}: run.duration_s = {}: nothing was seen by then",
                                 loaded.source_of("run.duration_s"), s.run.duration_s));
  EstimatorSettings team = recorded_team(loaded, *robots, first.t);
  std::vector<std::string> notes, warnings;
  for (std::size_t i = 0; i < robots->size(); ++i) {
    const RangeRecording& robot = (*robots)[i];
    notes.insert(notes.end(), robot.notes.begin(), robot.notes.end());
    for (const std::string& warning : clock_warnings(robot))
      warnings.push_back(fmt::format("robot {}: {}", i + 1, warning));
  }
  return {{std::move(clock), std::make_unique<RangeWorld>(robots),
           std::make_unique<RangeSensor>(robots, RangeSensorSettings{s.planar.sensor.max_range_m, Fixes::none,
                                                                     s.sensor.measures_vehicles}),
           estimator_of(loaded, team), std::make_unique<NoDecision>(),
           std::make_unique<TeamController>(std::vector<VehicleSteering>{}, 1)},
          team,
          std::move(notes),
          nullptr,
          survey_of(robots->front(), true),
          std::move(warnings)};
}

}  // namespace

TeamAssembly assemble_team(const LoadedScenario& loaded) {
  try {
    return loaded.scenario.is_recording() ? recorded(loaded) : simulated(loaded);
  } catch (const std::invalid_argument& error) {
    throw InputError(shown(loaded.file) + ": " + error.what());
  }
}

}  // namespace incognita
