#include "incognita/slam/planar_estimator.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

#include "incognita/belief/linearise.hpp"
#include "incognita/models/planar_frame.hpp"
#include "incognita/models/range_bearing.hpp"
#include "incognita/slam/planar_looks.hpp"
#include "incognita/slam/planar_motion.hpp"
#include "incognita/slam/stage_clock.hpp"

namespace incognita {
namespace {

void expect_word(const char* setting, const std::string& word,
                 std::initializer_list<std::string_view> words) {
  if (std::find(words.begin(), words.end(), word) != words.end()) return;
  throw std::invalid_argument(std::string(setting) + ": `" + word + "` is not one of its words");
}

void check(const PlanarSlamSettings& s) {
  expect_word("vehicle.model", s.vehicle.model, {"ackermann", "differential-drive"});
  expect_word("vehicle_filter.lineariser", s.filter.lineariser,
              {"analytic", "iterated", "unscented-vehicle", "first-estimate"});
  expect_word("vehicle_filter.map_frame", s.filter.map_frame, {"world", "vehicle"});
  expect_word("vehicle_filter.decorrelate", s.filter.decorrelate,
              {"nothing", "everything", "map", "map-linear"});
  expect_word("association.method", s.association.method, {"known", "nearest", "joint"});
  if (s.filter.map_frame != "vehicle") return;
  if (s.filter.lineariser == "first-estimate")
    throw std::invalid_argument(
        "vehicle_filter.lineariser: first-estimate Jacobians belong to a map told in the world");
  if (s.filter.decorrelate != "nothing")
    throw std::invalid_argument(
        "vehicle_filter.decorrelate: a map told from the vehicle moves as a whole, its correlations cannot "
        "be "
        "dropped");
}

}  // namespace

PlanarEstimator::PlanarEstimator(const PlanarSlamSettings& settings) : settings_(settings) {
  check(settings_);
}

void PlanarEstimator::start(PlanarEstimate& e, const Observation& seen, const Tick& tick) const {
  const PlanarStartSettings& s = settings_.start;
  if (s.at_first_fix && !seen.fix) {
    e.status.reason = "waiting for the first position fix";
    return;
  }
  const bool linear = settings_.filter.decorrelate == "map-linear";
  e.belief = Belief(64, linear ? MapCorrelations::dropped : MapCorrelations::kept);
  const Eigen::Vector2d at = s.at_first_fix ? *seen.fix : s.position_m;
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
  for (const Eigen::Vector2d& anchor : settings_.filter.anchors) {
    PlanarLandmark landmark;
    landmark.id = e.next_id++;
    landmark.anchor = true;
    landmark.position = anchor;
    e.catalogue.push_back(landmark);
  }
  e.first_prediction = e.belief.mean(e.vehicle);
  e.t = tick.t;
  e.started = true;
  e.status = {TrackingState::tracking, "", 0};
}

void PlanarEstimator::update(PlanarEstimate& e, const Command&, const Observation& seen,
                             const Tick& tick) const {
  StageClock stage(e.timing_ms);
  e.looks.clear();
  e.matched = 0;
  e.update = {};
  if (!e.started) start(e, seen, tick);
  if (!e.started) return;
  predict_through(e, seen.odometry, tick.t, settings_);
  stage.mark("predict");
  if (settings_.filter.use_fixes && seen.fix) {
    const AffineLook fix = look_of_fix(e, *seen.fix, settings_.filter.sigma_fix_m);
    e.update = e.belief.update({&fix, 1});
  }
  const ScanAssociation found = associate_scan(e, seen.detections, settings_);
  e.association_capped = found.capped;
  e.capped_scans += found.capped;
  stage.mark("associate");
  correct(e, seen, found);
  stage.mark("update");
  give_births(e, seen, found);
  stage.mark("births");
  tell_from_vehicle(e);
  if (settings_.filter.decorrelate == "everything") e.belief.decorrelate(Belief::Scope::everything);
  if (settings_.filter.decorrelate == "map") e.belief.decorrelate(Belief::Scope::map);
  stage.mark("decorrelate");
  judge(e);
}

void PlanarEstimator::correct(PlanarEstimate& e, const Observation& seen,
                              const ScanAssociation& found) const {
  for (const Detection& d : seen.detections)
    e.looks.push_back({-1,
                       false,
                       {d.range_m, d.bearing_rad},
                       {0, 0},
                       Eigen::Matrix2d::Zero(),
                       LookOutcome::not_tried,
                       false});
  for (const std::size_t d : found.refused) e.looks[d].outcome = LookOutcome::inconsistent;
  if (found.matches.empty()) return;
  std::vector<AffineLook> looks;
  std::vector<BlockId> blocks{e.vehicle};
  if (e.world) blocks.push_back(*e.world);
  Eigen::MatrixXd S;
  for (const auto& [d, l] : found.matches) {
    PlanarLandmark& landmark = e.catalogue[l];
    const auto seen_there = look_at(e, landmark, seen.detections[d], settings_);
    if (!seen_there) continue;
    looks.push_back(seen_there->look);
    e.belief.innovation_covariance({&looks.back(), 1}, S);
    e.looks[d] = {
        landmark.id, landmark.anchor, e.looks[d].measured, seen_there->predicted, S, LookOutcome::matched,
        false};
    if (!landmark.anchor) blocks.push_back(landmark.block);
    ++landmark.sightings;
    ++e.matched;
  }
  if (settings_.filter.lineariser != "iterated") {
    e.update = e.belief.update(looks);
    return;
  }
  const IterationReport report = update_iterated(e.belief, blocks, [&](const Belief&) {
    std::vector<AffineLook> again;
    for (const auto& [d, l] : found.matches)
      if (const auto look = look_at(e, e.catalogue[l], seen.detections[d], settings_))
        again.push_back(look->look);
    return again;
  });
  e.update = report.update;
  e.iterations = report.iterations;
}

void PlanarEstimator::give_births(PlanarEstimate& e, const Observation& seen,
                                  const ScanAssociation& found) const {
  for (const std::size_t d : found.births) {
    const std::size_t l = give_birth(e, seen.detections[d], settings_);
    e.looks[d].id = e.catalogue[l].id;
    e.looks[d].born = true;
  }
}

/// Whether the pose is to be believed. A scan without landmarks says nothing against it.
void PlanarEstimator::judge(PlanarEstimate& e) const {
  const PlanarPoseEstimate vehicle = vehicle_pose(e);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(vehicle.covariance.topLeftCorner<2, 2>(),
                                                             Eigen::EigenvaluesOnly);
  const double sigma = std::sqrt(std::max(0.0, eigen.eigenvalues().maxCoeff()));
  const bool shown = std::any_of(e.looks.begin(), e.looks.end(), [](const PlanarLook& l) { return !l.born; });
  if (shown) e.status.frames_with_few = e.matched > 0 ? 0 : e.status.frames_with_few + 1;
  const PlanarLostSettings& lost = settings_.lost;
  if (!vehicle.pose.allFinite() || !(sigma <= lost.max_sigma_position_m)) {
    e.status.state = TrackingState::lost;
    e.status.reason = "position sigma " + std::to_string(sigma) + " m, the limit is " +
                      std::to_string(lost.max_sigma_position_m);
  } else if (e.status.frames_with_few >= lost.max_unmatched_scans) {
    e.status.state = TrackingState::lost;
    e.status.reason =
        "no known landmark in " + std::to_string(e.status.frames_with_few) + " scans that show some";
  } else if (e.association_capped) {
    e.status.state = TrackingState::degraded;
    e.status.reason = "the joint association reached its cap of " +
                      std::to_string(settings_.association.max_nodes) + " nodes";
  } else {
    e.status.state = TrackingState::tracking;
    e.status.reason.clear();
  }
  constexpr double entropy_period_s = 1;
  if (std::isfinite(e.entropy.total) && e.t - e.entropy_t < entropy_period_s) return;
  e.entropy = entropies(e);
  e.entropy_t = e.t;
}

}  // namespace incognita
