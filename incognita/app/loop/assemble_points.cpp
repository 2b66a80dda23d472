#include <fmt/format.h>

#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "incognita/app/loop/assemblers.hpp"
#include "incognita/app/loop/body_models.hpp"
#include "incognita/app/loop/point_map_truth.hpp"
#include "incognita/app/loop/world_outline.hpp"
#include "incognita/control/steering_controller.hpp"
#include "incognita/decision/decision.hpp"
#include "incognita/decision/no_decision.hpp"
#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/world/fixed_rate_clock.hpp"

namespace incognita {
namespace {

/// Makes the first `known` landmarks (all if negative) anchors.
void set_anchors(EstimatorSettings& team, const PointLandmarks& place, int known) {
  for (const auto& [identity, point] : place) {
    if (known >= 0 && static_cast<int>(team.anchors.size()) >= known) return;
    team.anchors.emplace(identity, point);
  }
}

std::unique_ptr<Strategy> strategy_of(const Scenario& s, const SlamEstimator& estimator) {
  if (!s.decides()) return std::make_unique<NoDecision>();
  return decide_for(estimator, active_settings_of(s));
}

/// Warns if the initial inverse depth does not fit the scene: such landmarks do not recover.
std::vector<std::string> notes_of(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  const PointsSettings& points = s.points;
  const bool all_known = points.known < 0 || points.known >= points.count;
  if (measures_distance(sensor_of(s)) || !points.file.empty() || all_known || depth_lines_of(s)) return {};
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

std::unique_ptr<MapTruth> point_truth_of(const PointLandmarks& place, const EstimatorSettings& team,
                                         std::shared_ptr<const AssociationTruth> associations) {
  std::vector<std::int64_t> known;
  for (const auto& [identity, anchor] : team.anchors) known.push_back(identity);
  return std::make_unique<PointMapTruth>(place, known, std::move(associations));
}

EstimatorSettings estimator_settings(const LoadedScenario& loaded, const PointLandmarks& place,
                                     const Terrain& ground) {
  const Scenario& s = loaded.scenario;
  if (s.points.known > static_cast<int>(place.size()))
    throw InputError(fmt::format("{}: points.known = {}: there are {} landmarks",
                                 loaded.source_of("points.known"), s.points.known, place.size()));
  EstimatorSettings team;
  team.filter = filter_of(s);
  team.health = s.planar.health;
  team.association = s.planar.association;
  team.pruning = s.planar.pruning;
  team.depth_lines = depth_lines_of(s);
  team.wanted_visible = s.slam.map.wanted_visible;
  set_anchors(team, place, s.points.known);
  for (std::size_t i = 0; i < vehicles_of(s); ++i) team.bodies.push_back(member_of(s, i, ground));
  return team;
}

std::unique_ptr<Controller> controller_of(const LoadedScenario& loaded, const Terrain& ground) {
  const Scenario& s = loaded.scenario;
  std::vector<BodyControl> bodies;
  for (std::size_t i = 0; i < vehicles_of(s); ++i) bodies.push_back(body_control_of(loaded, i, ground));
  return attributed_to(loaded, "controller.law", word_of(s.controller.law), [&] {
    return std::make_unique<SteeringController>(std::move(bodies), 1 / s.run.rate_hz);
  });
}

RunInfo info_of_points(const LoadedScenario& loaded, const Terrain& ground) {
  const Eigen::Vector2d shown_m(20, 20);  // of an unbounded ground, on each side of the origin
  const Scenario& s = loaded.scenario;
  const MotionTraits& motion = s.motion();
  RunInfo info;
  put_scenario(loaded, info);
  info.body = motion.in_space() ? "camera" : "vehicle";
  info.bodies = static_cast<int>(vehicles_of(s));
  info.inputs = input_names(s.has_carried_camera() ? motion_traits<TerrainVehicle> : motion);
  info.steered_m = steered_point(s);
  info.terrain = terrain_grid(ground, -shown_m, shown_m);
  return info;
}

}  // namespace

Assembly assemble_points(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  const PointLandmarks place = point_landmarks_of(loaded);
  const Terrain ground = ground_of(loaded);
  const EstimatorSettings settings = estimator_settings(loaded, place, ground);
  const auto identified = names_of(settings);
  auto estimator = point_estimator(loaded, settings);
  auto strategy = strategy_of(s, *estimator);
  auto controller = controller_of(loaded, ground);
  std::vector<SimulatedVehicle> vehicles;
  for (std::size_t i = 0; i < vehicles_of(s); ++i) vehicles.push_back(simulated_vehicle(s, i, ground));
  const auto seed = static_cast<std::uint64_t>(s.run.seed);
  const auto associations = std::make_shared<AssociationTruth>();
  Assembly out;
  out.info = info_of_points(loaded, ground);
  if (identified)
    out.association_truth = associations;
  else
    out.info.survey = survey_of(place);
  out.notes = notes_of(loaded);
  out.anchors = static_cast<int>(settings.anchors.size());
  out.parts = {std::make_unique<FixedRateClock>(s.run.rate_hz, s.run.duration_s),
               std::make_unique<SimulatedWorld>(point_world(vehicles, seed)),
               std::make_unique<SensorSet>(point_sensors(
                   vehicles, {place, s.sensor.measures_vehicles, identified}, seed, associations)),
               std::move(estimator),
               std::move(strategy),
               std::move(controller),
               point_truth_of(place, settings, identified ? associations : nullptr)};
  return out;
}

}  // namespace incognita
