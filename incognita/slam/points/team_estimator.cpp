#include "incognita/slam/points/team_estimator.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

#include "incognita/belief/iterated_update.hpp"
#include "incognita/math/gaussian.hpp"
#include "incognita/models/planar_frame.hpp"
#include "incognita/slam/mapper/stage_clock.hpp"
#include "incognita/slam/points/team_association.hpp"
#include "incognita/slam/points/team_measurements.hpp"
#include "incognita/slam/points/team_motion.hpp"
#include "incognita/slam/points/team_status.hpp"

namespace incognita {
namespace {

double distance_of(const LinearizedMeasurement& measurement, const SmallMatrix& S) {
  return measurement.residual.dot(S.llt().solve(SmallVector(measurement.residual)));
}

/// Chi-square gate by the rows of a measurement; open for a probability of 1.
class Gate {
 public:
  explicit Gate(double probability) : shut_(probability < 1) {
    for (int rows = 1; shut_ && rows <= max_measurement_rows; ++rows)
      most_[static_cast<std::size_t>(rows)] = chi_square_quantile(probability, rows);
  }
  bool has(double distance, int rows) const {
    return !shut_ || distance <= most_[static_cast<std::size_t>(rows)];
  }

 private:
  bool shut_;
  std::array<double, max_measurement_rows + 1> most_{};
};

}  // namespace

TeamEstimator::TeamEstimator(TeamSettings settings) : settings_(std::move(settings)) {
  const std::string problem = validate_team_settings(settings_);
  if (!problem.empty()) throw std::invalid_argument(problem);
}

namespace {

AnyBelief empty_belief(const TeamFilterSettings& filter) {
  if (filter.form == "information") return AnyBelief(InformationBelief());
  return AnyBelief(Belief(
      64, filter.decorrelate == "map-linear" ? MapCorrelations::block_diagonal : MapCorrelations::full));
}

/// Adds the vehicle and, for a map in its frame, the pose of the world relative to it.
void add_vehicle(TeamEstimate& e, const TeamMember& member, const SmallVector& start, double t,
                 bool in_vehicle_frame) {
  const SmallMatrix P = member.start_sigmas.cwiseAbs2().asDiagonal();
  TeamVehicle& vehicle = e.vehicles.emplace_back();
  vehicle.t = t;
  if (in_vehicle_frame) {
    const planar::FramedPose world = planar::inverse(planar::Pose<double>(start));
    vehicle.block =
        e.belief.add_vehicle(planar::pose_chart, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero());
    e.world =
        e.belief.add_vehicle(planar::pose_chart, world.pose, world.by_frame * P * world.by_frame.transpose());
  } else {
    vehicle.block = e.belief.add_vehicle(chart_of(member.motion), start, P);
  }
  vehicle.prediction = e.belief.mean(vehicle.block);
}

double start_time(const TeamMember& member, const BodyObservation& view, double t) {
  if (member.start_time == TeamMember::StartTime::first_fix) return view.fixes.front().t;
  if (member.start_time == TeamMember::StartTime::first_reading && !view.odometry.empty())
    return std::min(t, view.odometry.front().t);
  return t;
}

bool waits_for_fix(const TeamMember& member, const BodyObservation& view) {
  return member.start_time == TeamMember::StartTime::first_fix && view.fixes.empty();
}

}  // namespace

void TeamEstimator::start(TeamEstimate& e, const Observation& observation, const Tick& tick) const {
  for (std::size_t i = 0; i < settings_.members.size(); ++i)
    if (waits_for_fix(settings_.members[i], observation.bodies[i])) {
      e.status.reason = "waiting for the first position fix";
      return;
    }
  const bool watched = e.belief.keeps_trace();
  e.belief = empty_belief(settings_.filter);
  e.vehicles.clear();
  e.landmarks.clear();
  e.world.reset();
  e.belief.keep_trace(watched);
  for (const auto& [identity, position] : settings_.anchors) e.anchors[identity] = {position, 0};
  for (std::size_t i = 0; i < settings_.members.size(); ++i) {
    const TeamMember& member = settings_.members[i];
    SmallVector at = member.start;
    if (member.start_time == TeamMember::StartTime::first_fix)
      at.head<2>() = observation.bodies[i].fixes.front().position;
    add_vehicle(e, member, at, start_time(member, observation.bodies[i], tick.t),
                settings_.filter.map_frame == "vehicle");
  }
  e.started = true;
  e.status = {TrackingState::tracking, "", 0};
}

namespace {

void note(TeamEstimate& e, int vehicle, bool of_vehicle, std::int64_t identity, const SmallVector& z,
          const TeamSettings& settings) {
  const bool anchor = !of_vehicle && settings.anchors.count(identity) > 0;
  e.matches.push_back({vehicle, of_vehicle, anchor, identity, z, {}, {}, MatchOutcome::not_searched});
}

/// Linearizes a detection of an anchor, a mapped landmark or a vehicle, and gates it.
void linearize_and_gate(TeamEstimate& e, std::size_t index, const Gate& gate, const TeamSettings& settings) {
  Match& match = e.matches[index];
  Inliers& inliers = e.inliers;
  if (!is_usable(settings.members[static_cast<std::size_t>(match.vehicle)].sensor, match.measured)) return;
  const auto at =
      linearize_detection(e, match.vehicle, match.of_vehicle, {match.identity, match.measured}, settings);
  if (!at) return;
  match.predicted = at->predicted;
  e.belief.innovation_covariance({&at->linearized, 1}, inliers.S);
  match.innovation_cov = inliers.S;
  const bool inside = gate.has(distance_of(at->linearized, match.innovation_cov), at->linearized.rows());
  match.outcome = inside ? MatchOutcome::matched : MatchOutcome::outlier;
  if (!inside) return;
  inliers.indices.push_back(index);
  inliers.measurements.push_back(at->linearized);
}

/// Whether a detection of the same landmark by the same vehicle precedes `end` in this tick's matches.
bool was_measured(const TeamEstimate& e, int vehicle, std::int64_t identity, std::size_t end) {
  return std::any_of(e.matches.begin(), e.matches.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](const Match& match) {
                       return match.vehicle == vehicle && !match.of_vehicle && match.identity == identity;
                     });
}

/// Association by identity, one detection per landmark. Detections without identity are ignored.
void associate_by_identity(TeamEstimate& e, int vehicle, const BodyObservation& view, const Gate& gate,
                           const TeamSettings& settings) {
  for (const PointDetection& s : view.landmarks) {
    note(e, vehicle, false, s.identity, s.z, settings);
    const std::size_t index = e.matches.size() - 1;
    if (was_measured(e, vehicle, s.identity, index)) continue;
    linearize_and_gate(e, index, gate, settings);
    const bool known = e.matches[index].anchor || e.landmarks.count(s.identity) > 0;
    if (!known && s.identity != Detection::unknown) e.inliers.candidates.push_back(index);
  }
}

/// Association by position. Two vehicles may detect the same new landmark, and the second detection can be
/// associated only once the landmark is in the map: therefore one vehicle per tick initializes landmarks.
void associate_by_position(TeamEstimate& e, int vehicle, const BodyObservation& view, const Gate& gate,
                           const TeamSettings& settings) {
  const ViewAssociation taken = associate_view(e, vehicle, view.landmarks, settings);
  e.association_capped = e.association_capped || taken.capped;
  const std::size_t first = e.matches.size();
  for (std::size_t s = 0; s < view.landmarks.size(); ++s)
    note(e, vehicle, false, taken.landmarks[s], view.landmarks[s].z, settings);
  for (const std::size_t s : taken.order) linearize_and_gate(e, first + s, gate, settings);
  if (!e.inliers.candidates.empty()) return;
  for (const std::size_t s : taken.candidates) e.inliers.candidates.push_back(first + s);
}

/// Associates and gates all detections of the tick.
void associate(TeamEstimate& e, const Observation& observation, const TeamSettings& settings) {
  const Gate gate(settings.filter.gate_probability);
  e.inliers.indices.clear();
  e.inliers.measurements.clear();
  e.inliers.candidates.clear();
  e.association_capped = false;
  const auto go = settings.association.method == "known" ? associate_by_identity : associate_by_position;
  for (std::size_t i = 0; i < observation.bodies.size(); ++i) {
    const int vehicle = static_cast<int>(i);
    go(e, vehicle, observation.bodies[i], gate, settings);
    for (const PointDetection& s : observation.bodies[i].vehicles) {
      note(e, vehicle, true, s.identity, s.z, settings);
      linearize_and_gate(e, e.matches.size() - 1, gate, settings);
    }
  }
  e.capped_associations += e.association_capped;
}

/// The inliers linearized at the belief's current means; without parts where a measurement is not defined.
std::vector<LinearizedMeasurement> relinearized_measurements(const TeamEstimate& e,
                                                             const TeamSettings& settings) {
  std::vector<LinearizedMeasurement> measurements(e.inliers.measurements.size());
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const Match& match = e.matches[e.inliers.indices[i]];
    const auto at =
        linearize_detection(e, match.vehicle, match.of_vehicle, {match.identity, match.measured}, settings);
    if (at) measurements[i] = at->linearized;
  }
  return measurements;
}

