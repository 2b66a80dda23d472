#include "incognita/decision/decision.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "incognita/decision/extended_entropy.hpp"
#include "incognita/decision/free_camera_choice.hpp"
#include "incognita/decision/ground_choice.hpp"
#include "incognita/decision/image_expectation.hpp"
#include "incognita/decision/point_expectation.hpp"
#include "incognita/slam/mapper/entropy_values.hpp"

namespace incognita {
namespace {

struct AccelerationNoise {
  double linear_m_s2, angular_rad_s2;
};

std::unique_ptr<BodyChoice> choice_of_camera(const ActiveSettings& s, const AccelerationNoise& sigma,
                                             std::size_t who) {
  if (s.carrier)
    return std::make_unique<CarrierChoice>(s.decision, *s.carrier, sigma.linear_m_s2, sigma.angular_rad_s2,
                                           s.seed, who);
  return std::make_unique<FreeCameraChoice>(s.decision, sigma.linear_m_s2, sigma.angular_rad_s2, s.seed, who);
}

std::unique_ptr<BodyChoice> choice_of_body(const ActiveSettings& s, const BodyModel& body, std::size_t who) {
  if (traits_of(body.motion).in_space())
    return choice_of_camera(s, {body.input_sigmas[0], body.input_sigmas[3]}, who);
  return std::make_unique<GroundChoice>(s.decision, body, s.tick_s, s.seed, who);
}

}  // namespace

Decision::Decision(std::vector<std::unique_ptr<BodyChoice>> choices,
                   std::unique_ptr<MapExpectation> expectation, const ExplorationSettings& exploration,
                   std::uint64_t seed)
    : choices_(std::move(choices)), expectation_(std::move(expectation)), exploration_(exploration, seed) {
  if (choices_.empty())
    throw std::invalid_argument("a decision needs one choice per body, and there is none");
  goal_.bodies.resize(choices_.size());
}

void Decision::forget() {
  for (std::size_t i = 0; i < choices_.size(); ++i) {
    choices_[i]->forget();
    BodyGoal& goal = goal_.bodies[i];
    goal.scores.assign(choices_[i]->names().size(), 0);
    goal.chosen = -1;
    goal.decided = false;
    goal.drive.reset();
  }
}

void Decision::explore(const Estimate& estimate, const Tick& tick) {
  if (exploration_.settings().expected_landmarks == 0) return;
  const double share = tick.dt / static_cast<double>(choices_.size());
  for (std::size_t i = 0; i < choices_.size(); ++i) {
    const BlockVector state = estimate.belief.mean(estimate.bodies[i].block);
    exploration_.update(
        [&](const Eigen::Vector3d& position) { return expectation_->in_view(i, state, position); }, share,
        estimate.mapped_count());
  }
  goal_.coverage = exploration_.coverage();
}

Goal Decision::choose(const Estimate& estimate, const Observation&, const Tick& tick) {
  if (!estimate.started || estimate.status.state == TrackingState::lost) {
    forget();
    return goal_;
  }
  explore(estimate, tick);
  bool decided = false;
  for (std::size_t i = 0; i < choices_.size(); ++i) {
    expectation_->prepare(estimate, i, exploration_.expected(), exploration_.settings().variance_expected_m2);
    choices_[i]->choose(estimate.belief, estimate.bodies[i], *expectation_, tick, goal_.bodies[i]);
    decided |= goal_.bodies[i].decided;
  }
  if (decided && exploration_.settings().expected_landmarks > 0 &&
      (!entropy_due_t_ || has_come(*entropy_due_t_, tick.t))) {
    goal_.entropy_extended = extended_entropy(estimate, exploration_.settings());
    entropy_due_t_ = tick.t + entropy_period_s(estimate.belief.errors());
  }
  return goal_;
}

std::unique_ptr<Decision> decide_by_images(const Camera& camera, const CameraSlamSettings& slam,
                                           const ActiveSettings& s) {
  std::vector<std::unique_ptr<BodyChoice>> choices;
  choices.push_back(choice_of_camera(
      s, {slam.filter.sigma_acceleration_m_s2, slam.filter.sigma_angular_acceleration_rad_s2}, 0));
  const bool as_mapped = s.exploration.counted == ExplorationSettings::Counted::as_mapped;
  return std::make_unique<Decision>(
      std::move(choices), std::make_unique<ImageExpectation>(camera, slam, as_mapped), s.exploration, s.seed);
}

std::unique_ptr<Decision> decide_by_points(const EstimatorSettings& team, const ActiveSettings& s) {
  if (team.filter.map_frame == MapFrame::vehicle)
    throw std::invalid_argument(
        "estimator.map_frame = `vehicle`: information gain is predicted in the world frame; take `world`");
  for (const BodyModel& body : team.bodies)
    if (body.sensors.empty() || body.input_sigmas.size() != inputs_of(body.motion))
      throw std::invalid_argument(
          "a decision by points needs a point sensor on every body, and a sigma for each of its inputs");
  std::vector<std::unique_ptr<BodyChoice>> choices;
  for (const BodyModel& body : team.bodies) choices.push_back(choice_of_body(s, body, choices.size()));
  return std::make_unique<Decision>(std::move(choices),
                                    std::make_unique<PointExpectation>(team.bodies, s.max_measurements),
                                    s.exploration, s.seed);
}

}  // namespace incognita
