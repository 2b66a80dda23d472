#include "incognita/slam/team_estimator.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "incognita/belief/linearise.hpp"
#include "incognita/math/gaussian.hpp"
#include "incognita/slam/belief_entropy.hpp"
#include "incognita/slam/stage_clock.hpp"
#include "incognita/slam/team_looks.hpp"
#include "incognita/slam/team_motion.hpp"

namespace incognita {
namespace {

bool is_laser_on_plane(const TeamMember& m) { return std::holds_alternative<LaserScanner>(m.sensor); }

std::string fault_in_sizes(const TeamMember& m) {
  const Chart& chart = chart_of(m.motion);
  const auto wrong = [](const SmallVector& v, int size, const char* what) {
    return v.size() == size && v.allFinite()
               ? std::string()
               : std::string(what) + ": " + std::to_string(size) +
                     " finite numbers are wanted, and there are " + std::to_string(v.size());
  };
  for (const std::string& fault :
       {wrong(m.start, chart.ambient(), "the start of a vehicle"),
        wrong(m.start_sigmas, chart.tangent(), "the sigmas of a vehicle's start"),
        wrong(m.input_sigmas, inputs_of(m.motion), "the sigmas of a vehicle's inputs"),
        wrong(m.sigmas, chart_of(m.sensor).tangent(), "the sigmas of a measurement")})
    if (!fault.empty()) return fault;
  if (!(m.sigmas.minCoeff() > 0)) return "the sigmas of a measurement must be more than 0";
  return "";
}

/// One sighting of this tick that can be used.
struct Used {
  const Sighting* sighting = nullptr;
  std::size_t told = 0;  ///< in the estimate's list
};

/// Those of a tick, and what each is to the engine about the means before the update.
struct UsedSightings {
  std::vector<Used> sightings;
  std::vector<AffineLook> looks;
};

double distance_of(const Belief& belief, const AffineLook& look, SmallMatrix& S_out) {
  Eigen::MatrixXd S;
  belief.innovation_covariance({&look, 1}, S);
  S_out = S;
  return look.residual.dot(S.llt().solve(look.residual));
}

}  // namespace

std::string fault_in(const TeamSettings& s) {
  if (s.members.empty()) return "a team needs a vehicle";
  const auto& words = {"analytic", "iterated", "unscented-vehicle", "first-estimate"};
  if (std::find(words.begin(), words.end(), s.filter.lineariser) == words.end())
    return "`" + s.filter.lineariser + "` is no lineariser";
  for (const TeamMember& m : s.members) {
    for (const std::string& fault : {misfit(m.motion, m.sensor), fault_in_sizes(m)})
      if (!fault.empty()) return fault;
    if (dimensions_of(m.sensor) != dimensions_of(s.members.front().sensor))
      return "vehicles whose landmarks have different dimensions can not share a map";
    if (s.filter.lineariser == "first-estimate" && !is_laser_on_plane(m))
      return "first-estimate Jacobians are derived for ranges and bearings on a plane only";
    if (s.filter.lineariser == "iterated" && std::holds_alternative<FreeCameraMotion>(m.motion))
      return "the iterated update of a body that turns freely in space does not always settle, and is too "
             "sure then; "
             "take `analytic`";
    for (const auto& [identity, anchor] : s.anchors)
      if (anchor.size() != dimensions_of(m.sensor))
        return "anchor " + std::to_string(identity) +
               " must have as many numbers as the place has dimensions";
  }
  return "";
}

TeamEstimator::TeamEstimator(TeamSettings settings) : settings_(std::move(settings)) {
  const std::string fault = fault_in(settings_);
  if (!fault.empty()) throw std::invalid_argument(fault);
}

void TeamEstimator::start(TeamEstimate& e, const Tick& tick) const {
  const bool watched = e.belief.keeps_trace();
  e.belief = Belief();
  e.vehicles.clear();
  e.landmarks.clear();
  e.belief.keep_trace(watched);
  for (const auto& [identity, position] : settings_.anchors) e.anchors[identity] = {position, 0};
  for (const TeamMember& member : settings_.members) {
    TeamVehicle vehicle;
    vehicle.block = e.belief.add_vehicle(chart_of(member.motion), member.start,
                                         SmallMatrix(member.start_sigmas.cwiseAbs2().asDiagonal()));
    vehicle.prediction = member.start;
    vehicle.t = tick.t;
    e.vehicles.push_back(vehicle);
  }
  e.started = true;
  e.status = {TrackingState::tracking, "", 0};
}

namespace {

/// Linearises every sighting of what is known, notes it, and keeps those inside the gate.
UsedSightings sort_out(TeamEstimate& e, const Observation& seen, const TeamSettings& settings) {
  UsedSightings used;
  const auto consider = [&](int vehicle, bool of_vehicle, const Sighting& sighting) {
    const bool anchor = !of_vehicle && settings.anchors.count(sighting.identity) > 0;
    TeamLook told{vehicle, of_vehicle, anchor, sighting.identity, sighting.z, {}, {}, LookOutcome::not_tried};
    if (const auto at = linearised_sighting(e, vehicle, of_vehicle, sighting, settings)) {
      told.predicted = at->predicted;
      const double distance = distance_of(e.belief, at->look, told.innovation_cov);
      const double gate = settings.filter.gate_probability;
      const bool inside = !(gate < 1) || distance <= chi_square_quantile(gate, at->look.rows());
      told.outcome = inside ? LookOutcome::matched : LookOutcome::inconsistent;
      if (inside) {
        used.sightings.push_back({&sighting, e.looks.size()});
        used.looks.push_back(at->look);
      }
    }
    e.looks.push_back(told);
  };
  for (std::size_t i = 0; i < seen.team.size(); ++i) {
    for (const Sighting& s : seen.team[i].landmarks) consider(static_cast<int>(i), false, s);
    for (const Sighting& s : seen.team[i].vehicles) consider(static_cast<int>(i), true, s);
  }
  return used;
}

/// The same sightings about the belief's present means. One that the sensor could not have there is as it
/// was.
std::vector<AffineLook> linearised_again(const TeamEstimate& e, const UsedSightings& used,
                                         const TeamSettings& settings) {
  std::vector<AffineLook> looks = used.looks;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const TeamLook& told = e.looks[used.sightings[i].told];
    const auto at =
        linearised_sighting(e, told.vehicle, told.of_vehicle, *used.sightings[i].sighting, settings);
    if (at) looks[i] = at->look;
  }
  return looks;
}

/// Blocks that the looks are from and at, each once.
std::vector<BlockId> blocks_of(const std::vector<AffineLook>& looks) {
  std::set<BlockId> blocks;
  for (const AffineLook& look : looks)
    for (int i = 0; i < look.part_count; ++i) blocks.insert(look.parts[static_cast<std::size_t>(i)].block);
  return {blocks.begin(), blocks.end()};
}

int& sightings_of(TeamEstimate& e, const TeamLook& look) {
  return look.anchor ? e.anchors.at(look.identity).sightings : e.landmarks.at(look.identity).sightings;
}

void correct(TeamEstimate& e, const UsedSightings& used, const TeamSettings& settings) {
  if (used.looks.empty()) return;
  if (settings.filter.lineariser == "iterated") {
    const auto again = [&](const Belief&) { return linearised_again(e, used, settings); };
    const IterationReport report = update_iterated(e.belief, blocks_of(used.looks), again);
    e.update = report.update;
    e.unsettled_updates += !report.converged;
  } else {
    e.update = e.belief.update(used.looks);
  }
  const bool done = e.update.outcome == UpdateReport::Outcome::updated;
  for (const Used& u : used.sightings) {
    TeamLook& told = e.looks[u.told];
    told.outcome = done ? LookOutcome::matched : LookOutcome::inconsistent;
    if (done && !told.of_vehicle) ++sightings_of(e, told);
  }
  e.matched = done ? static_cast<int>(used.sightings.size()) : 0;
}

void give_births(TeamEstimate& e, const Observation& seen, const TeamSettings& settings) {
  std::size_t look = 0;
  for (std::size_t i = 0; i < seen.team.size(); ++i) {
    for (const Sighting& s : seen.team[i].landmarks) {
      TeamLook& told = e.looks[look++];
      if (told.anchor || e.landmarks.count(s.identity) > 0) continue;
      if (give_birth(e, static_cast<int>(i), s, settings)) told.outcome = LookOutcome::born;
    }
    look += seen.team[i].vehicles.size();
  }
}

}  // namespace