/// The blocks that the measurements depend on, each once.
std::vector<BlockId> blocks_of(const std::vector<LinearizedMeasurement>& measurements) {
  std::set<BlockId> blocks;
  for (const LinearizedMeasurement& measurement : measurements)
    for (int i = 0; i < measurement.part_count; ++i)
      blocks.insert(measurement.parts[static_cast<std::size_t>(i)].block);
  return {blocks.begin(), blocks.end()};
}

int& detection_count_of(TeamEstimate& e, const Match& match) {
  return match.anchor ? e.anchors.at(match.identity).detection_count
                      : e.landmarks.at(match.identity).detection_count;
}

void correct(TeamEstimate& e, const TeamSettings& settings) {
  const Inliers& inliers = e.inliers;
  if (inliers.measurements.empty()) return;
  if (settings.filter.linearization == "iterated") {
    const auto again = [&](const AnyBelief&) { return relinearized_measurements(e, settings); };
    const IterationSettings until{.max_iterations = 20, .tolerance_sigmas = 1e-3};
    const IterationReport report = update_iterated(e.belief, blocks_of(inliers.measurements), again, until);
    e.update = report.update;
    e.iterations = report.iterations;
    e.unconverged_updates += !report.converged;
  } else {
    e.update = e.belief.update(inliers.measurements);
  }
  const bool done = e.update.outcome == UpdateReport::Outcome::updated;
  e.refused = e.refused || e.update.outcome == UpdateReport::Outcome::singular;
  constexpr double forgetting = 0.9;
  e.recent_nis = forgetting * e.recent_nis + (done ? e.update.nis : 0);
  e.recent_rows = forgetting * e.recent_rows + (done ? e.update.rows : 0);
  for (const std::size_t i : inliers.indices) {
    Match& match = e.matches[i];
    match.outcome = done ? MatchOutcome::matched : MatchOutcome::outlier;
    if (done && !match.of_vehicle) ++detection_count_of(e, match);
  }
  e.matched = done ? static_cast<int>(inliers.indices.size()) : 0;
}

