#include "incognita/decision/team_expectation.hpp"

#include <cmath>
#include <utility>

#include "incognita/slam/points/team_looks.hpp"

namespace incognita {

TeamExpectation::TeamExpectation(TeamSettings team, int max_looks)
    : team_(std::move(team)), max_looks_(max_looks) {}

/// What the sensor would tell from there; nothing where it would not see the place.
std::optional<AnyLook> TeamExpectation::look_from(const SmallVector& vehicle, const SmallVector& from,
                                                  const LandmarkForm& form, const SmallVector& told,
                                                  const SmallVector& place) const {
  const TeamMember& member = team_.members[vehicle_];
  const double distance_m = (place - from).norm();
  if (distance_m > member.reach.max_range_m) return std::nullopt;
  auto look = look_at(member.sensor, member.motion, vehicle, form, told);
  if (!look || !is_in_view(member.sensor, member.reach, *look, distance_m)) return std::nullopt;
  return look;
}

void TeamExpectation::prepare(const TeamEstimate& estimate, std::size_t vehicle,
                              const std::vector<ExpectedLandmark>& unseen, double unseen_var_m2) {
  estimate_ = &estimate;
  vehicle_ = vehicle;
  unseen_ = &unseen;
  unseen_var_m2_ = unseen_var_m2;
  targets_.clear();
  add_targets();
}

void TeamExpectation::add_targets() {
  const TeamEstimate& e = *estimate_;
  const int dimensions = dimensions_of(team_.members[vehicle_].sensor);
  for (const auto& [identity, anchor] : team_.anchors) targets_.push_back({{}, anchor, {}, 0, anchor, true});
  for (const auto& [identity, landmark] : e.landmarks) {
    const SmallVector mean = e.belief.mean(landmark.block);
    const auto place = position_of(landmark.form, mean);
    const int errors = e.belief.chart(landmark.block).tangent();
    if (place)
      targets_.push_back({landmark.form, mean, SmallMatrix::Identity(errors, errors), landmark.block,
                          place->position, false});
  }
  for (std::size_t j = 0; j < e.vehicles.size(); ++j) {
    if (j == vehicle_) continue;
    const AnyPoint at = position_of(team_.members[j].motion, e.belief.mean(e.vehicles[j].block), dimensions);
    targets_.push_back({{}, at.position, at.J, e.vehicles[j].block, at.position, false});
  }
}

/// Of H P H', the vehicle as sure of itself as it is now: an order among looks, not a covariance to reckon
/// with.
double TeamExpectation::innovation_trace(const ExpectedLook& look) const {
  const AnyBelief& belief = estimate_->belief;
  const BlockId viewer = estimate_->vehicles[vehicle_].block;
  double trace = (look.Hv * belief.covariance(viewer)).cwiseProduct(look.Hv).sum();
  if (look.of != ExpectedLook::Of::mapped) return trace;
  trace += (look.Hl * belief.covariance(look.block)).cwiseProduct(look.Hl).sum();
  return trace + 2 * (look.Hv * belief.covariance(viewer, look.block)).cwiseProduct(look.Hl).sum();
}

bool TeamExpectation::in_view(const BlockVector& state, const Eigen::Vector3d& place) const {
  const TeamMember& member = team_.members[vehicle_];
  const int dimensions = dimensions_of(member.sensor);
  const SmallVector vehicle = state.head(chart_of(member.motion).ambient()), point = place.head(dimensions);
  const SmallVector from = position_of(member.motion, vehicle, dimensions).position;
  return look_from(vehicle, from, {}, point, point).has_value();
}

/// looks <- all of the map and of the team that would be seen.
void TeamExpectation::see(const SmallVector& vehicle, const SmallVector& from,
                          std::vector<ExpectedLook>& looks) const {
  looks.clear();
  for (const Target& target : targets_) {
    const auto seen = look_from(vehicle, from, target.form, target.told, target.place);
    if (!seen) continue;
    ExpectedLook& look = looks.emplace_back();
    look.of = target.known ? ExpectedLook::Of::anchor : ExpectedLook::Of::mapped;
    look.block = target.block;
    look.Hv = seen->Hv;
    if (target.known)
      look.Hl.resize(seen->Hv.rows(), 0);
    else
      look.Hl = seen->Hl * target.by_block;
    look.R = sighting_noise(team_.members[vehicle_], seen->z);
  }
}

/// They stay in order.
void TeamExpectation::keep_most_uncertain(std::vector<ExpectedLook>& looks) const {
  const auto most = static_cast<std::size_t>(max_looks_);
  if (looks.size() <= most) return;
  traces_.clear();
  for (const ExpectedLook& look : looks) traces_.push_back(innovation_trace(look));
  const double least = least_of_the_best(traces_, max_looks_, sorted_);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < looks.size() && kept < most; ++i) {
    if (traces_[i] < least) continue;
    if (kept != i) looks[kept] = looks[i];
    ++kept;
  }
  looks.resize(kept);
}

void TeamExpectation::expect(const BlockVector& state, std::vector<ExpectedLook>& looks) const {
  const TeamMember& member = team_.members[vehicle_];
  const int dimensions = dimensions_of(member.sensor);
  const SmallVector vehicle = state.head(chart_of(member.motion).ambient());
  const SmallVector from = position_of(member.motion, vehicle, dimensions).position;
  see(vehicle, from, looks);
  keep_most_uncertain(looks);
  for (const ExpectedLandmark& unseen : *unseen_) {
    const SmallVector point = unseen.position.head(dimensions);
    const auto seen = look_from(vehicle, from, {}, point, point);
    if (!seen) continue;
    looks.push_back({ExpectedLook::Of::unseen, 0, unseen.index, unseen_var_m2_, seen->Hv, seen->Hl,
                     sighting_noise(member, seen->z)});
  }
}

}  // namespace incognita