void TeamEstimator::update(TeamEstimate& e, const Command&, const Observation& seen, const Tick& tick) const {
  if (seen.team.size() != settings_.members.size())
    throw std::invalid_argument("views of " + std::to_string(seen.team.size()) +
                                " vehicles were given to a team of " +
                                std::to_string(settings_.members.size()));
  if (!e.started) start(e, tick);
  StageClock stage(e.timing_ms);
  e.looks.clear();
  e.matched = 0;
  e.update = {};
  for (std::size_t i = 0; i < e.vehicles.size(); ++i) predict_vehicle(e, i, seen.team[i], tick.t, settings_);
  stage.mark("predict");
  const UsedSightings used = sort_out(e, seen, settings_);
  stage.mark("associate");
  correct(e, used, settings_);
  stage.mark("update");
  give_births(e, seen, settings_);
  settle_depths(e, settings_);
  stage.mark("births");
  tell_poses(e);
  judge(e);
  stage.mark("poses");
  refresh_entropy(e, tick.t);
  stage.mark("entropy");
}

/// The larger the state, the rarer, so that it never costs more than a small share of a run.
void TeamEstimator::refresh_entropy(TeamEstimate& e, double t) const {
  const double states = e.belief.errors();
  const double period_s = std::max(1.0, std::pow(states / 300, 3));
  if (e.entropy_t && t - *e.entropy_t < period_s) return;
  int vehicles = 0;
  for (const TeamVehicle& v : e.vehicles) vehicles += e.belief.chart(v.block).tangent();
  e.entropy = entropies_of(e.belief, vehicles);
  e.entropy_t = t;
}