std::int64_t new_number(TeamEstimate& e) {
  if (!e.anchors.empty()) e.next_number = std::max(e.next_number, e.anchors.rbegin()->first + 1);
  return e.next_number++;
}

void initialize_landmarks(TeamEstimate& e, const TeamSettings& settings) {
  const bool named = settings.association.method == "known";
  for (const std::size_t index : e.inliers.candidates) {
    Match& match = e.matches[index];
    const std::int64_t identity = named ? match.identity : new_number(e);
    if (e.landmarks.count(identity) > 0) continue;  // already initialized by another vehicle
    if (!initialize_landmark(e, match.vehicle, {identity, match.measured}, settings)) continue;
    match.identity = identity;
    match.outcome = MatchOutcome::initialized;
  }
}

}  // namespace

void TeamEstimator::update(TeamEstimate& e, const Command&, const Observation& observation,
                           const Tick& tick) const {
  if (observation.bodies.size() != settings_.members.size())
    throw std::invalid_argument("observations of " + std::to_string(observation.bodies.size()) +
                                " vehicles were given to an estimator of " +
                                std::to_string(settings_.members.size()));
  StageClock stage(e.timing_ms);
  e.matches.clear();
  e.fixes.clear();
  e.matched = e.iterations = 0;
  e.update = {};
  e.refused = false;
  if (!e.started) start(e, observation, tick);
  if (!e.started) return;
  for (std::size_t i = 0; i < e.vehicles.size(); ++i) {
    e.vehicles[i].wheels = observation.bodies[i].wheels;
    predict_vehicle(e, i, observation.bodies[i], tick.t, settings_);
  }
  stage.mark("predict");
  associate(e, observation, settings_);
  stage.mark("associate");
  correct(e, settings_);
  stage.mark("update");
  initialize_landmarks(e, settings_);
  convert_converged_inverse_depths(e, settings_);
  stage.mark("births");
  recenter_map(e);
  if (settings_.filter.decorrelate == "everything") e.belief.decorrelate(Belief::Scope::everything);
  if (settings_.filter.decorrelate == "map") e.belief.decorrelate(Belief::Scope::map);
  stage.mark("decorrelate");
  update_poses(e);
  e.status = assess(e, settings_);
  stage.mark("poses");
  refresh_entropy(e, tick.t);
  stage.mark("entropy");
}

