#include "incognita/slam/points/team_estimator.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

#include "incognita/belief/iterated_update.hpp"
#include "incognita/math/gaussian.hpp"
#include "incognita/slam/mapper/belief_entropy.hpp"
#include "incognita/slam/mapper/stage_clock.hpp"
#include "incognita/slam/points/team_association.hpp"
#include "incognita/slam/points/team_looks.hpp"
#include "incognita/slam/points/team_motion.hpp"

namespace incognita {
namespace {

double distance_of(const AffineLook& look, const SmallMatrix& S) {
  return look.residual.dot(S.llt().solve(SmallVector(look.residual)));
}

/// Of sightings with so many numbers, which to believe.
class Gate {
 public:
  explicit Gate(double probability) : shut_(probability < 1) {
    for (int rows = 1; shut_ && rows <= max_look_rows; ++rows)
      most_[static_cast<std::size_t>(rows)] = chi_square_quantile(probability, rows);
  }
  bool has(double distance, int rows) const {
    return !shut_ || distance <= most_[static_cast<std::size_t>(rows)];
  }

 private:
  bool shut_;
  std::array<double, max_look_rows + 1> most_{};
};

}  // namespace

TeamEstimator::TeamEstimator(TeamSettings settings) : settings_(std::move(settings)) {
  const std::string fault = fault_in(settings_);
  if (!fault.empty()) throw std::invalid_argument(fault);
}

void TeamEstimator::start(TeamEstimate& e, const Tick& tick) const {
  const bool watched = e.belief.keeps_trace();
  e.belief = settings_.filter.form == "information" ? AnyBelief(InformationBelief()) : AnyBelief(Belief());
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

void note(TeamEstimate& e, int vehicle, bool of_vehicle, std::int64_t identity, const SmallVector& z,
          const TeamSettings& settings) {
  const bool anchor = !of_vehicle && settings.anchors.count(identity) > 0;
  e.looks.push_back({vehicle, of_vehicle, anchor, identity, z, {}, {}, LookOutcome::not_tried});
}

/// Linearises a sighting of what is known, and keeps it when it is inside the gate.
void consider(TeamEstimate& e, std::size_t look, const Gate& gate, const TeamSettings& settings) {
  TeamLook& told = e.looks[look];
  UsedSightings& used = e.used;
  const auto at =
      linearised_sighting(e, told.vehicle, told.of_vehicle, {told.identity, told.measured}, settings);
  if (!at) return;
  told.predicted = at->predicted;
  e.belief.innovation_covariance({&at->look, 1}, used.S);
  told.innovation_cov = used.S;
  const bool inside = gate.has(distance_of(at->look, told.innovation_cov), at->look.rows());
  told.outcome = inside ? LookOutcome::matched : LookOutcome::inconsistent;
  if (!inside) return;
  used.told.push_back(look);
  used.looks.push_back(at->look);
}

/// By the names that the sensor tells. What has none is left alone.
void go_by_names(TeamEstimate& e, int vehicle, const VehicleView& view, const Gate& gate,
                 const TeamSettings& settings) {
  for (const Sighting& s : view.landmarks) {
    note(e, vehicle, false, s.identity, s.z, settings);
    const std::size_t look = e.looks.size() - 1;
    consider(e, look, gate, settings);
    const bool known = e.looks[look].anchor || e.landmarks.count(s.identity) > 0;
    if (!known && s.identity != Detection::unknown) e.used.newcomers.push_back(look);
  }
}

/// By where they are seen. Two vehicles may see the same new landmark, and only once it is in the map can the
/// second one's sighting be held against it: so one vehicle gives births in a tick.
void go_by_places(TeamEstimate& e, int vehicle, const VehicleView& view, const Gate& gate,
                  const TeamSettings& settings) {
  const ViewAssociation taken = associate_view(e, vehicle, view.landmarks, settings);
  const std::size_t first = e.looks.size();
  for (std::size_t s = 0; s < view.landmarks.size(); ++s)
    note(e, vehicle, false, taken.landmarks[s], view.landmarks[s].z, settings);
  for (const std::size_t s : taken.order) consider(e, first + s, gate, settings);
  if (!e.used.newcomers.empty()) return;
  for (const std::size_t s : taken.newcomers) e.used.newcomers.push_back(first + s);
}

/// Notes every sighting, says what it is of, and keeps those that are to be used.
void sort_out(TeamEstimate& e, const Observation& seen, const TeamSettings& settings) {
  const Gate gate(settings.filter.gate_probability);
  e.used.told.clear();
  e.used.looks.clear();
  e.used.newcomers.clear();
  const auto go = settings.association.method == "nearest" ? go_by_places : go_by_names;
  for (std::size_t i = 0; i < seen.team.size(); ++i) {
    const int vehicle = static_cast<int>(i);
    go(e, vehicle, seen.team[i], gate, settings);
    for (const Sighting& s : seen.team[i].vehicles) {
      note(e, vehicle, true, s.identity, s.z, settings);
      consider(e, e.looks.size() - 1, gate, settings);
    }
  }
}

/// The same sightings about the belief's present means; without parts where the sensor could not have it.
std::vector<AffineLook> linearised_again(const TeamEstimate& e, const TeamSettings& settings) {
  std::vector<AffineLook> looks(e.used.looks.size());
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const TeamLook& told = e.looks[e.used.told[i]];
    const auto at =
        linearised_sighting(e, told.vehicle, told.of_vehicle, {told.identity, told.measured}, settings);
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

void correct(TeamEstimate& e, const TeamSettings& settings) {
  const UsedSightings& used = e.used;
  if (used.looks.empty()) return;
  if (settings.filter.lineariser == "iterated") {
    const auto again = [&](const AnyBelief&) { return linearised_again(e, settings); };
    const IterationSettings until{.max_iterations = 20, .tolerance_sigmas = 1e-3};
    const IterationReport report = update_iterated(e.belief, blocks_of(used.looks), again, until);
    e.update = report.update;
    e.unsettled_updates += !report.converged;
  } else {
    e.update = e.belief.update(used.looks);
  }
  const bool done = e.update.outcome == UpdateReport::Outcome::updated;
  constexpr double forgetting = 0.9;
  e.recent_nis = forgetting * e.recent_nis + (done ? e.update.nis : 0);
  e.recent_rows = forgetting * e.recent_rows + (done ? e.update.rows : 0);
  for (const std::size_t i : used.told) {
    TeamLook& told = e.looks[i];
    told.outcome = done ? LookOutcome::matched : LookOutcome::inconsistent;
    if (done && !told.of_vehicle) ++sightings_of(e, told);
  }
  e.matched = done ? static_cast<int>(used.told.size()) : 0;
}

std::int64_t new_number(TeamEstimate& e) {
  if (!e.anchors.empty()) e.next_number = std::max(e.next_number, e.anchors.rbegin()->first + 1);
  return e.next_number++;
}

void give_births(TeamEstimate& e, const TeamSettings& settings) {
  const bool named = settings.association.method == "known";
  for (const std::size_t look : e.used.newcomers) {
    TeamLook& told = e.looks[look];
    const std::int64_t identity = named ? told.identity : new_number(e);
    if (e.landmarks.count(identity) > 0) continue;  // another vehicle's sighting was before
    if (!give_birth(e, told.vehicle, {identity, told.measured}, settings)) continue;
    told.identity = identity;
    told.outcome = LookOutcome::born;
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
  for (std::size_t i = 0; i < e.vehicles.size(); ++i) {
    e.vehicles[i].wheels = seen.team[i].wheels;
    predict_vehicle(e, i, seen.team[i], tick.t, settings_);
  }
  stage.mark("predict");
  sort_out(e, seen, settings_);
  stage.mark("associate");
  correct(e, settings_);
  stage.mark("update");
  give_births(e, settings_);
  settle_depths(e, settings_);
  stage.mark("births");
  tell_poses(e);
  judge(e);
  stage.mark("poses");
  refresh_entropy(e, tick.t);
  stage.mark("entropy");
}

void TeamEstimator::refresh_entropy(TeamEstimate& e, double t) const {
  const double period_s = entropy_period_s(e.belief.errors());
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

namespace {

double residuals_in_sigmas(const TeamEstimate& e) {
  return e.recent_rows > 0 ? std::sqrt(e.recent_nis / e.recent_rows) : 0;
}

/// Landmarks that it knows are seen, and none where it believes them to be.
bool recognises_nothing(const TeamEstimate& e) {
  const auto known = std::count_if(e.looks.begin(), e.looks.end(), [](const TeamLook& look) {
    return !look.of_vehicle && look.outcome != LookOutcome::born;
  });
  constexpr int least = 3;
  return known >= least && e.matched == 0;
}

/// What speaks for the whole team being lost, whatever it believes; empty where nothing does.
std::string lost_by_what_is_seen(TeamEstimate& e) {
  constexpr int most_ticks = 10;
  constexpr double most_sigmas = 10;
  e.unmatched_ticks = recognises_nothing(e) ? e.unmatched_ticks + 1 : e.matched > 0 ? 0 : e.unmatched_ticks;
  e.doubted_ticks = residuals_in_sigmas(e) > most_sigmas ? e.doubted_ticks + 1 : 0;
  if (e.unmatched_ticks >= most_ticks)
    return "known landmarks are seen, and none where they should be, for " +
           std::to_string(e.unmatched_ticks) + " ticks";
  if (e.doubted_ticks < most_ticks) return "";
  std::ostringstream what;
  what.precision(3);
  what << "what is seen is " << residuals_in_sigmas(e)
       << " times as far from what was expected as its sigmas say, for " << e.doubted_ticks << " ticks";
  return what.str();
}

/// Why the estimate is not to be trusted, though it is not lost; empty where nothing speaks against it.
std::string doubt(const TeamEstimate& e) {
  if (e.update.outcome == UpdateReport::Outcome::singular)
    return "an update was refused: within rounding it would leave nothing of a variance";
  // By chance less often than once in a million, and residuals twice as large as they should be
  constexpr double chance = 1e-6, most_ratio = 4;
  const int rows = static_cast<int>(std::ceil(e.recent_rows));
  if (rows == 0 || e.recent_nis < most_ratio * e.recent_rows ||
      e.recent_nis < chi_square_quantile(1 - chance, rows))
    return "";
  std::ostringstream what;
  what.precision(3);
  what << "what is seen is " << residuals_in_sigmas(e)
       << " times as far from what was expected as its sigmas say: noises or first depths do not fit";
  return what.str();
}

}  // namespace

void TeamEstimator::judge(TeamEstimate& e) const {
  const bool many = settings_.members.size() > 1;
  for (std::size_t i = 0; i < e.vehicles.size(); ++i) {
    const TeamVehicle& vehicle = e.vehicles[i];
    const auto lost = [&](const std::string& reason) {
      e.status.state = TrackingState::lost;
      e.status.reason = (many ? "vehicle " + std::to_string(i + 1) + ": " : "") + reason;
    };
    if (!vehicle.pose.position.allFinite() || !vehicle.pose_covariance.allFinite())
      return lost("pose or covariance is not a number");
    const Eigen::Matrix3d P = vehicle.pose_covariance.topLeftCorner<3, 3>();
    const double sigma = std::sqrt(std::max(0.0, P.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff()));
    if (!(sigma <= settings_.filter.max_sigma_position_m))
      return lost("position sigma " + std::to_string(sigma) + " m, the limit is " +
                  std::to_string(settings_.filter.max_sigma_position_m));
  }
  const std::string lost = lost_by_what_is_seen(e);
  if (!lost.empty()) {
    e.status.state = TrackingState::lost;
    e.status.reason = lost;
    return;
  }
  const std::string reason = doubt(e);
  e.status.state = reason.empty() ? TrackingState::tracking : TrackingState::degraded;
  e.status.reason = reason;
}

}  // namespace incognita
