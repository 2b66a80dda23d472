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
#include "incognita/slam/points/team_looks.hpp"
#include "incognita/slam/points/team_motion.hpp"
#include "incognita/slam/points/team_status.hpp"

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

namespace {

AnyBelief empty_belief(const TeamFilterSettings& filter) {
  if (filter.form == "information") return AnyBelief(InformationBelief());
  return AnyBelief(
      Belief(64, filter.decorrelate == "map-linear" ? MapCorrelations::dropped : MapCorrelations::kept));
}

/// The vehicle alone, or of a map in its frame also the world as it sees it.
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

double start_time(const TeamMember& member, const VehicleView& view, double t) {
  if (member.start_time == TeamMember::StartTime::first_fix) return view.fixes.front().t;
  if (member.start_time == TeamMember::StartTime::first_reading && !view.odometry.empty())
    return std::min(t, view.odometry.front().t);
  return t;
}

bool waits_for_fix(const TeamMember& member, const VehicleView& view) {
  return member.start_time == TeamMember::StartTime::first_fix && view.fixes.empty();
}

}  // namespace

void TeamEstimator::start(TeamEstimate& e, const Observation& seen, const Tick& tick) const {
  for (std::size_t i = 0; i < settings_.members.size(); ++i)
    if (waits_for_fix(settings_.members[i], seen.team[i])) {
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
      at.head<2>() = seen.team[i].fixes.front().position;
    add_vehicle(e, member, at, start_time(member, seen.team[i], tick.t),
                settings_.filter.map_frame == "vehicle");
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
  if (!is_usable(settings.members[static_cast<std::size_t>(told.vehicle)].sensor, told.measured)) return;
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

/// Whether a detection of the same vehicle and landmark comes before `end` in the list of this tick.
bool was_measured(const TeamEstimate& e, int vehicle, std::int64_t identity, std::size_t end) {
  return std::any_of(e.looks.begin(), e.looks.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](const TeamLook& look) {
                       return look.vehicle == vehicle && !look.of_vehicle && look.identity == identity;
                     });
}

/// By the identities that the sensor measures, each once. Detections without identity are not used.
void go_by_names(TeamEstimate& e, int vehicle, const VehicleView& view, const Gate& gate,
                 const TeamSettings& settings) {
  for (const Sighting& s : view.landmarks) {
    note(e, vehicle, false, s.identity, s.z, settings);
    const std::size_t look = e.looks.size() - 1;
    if (was_measured(e, vehicle, s.identity, look)) continue;
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
  e.association_capped = e.association_capped || taken.capped;
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
  e.association_capped = false;
  const auto go = settings.association.method == "known" ? go_by_names : go_by_places;
  for (std::size_t i = 0; i < seen.team.size(); ++i) {
    const int vehicle = static_cast<int>(i);
    go(e, vehicle, seen.team[i], gate, settings);
    for (const Sighting& s : seen.team[i].vehicles) {
      note(e, vehicle, true, s.identity, s.z, settings);
      consider(e, e.looks.size() - 1, gate, settings);
    }
  }
  e.capped_associations += e.association_capped;
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
    e.iterations = report.iterations;
    e.unsettled_updates += !report.converged;
  } else {
    e.update = e.belief.update(used.looks);
  }
  const bool done = e.update.outcome == UpdateReport::Outcome::updated;
  e.refused = e.refused || e.update.outcome == UpdateReport::Outcome::singular;
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
    throw std::invalid_argument("observations of " + std::to_string(seen.team.size()) +
                                " vehicles were given to an estimator of " +
                                std::to_string(settings_.members.size()));
  StageClock stage(e.timing_ms);
  e.looks.clear();
  e.fixes.clear();
  e.matched = e.iterations = 0;
  e.update = {};
  e.refused = false;
  if (!e.started) start(e, seen, tick);
  if (!e.started) return;
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
  recenter_map(e);
  if (settings_.filter.decorrelate == "everything") e.belief.decorrelate(Belief::Scope::everything);
  if (settings_.filter.decorrelate == "map") e.belief.decorrelate(Belief::Scope::map);
  stage.mark("decorrelate");
  tell_poses(e);
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

void TeamEstimator::tell_poses(TeamEstimate& e) const {
  for (std::size_t i = 0; i < e.vehicles.size(); ++i) {
    TeamVehicle& vehicle = e.vehicles[i];
    express_in_world(e, vehicle);
    const SmallMatrix J = pose_jacobian(settings_.members[i].motion, vehicle.state);
    vehicle.pose = pose_of(settings_.members[i].motion, vehicle.state);
    vehicle.pose_covariance = J * vehicle.state_covariance * J.transpose();
  }
}

}  // namespace incognita
