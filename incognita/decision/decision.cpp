#include "incognita/decision/decision.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "incognita/decision/extended_entropy.hpp"
#include "incognita/decision/free_camera_choice.hpp"
#include "incognita/decision/ground_choice.hpp"
#include "incognita/decision/image_expectation.hpp"
#include "incognita/decision/plan/planned_choice.hpp"
#include "incognita/decision/point_expectation.hpp"
#include "incognita/slam/mapper/entropy_values.hpp"

namespace incognita {
namespace {

std::unique_ptr<BodyChoice> choice_of(const ActiveSettings& s, const BodyModel& body, std::size_t who) {
  const bool in_space = traits_of(body.motion).in_space();
  if (!in_space && s.decision.strategy == DecisionSettings::Strategy::plan)
    throw std::invalid_argument(
        "decision.strategy: `plan` needs a free camera or a vehicle that carries one; take another");
  if (!in_space && s.exploration.placed == ExplorationSettings::Placed::on_sides)
    throw std::invalid_argument(
        "exploration.placed: `on-sides` needs bodies that move in space; take `in-volume`");
  if (!in_space) return std::make_unique<GroundChoice>(s.decision, body, s.tick_s, s.seed, who);
  const double sigma_m_s2 = body.input_sigmas[0], sigma_rad_s2 = body.input_sigmas[3];
  if (s.decision.strategy == DecisionSettings::Strategy::frontier && s.exploration.expected_landmarks == 0)
    throw std::invalid_argument(
        "exploration.expected_landmarks: must be more than 0 with decision.strategy = `frontier`, which goes to "
        "unseen cells of the exploration volume");
  if (s.decision.strategy == DecisionSettings::Strategy::plan) {
    if (s.carrier)
      return std::make_unique<PlannedCarrierChoice>(
          s.decision, *s.carrier, mobility_of(s.decision, *s.carrier), sigma_m_s2, sigma_rad_s2);
    return std::make_unique<PlannedCameraChoice>(s.decision, free_mobility(s.decision, s.delay_s), sigma_m_s2,
                                                 sigma_rad_s2);
  }
  if (s.carrier)
    return std::make_unique<CarrierChoice>(s.decision, *s.carrier, sigma_m_s2, sigma_rad_s2, s.seed, who);
  return std::make_unique<FreeCameraChoice>(s.decision, sigma_m_s2, sigma_rad_s2, s.seed, who, s.delay_s);
}

MapExpectation::OfBody sensors_of(const SlamEstimator& estimator, std::size_t which,
                                  const ActiveSettings& s) {
  const std::vector<BodyModel>& bodies = estimator.settings().bodies;
  const BodyModel& body = bodies[which];
  const bool as_mapped = s.exploration.counted == ExplorationSettings::Counted::as_mapped;
  MapExpectation::OfBody sensors;
  for (const FeatureTracker& tracker : estimator.cameras()) {
    const TrackedCamera& camera = tracker.camera();
    if (camera.body == which)
      sensors.push_back(
          std::make_unique<ImageExpectation>(camera.camera, camera.settings, as_mapped,
                                             CameraOfBody{camera.index, which, body.motion, camera.mount}));
  }
  for (std::size_t k = 0; k < body.sensors.size(); ++k)
    sensors.push_back(std::make_unique<PointExpectation>(bodies, which, k, s.max_measurements));
  return sensors;
}

}  // namespace

Decision::Decision(std::vector<std::unique_ptr<BodyChoice>> choices, MapExpectation expectation,
                   const ExplorationSettings& exploration, std::uint64_t seed, bool entropy)
    : choices_(std::move(choices)),
      expectation_(std::move(expectation)),
      exploration_(exploration, seed),
      entropy_(entropy) {
  if (choices_.empty())
    throw std::invalid_argument("a decision needs one choice per body, and there is none");
  goal_.bodies.resize(choices_.size());
  if (exploration.placed == ExplorationSettings::Placed::on_sides) sides_.emplace(exploration);
}

void Decision::forget(std::size_t body) {
  choices_[body]->forget();
  BodyGoal& goal = goal_.bodies[body];
  goal.scores.assign(choices_[body]->names().size(), 0);
  goal.chosen = -1;
  goal.decided = false;
  goal.drive.reset();
}

void Decision::restart(std::size_t body) {
  forget(body);
  goal_.bodies[body] = {};
  goal_.bodies[body].scores.assign(choices_[body]->names().size(), 0);
}

void Decision::change(std::vector<std::unique_ptr<BodyChoice>> choices) {
  bool same = choices.size() == choices_.size();
  for (std::size_t i = 0; same && i < choices.size(); ++i) same = choices[i]->names() == choices_[i]->names();
  if (!same)
    throw std::invalid_argument("these settings change the candidate actions, which are constant over a run");
  choices_ = std::move(choices);
}

/// Time since the last call, s: it may be called less often than the estimate is updated, or more often.
double Decision::since_last_call(const Tick& tick) {
  const double since_s = last_t_ ? duration_s(*last_t_, tick.t, tick.whole_us) : tick.dt;
  last_t_ = tick.t;
  return std::abs(since_s - tick.dt) < 1e-9 ? tick.dt : since_s;
}

void Decision::explore(const Estimate& estimate, const Tick& tick) {
  if (exploration_.settings().expected_landmarks == 0) return;
  const double share = tick.dt / static_cast<double>(choices_.size());
  for (std::size_t i = 0; i < choices_.size(); ++i) {
    if (is_lost(estimate, i)) continue;
    const BlockVector state = estimate.belief.mean(estimate.bodies[i].block);
    exploration_.update(
        [&](const Eigen::Vector3d& position) { return expectation_.in_view(i, state, position); }, share,
        estimate.mapped_count());
    if (sides_)
      sides_->see([&](const Eigen::Vector3d& position) { return expectation_.in_view(i, state, position); },
                  state.head<3>(), share);
  }
  if (sides_) sides_->compare(estimate);
  goal_.coverage = exploration_.coverage();
  goal_.exploration = exploration_.volume();
}

Surroundings Decision::surroundings_of(std::size_t body, const Estimate& estimate,
                                       const Observation& observation) const {
  Surroundings around;
  around.estimate = &estimate;
  around.unmapped = sides_ ? sides_->expected() : exploration_.expected();
  around.expected_var_m2 = exploration_.settings().variance_expected_m2;
  if (exploration_.settings().expected_landmarks > 0) around.seen = exploration_.volume();
  around.in_view = [this, body](const BlockVector& state, const Eigen::Vector3d& position) {
    return expectation_.in_view(body, state, position);
  };
  around.obstacles = body_of(observation, body).proximity_ranges;
  return around;
}

Goal Decision::choose(const Estimate& estimate, const Observation& observation, const Tick& now) {
  const Tick tick{now.frame, now.t, since_last_call(now), now.whole_us};
  if (!estimate.started) {
    for (std::size_t i = 0; i < choices_.size(); ++i) forget(i);
    return goal_;
  }
  explore(estimate, tick);
  bool decided = false;
  for (std::size_t i = 0; i < choices_.size(); ++i) {
    if (is_lost(estimate, i)) {
      forget(i);
      continue;
    }
    expectation_.prepare(estimate, i, sides_ ? sides_->expected() : exploration_.expected(),
                         exploration_.settings().variance_expected_m2);
    choices_[i]->choose(estimate.belief, estimate.bodies[i], expectation_,
                        surroundings_of(i, estimate, observation), tick, goal_.bodies[i]);
    decided |= goal_.bodies[i].decided;
  }
  if (entropy_ && decided && exploration_.settings().expected_landmarks > 0 &&
      (!entropy_due_t_ || has_come(*entropy_due_t_, tick.t))) {
    goal_.entropy_extended = extended_entropy(estimate, exploration_.settings());
    entropy_due_t_ = tick.t + entropy_period_s(estimate.belief.errors());
  }
  return goal_;
}

std::vector<std::unique_ptr<BodyChoice>> choices_for(const SlamEstimator& estimator,
                                                     const ActiveSettings& s) {
  std::vector<std::unique_ptr<BodyChoice>> choices;
  const std::vector<BodyModel>& bodies = estimator.settings().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) choices.push_back(choice_of(s, bodies[i], i));
  return choices;
}

std::unique_ptr<Decision> decide_for(const SlamEstimator& estimator, const ActiveSettings& s) {
  const EstimatorSettings& settings = estimator.settings();
  if (settings.filter.map_frame == MapFrame::vehicle)
    throw std::invalid_argument(
        "estimator.map_frame = `vehicle`: information gain is predicted in the world frame; take `world`");
  std::vector<MapExpectation::OfBody> sensors;
  for (std::size_t i = 0; i < settings.bodies.size(); ++i) {
    sensors.push_back(sensors_of(estimator, i, s));
    if (sensors.back().empty())
      throw std::invalid_argument("a decision needs a sensor on every body, and body " +
                                  std::to_string(i + 1) + " has none");
  }
  return std::make_unique<Decision>(choices_for(estimator, s), MapExpectation(std::move(sensors)),
                                    s.exploration, s.seed, settings.filter.entropy);
}

}  // namespace incognita