void TeamEstimator::tell_poses(TeamEstimate& e) const {
  for (std::size_t i = 0; i < e.vehicles.size(); ++i) {
    TeamVehicle& vehicle = e.vehicles[i];
    const SmallVector mean = e.belief.mean(vehicle.block);
    const SmallMatrix J = pose_jacobian(settings_.members[i].motion, mean);
    vehicle.pose = pose_of(settings_.members[i].motion, mean);
    vehicle.pose_covariance = J * e.belief.covariance(vehicle.block) * J.transpose();
  }
}

void TeamEstimator::judge(TeamEstimate& e) const {
  const auto lost = [&](const std::string& reason) {
    e.status.state = TrackingState::lost, e.status.reason = reason;
  };
  for (std::size_t i = 0; i < e.vehicles.size(); ++i) {
    const TeamVehicle& vehicle = e.vehicles[i];
    const Eigen::Matrix3d P = vehicle.pose_covariance.topLeftCorner<3, 3>();
    const std::string who = settings_.members.size() > 1 ? "vehicle " + std::to_string(i + 1) + ": " : "";
    if (!vehicle.pose.position.allFinite() || !vehicle.pose_covariance.allFinite())
      return lost(who + "pose or covariance is not a number");
    const double sigma = std::sqrt(std::max(0.0, P.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff()));
    if (!(sigma <= settings_.filter.max_sigma_position_m))
      return lost(who + "position sigma " + std::to_string(sigma) + " m, the limit is " +
                  std::to_string(settings_.filter.max_sigma_position_m));
  }
  const bool refused = e.update.outcome == UpdateReport::Outcome::singular;
  e.status.state = refused ? TrackingState::degraded : TrackingState::tracking;
  e.status.reason =
      refused ? "an update was refused: within rounding it would leave nothing of a variance" : "";
}

}  // namespace incognita
