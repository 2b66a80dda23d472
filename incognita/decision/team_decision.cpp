#include "incognita/decision/team_decision.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "incognita/models/heading.hpp"
#include "incognita/slam/team_looks.hpp"

namespace incognita {
namespace {

/// Of the seven translations those along which the motion can go.
std::vector<Translation> actions_of(const AnyMotion& motion) {
  std::vector<Translation> actions = seven_translations();
  const bool line = std::holds_alternative<MonobotMotion>(motion),
             space = std::holds_alternative<FreeCameraMotion>(motion);
  std::erase_if(actions, [&](const Translation& a) {
    return (!space && a.direction.z() != 0) || (line && a.direction.y() != 0);
  });
  return actions;
}

double heading_by(const AnyMotion& motion, const SmallVector& state) {
  if (std::holds_alternative<MonobotMotion>(motion)) return 0;
  if (std::holds_alternative<FreeCameraMotion>(motion))
    return heading_of(Eigen::Vector4d(state.segment<4>(3)));
  return state[2];
}

/// How the vehicle's error grows over a period at rest, in ticks.
ImaginedMotion imagine(const TeamMember& member, BlockId block, const SmallVector& state,
                       const TeamDecisionSettings& s) {
  const int errors = chart_of(member.motion).tangent();
  const int steps = std::max(1, static_cast<int>(std::lround(s.decision.period_s / s.tick_s)));
  const AnyStep step =
      step_of(member.motion, state, SmallVector::Zero(inputs_of(member.motion)), s.decision.period_s / steps);
  const SmallMatrix noise = step.G * member.input_sigmas.cwiseAbs2().asDiagonal() * step.G.transpose();
  SmallMatrix A = SmallMatrix::Identity(errors, errors), N = SmallMatrix::Zero(errors, errors);
  for (int i = 0; i < steps; ++i) {
    A = (step.F * A).eval();
    N = (step.F * N * step.F.transpose() + noise).eval();
  }
  return {block, A, N};
}

}  // namespace

TeamDecision::TeamDecision(TeamSettings team, const TeamDecisionSettings& settings)
    : team_(std::move(team)), settings_(settings), actions_(actions_of(team_.members.front().motion)) {
  if (settings_.decision.strategy == "none") actions_.clear();
}

/// A vehicle with wheels looks the way that it went.
SmallVector TeamDecision::after(const TeamEstimate& e, std::size_t i, const Translation& action) const {
  const AnyMotion& motion = team_.members[i].motion;
  SmallVector state = e.belief.mean(e.vehicles[i].block);
  const Eigen::Vector3d way =
      Eigen::AngleAxisd(heading_by(motion, state), Eigen::Vector3d::UnitZ()) * action.direction;
  const bool space = std::holds_alternative<FreeCameraMotion>(motion);
  const int size = space ? 3 : std::min<int>(2, static_cast<int>(state.size()));
  state.head(size) += settings_.decision.step_m * way.head(size);
  if (space) state.tail<6>().setZero();
  if (!space && size == 2 && !way.isZero()) state[2] = std::atan2(way.y(), way.x());
  return state;
}

bool TeamDecision::allowed(const Eigen::Vector3d& place) const {
  const DecisionSettings& s = settings_.decision;
  return (place.array() >= s.min_bound_m.array()).all() && (place.array() <= s.max_bound_m.array()).all();
}

void TeamDecision::expect_looks(const TeamEstimate& e, std::size_t i, const SmallVector& state) {
  const TeamMember& member = team_.members[i];
  const int dimensions = dimensions_of(member.sensor);
  const SmallVector from = position_of(member.motion, state, dimensions).position;
  looks_.clear();
  const auto expect = [&](const LandmarkForm& form, const SmallVector& target, const SmallMatrix& by_block,
                          std::optional<BlockId> block) {
    const auto place = position_of(form, target);
    if (!place || (place->position - from).norm() > settings_.max_range_m) return;
    const auto look = look_at(member.sensor, member.motion, state, form, target);
    if (!look || !look->in_view) return;
    AffineLook& out = looks_.emplace_back();
    out.add(e.vehicles[i].block, look->Hv);
    if (block) out.add(*block, (look->Hl * by_block).eval());
    out.residual = LookVector::Zero(look->z.size());
    out.R = sighting_noise(member, look->z);
  };
  for (const auto& [identity, anchor] : team_.anchors) expect({}, anchor, {}, std::nullopt);
  for (const auto& [identity, landmark] : e.landmarks) {
    const int errors = e.belief.chart(landmark.block).tangent();
    expect(landmark.form, e.belief.mean(landmark.block), SmallMatrix::Identity(errors, errors),
           landmark.block);
  }
  for (std::size_t j = 0; j < e.vehicles.size(); ++j) {
    if (j == i) continue;
    const AnyPoint other =
        position_of(team_.members[j].motion, e.belief.mean(e.vehicles[j].block), dimensions);
    expect({}, other.position, other.J, e.vehicles[j].block);
  }
}

TeamDecision::Scored TeamDecision::compare(const TeamEstimate& e, std::size_t i) {
  Scored out{{}, actions_.size() - 1};
  for (const Translation& action : actions_) {
    const SmallVector state = after(e, i, action);
    expect_looks(e, i, state);
    out.scores.push_back(
        information_(e.belief, imagine(team_.members[i], e.vehicles[i].block, state, settings_), looks_));
  }
  for (std::size_t a = 0; a < actions_.size(); ++a)
    if (allowed(pose_of(team_.members[i].motion, after(e, i, actions_[a])).position) &&
        out.scores[a] > out.scores[out.best])
      out.best = a;
  return out;
}

Goal TeamDecision::choose(const TeamEstimate& e, const Tick& tick) {
  goal_.decided = false;
  if (actions_.empty()) return goal_;
  if (!e.started || e.status.state == TrackingState::lost) return goal_ = {};
  if (goal_.chosen >= 0 && tick.t < goal_.end_t - 1e-9) return goal_;
  goal_.team.clear();
  for (std::size_t i = 0; i < e.vehicles.size(); ++i) {
    const Scored scored = compare(e, i);
    const SmallVector state = after(e, i, actions_[scored.best]);
    const Eigen::Vector3d place = pose_of(team_.members[i].motion, state).position;
    goal_.team.emplace_back(place.x(), place.y(), place.z(), heading_by(team_.members[i].motion, state));
    if (i > 0) continue;
    goal_.scores = scored.scores;
    goal_.chosen = static_cast<int>(scored.best);
    goal_.from = e.vehicles.front().pose.position;
    goal_.to = place;
  }
  goal_.decided = true;
  goal_.start_t = tick.t;
  goal_.end_t = tick.t + settings_.decision.period_s;
  return goal_;
}

}  // namespace incognita