void TeamEstimator::refresh_entropy(TeamEstimate& e, double t) const {
  const double period_s = entropy_period_s(e.belief.errors());
  if (e.entropy_t && t - *e.entropy_t < period_s) return;
  e.entropy = entropies(e);
  e.entropy_t = t;
}

namespace {

/// State and covariance of a vehicle in the world.
void express_in_world(const TeamEstimate& e, TeamVehicle& vehicle) {
  if (!e.world) {
    vehicle.state = e.belief.mean(vehicle.block);
    vehicle.state_covariance = e.belief.covariance(vehicle.block);
    return;
  }
  const planar::FramedPose at = planar::in_frame(planar::Pose<double>(e.belief.mean(*e.world)),
                                                 planar::Pose<double>(e.belief.mean(vehicle.block)));
  const SmallMatrix cross =
      at.by_pose * e.belief.covariance(vehicle.block, *e.world) * at.by_frame.transpose();
  vehicle.state = at.pose;
  vehicle.state_covariance = at.by_frame * e.belief.covariance(*e.world) * at.by_frame.transpose() +
                             at.by_pose * e.belief.covariance(vehicle.block) * at.by_pose.transpose() +
                             cross + cross.transpose();
}

}  // namespace

void TeamEstimator::update_poses(TeamEstimate& e) const {
  for (std::size_t i = 0; i < e.vehicles.size(); ++i) {
    TeamVehicle& vehicle = e.vehicles[i];
    express_in_world(e, vehicle);
    const SmallMatrix J = pose_jacobian(settings_.members[i].motion, vehicle.state);
    vehicle.pose = pose_of(settings_.members[i].motion, vehicle.state);
    vehicle.pose_covariance = J * vehicle.state_covariance * J.transpose();
  }
}

}  // namespace incognita
