#include "incognita/slam/points/planar_estimator.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

#include "incognita/belief/iterated_update.hpp"
#include "incognita/models/planar_frame.hpp"
#include "incognita/models/range_bearing.hpp"
#include "incognita/slam/mapper/stage_clock.hpp"
#include "incognita/slam/points/planar_looks.hpp"
#include "incognita/slam/points/planar_motion.hpp"

namespace incognita {
namespace {

void expect_word(const char* setting, const std::string& word,
                 std::initializer_list<std::string_view> words) {
  if (std::find(words.begin(), words.end(), word) != words.end()) return;
  std::string all;
  for (const std::string_view one : words) all += (all.empty() ? "`" : ", `") + std::string(one) + "`";
  throw std::invalid_argument(std::string(setting) + " = `" + word + "`: must be one of " + all);
}

void check(const PlanarSlamSettings& s) {
  expect_word("vehicle.model", s.vehicle.model, {"ackermann", "differential-drive"});
  expect_word("vehicle_filter.lineariser", s.filter.lineariser,
              {"analytic", "iterated", "unscented-vehicle", "first-estimate"});
  expect_word("vehicle_filter.map_frame", s.filter.map_frame, {"world", "vehicle"});
  expect_word("vehicle_filter.decorrelate", s.filter.decorrelate,
              {"nothing", "everything", "map", "map-linear"});
  expect_word("association.method", s.association.method, {"known", "nearest", "joint"});
  if (const auto conflict = conflict_in(s.filter))
    throw std::invalid_argument(std::string(conflict->key) + ": " + conflict->why);
}

/// When the first thing was told: where it starts from, and drives on.
double first_time(const Observation& seen, const Tick& tick) {
  return seen.odometry.empty() ? tick.t : std::min(tick.t, seen.odometry.front().t);
}

}  // namespace

PlanarEstimator::PlanarEstimator(const PlanarSlamSettings& settings,
                                 std::vector<std::int64_t> anchor_identities)
    : settings_(settings), anchor_identities_(std::move(anchor_identities)) {
  check(settings_);
  const std::size_t anchors = settings_.filter.anchors.size();
  if (settings_.association.method == "known" && anchor_identities_.size() != anchors)
    throw std::invalid_argument(
        "vehicle_filter.anchors_m: with association by identity each anchor needs one");
  anchor_identities_.resize(anchors, Detection::unknown);
}

void PlanarEstimator::start(PlanarEstimate& e, const Observation& seen, const Tick& tick) const {
  const PlanarStartSettings& s = settings_.start;
  if (s.at_first_fix && seen.fixes.empty()) {
    e.status.reason = "waiting for the first position fix";
    return;
  }
  const bool linear = settings_.filter.decorrelate == "map-linear";
  const bool watched = e.belief.keeps_trace();
  e.belief = Belief(64, linear ? MapCorrelations::dropped : MapCorrelations::kept);
  e.belief.keep_trace(watched);
  const Eigen::Vector2d at = s.at_first_fix ? seen.fixes.front().position : s.position_m;
  const planar::Pose<double> pose(at.x(), at.y(), wrap_angle(s.heading_rad));
  const Eigen::Matrix3d P =
      Eigen::Vector3d(s.sigma_position_m, s.sigma_position_m, s.sigma_heading_rad).cwiseAbs2().asDiagonal();
  if (settings_.filter.map_frame == "vehicle") {
    const planar::FramedPose world = planar::inverse(pose);
    e.vehicle = e.belief.add_vehicle(planar::pose_chart, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero());
    e.world =
        e.belief.add_vehicle(planar::pose_chart, world.pose, world.by_frame * P * world.by_frame.transpose());
  } else {
    e.vehicle = e.belief.add_vehicle(planar::pose_chart, pose, P);
  }
  for (std::size_t i = 0; i < settings_.filter.anchors.size(); ++i) {
    PlanarLandmark landmark;
    landmark.id = settings_.association.method == "known" ? anchor_identities_[i] : e.next_id++;
    landmark.anchor = true;
    landmark.identity = anchor_identities_[i];
    landmark.position = settings_.filter.anchors[i];
    e.catalogue.push_back(landmark);
  }
  e.first_prediction = e.belief.mean(e.vehicle);
  e.t = s.at_first_fix ? seen.fixes.front().t : first_time(seen, tick);
  e.started = true;
  e.status = {TrackingState::tracking, "", 0};
}

void PlanarEstimator::update(PlanarEstimate& e, const Command&, const Observation& seen,
                             const Tick& tick) const {
  StageClock stage(e.timing_ms);
  e.looks.clear();
  e.fixes.clear();
  e.matched = 0;
  e.update = {};
  e.iterations = 0;
  e.association_capped = false;
  if (!e.started) start(e, seen, tick);
  if (!e.started) return;
  const bool map_was_empty = e.catalogue.empty();
  e.refused = !predict_through(e, seen, tick.t, settings_);
  stage.mark("predict");
  const ScanAssociation found = associate_scan(e, seen.detections, settings_);
  e.association_capped = found.capped;
  e.capped_scans += found.capped;
  stage.mark("associate");
  tell_looks(e, seen, found);
  correct(e, seen, found);
  stage.mark("update");
  give_births(e, seen, found);
  stage.mark("births");
  tell_from_vehicle(e);
  if (settings_.filter.decorrelate == "everything") e.belief.decorrelate(Belief::Scope::everything);
  if (settings_.filter.decorrelate == "map") e.belief.decorrelate(Belief::Scope::map);
  stage.mark("decorrelate");
  judge(e, map_was_empty);
  refresh_entropy(e);
  stage.mark("entropy");
}

/// A refused update has corrected nothing: nothing was matched.
void PlanarEstimator::refuse(PlanarEstimate& e, const ScanAssociation& found) const {
  e.refused = true;
  e.matched = 0;
  for (const auto& [d, l] : found.matches) {
    if (e.looks[d].outcome == LookOutcome::matched) --e.catalogue[l].sightings;
    e.looks[d].outcome = LookOutcome::inconsistent;
  }
}

/// The looks of all matches about the belief's present means.
std::vector<AffineLook> PlanarEstimator::matched_looks(const PlanarEstimate& e, const Observation& seen,
                                                       const ScanAssociation& found) const {
  std::vector<AffineLook> looks;
  for (const auto& [d, l] : found.matches)
    if (const auto look = look_at(e, e.catalogue[l], seen.detections[d], settings_))
      looks.push_back(look->look);
  return looks;
}

/// What each detection was taken for, before anything is corrected.
void PlanarEstimator::tell_looks(PlanarEstimate& e, const Observation& seen,
                                 const ScanAssociation& found) const {
  for (const Detection& d : seen.detections)
    e.looks.push_back(
        {-1, false, {d.range_m, d.bearing_rad}, {0, 0}, Eigen::Matrix2d::Zero(), LookOutcome::not_tried});
  for (const std::size_t d : found.refused) e.looks[d].outcome = LookOutcome::inconsistent;
  Eigen::MatrixXd S;
  for (const auto& [d, l] : found.matches) {
    PlanarLandmark& landmark = e.catalogue[l];
    const auto look = look_at(e, landmark, seen.detections[d], settings_);
    if (!look) continue;
    e.belief.innovation_covariance({&look->look, 1}, S);
    e.looks[d] = {landmark.id, landmark.anchor,     e.looks[d].measured, look->predicted,
                  S,           LookOutcome::matched};
    ++landmark.sightings;
    ++e.matched;
  }
}

void PlanarEstimator::correct(PlanarEstimate& e, const Observation& seen,
                              const ScanAssociation& found) const {
  if (found.matches.empty()) return;
  if (settings_.filter.lineariser == "iterated") {
    std::vector<BlockId> blocks{e.vehicle};
    if (e.world) blocks.push_back(*e.world);
    for (const auto& [d, l] : found.matches)
      if (!e.catalogue[l].anchor) blocks.push_back(e.catalogue[l].block);
    const IterationReport report =
        update_iterated(e.belief, blocks, [&](const Belief&) { return matched_looks(e, seen, found); });
    e.update = report.update;
    e.iterations = report.iterations;
    e.unsettled_updates += !report.converged;
  } else {
    e.update = e.belief.update(matched_looks(e, seen, found));
  }
  if (e.update.outcome == UpdateReport::Outcome::singular) refuse(e, found);
}

void PlanarEstimator::give_births(PlanarEstimate& e, const Observation& seen,
                                  const ScanAssociation& found) const {
  for (const std::size_t d : found.births) {
    const std::size_t l = give_birth(e, seen.detections[d], settings_);
    e.looks[d].id = e.catalogue[l].id;
    e.looks[d].outcome = LookOutcome::born;
  }
}

/// Whether the pose is to be believed. A scan without landmarks says nothing against it, nor the first that
/// shows any; scans of which nothing matches what is mapped do, whether new landmarks are made of them or
/// not.
void PlanarEstimator::judge(PlanarEstimate& e, bool map_was_empty) const {
  const PlanarPoseEstimate vehicle = vehicle_pose(e);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(vehicle.covariance.topLeftCorner<2, 2>());
  const double sigma = std::sqrt(std::max(0.0, eigen.eigenvalues().maxCoeff()));
  const bool possible = vehicle.covariance.allFinite() && vehicle.covariance.diagonal().minCoeff() >= 0;
  if (!e.looks.empty() && !map_was_empty)
    e.status.frames_with_few = e.matched > 0 ? 0 : e.status.frames_with_few + 1;
  const PlanarLostSettings& lost = settings_.lost;
  const auto say = [&](TrackingState state, const std::string& reason) {
    e.status.state = state;
    e.status.reason = reason;
  };
  if (!vehicle.pose.allFinite() || !possible)
    say(TrackingState::lost, "pose or covariance is not a number");
  else if (!(sigma <= lost.max_sigma_position_m))
    say(TrackingState::lost, "position sigma " + std::to_string(sigma) + " m, the limit is " +
                                 std::to_string(lost.max_sigma_position_m));
  else if (e.status.frames_with_few >= lost.max_unmatched_scans)
    say(TrackingState::lost,
        "no known landmark in " + std::to_string(e.status.frames_with_few) + " scans that show some");
  else if (e.refused)
    say(TrackingState::degraded,
        "an update was refused: within rounding it would leave nothing of a variance");
  else if (e.association_capped)
    say(TrackingState::degraded, "the joint association reached its cap of " +
                                     std::to_string(settings_.association.max_nodes) + " nodes");
  else
    say(TrackingState::tracking, "");
}

void PlanarEstimator::refresh_entropy(PlanarEstimate& e) const {
  constexpr double period_s = 1;
  if (e.entropy_t && e.t - *e.entropy_t < period_s) return;
  e.entropy = entropies(e);
  e.entropy_t = e.t;
}

}  // namespace incognita
