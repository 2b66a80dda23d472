#include "incognita/decision/free_camera_choice.hpp"

#include <algorithm>
#include <cmath>

#include "incognita/math/angles.hpp"
#include "incognita/models/motion/heading.hpp"

namespace incognita {
namespace {

using Gaze = DecisionSettings::Gaze;

Metric gaze_metric(Gaze gaze) {
  if (gaze == Gaze::fisher) return Metric::fisher;
  return gaze == Gaze::fisher_given_state ? Metric::fisher_given_state : Metric::state;
}

bool compares_turns(Gaze gaze) {
  return gaze == Gaze::mutual_information || gaze == Gaze::fisher || gaze == Gaze::fisher_given_state;
}

}  // namespace

Mobility free_mobility(const DecisionSettings& s, double delay_s) {
  const std::vector<Translation> actions = translations_of(s);
  const bool climbs = std::ranges::any_of(actions, [](const auto& a) { return a.displacement_m.z() != 0; });
  Mobility can;
  can.axes = climbs ? 3 : 2;
  can.step_m = longest_m(actions);
  can.speed_m_s = can.step_m / s.period_s;
  can.turn_rate_rad_s = s.gaze_rate_rad_s;
  constexpr double soon = 0.4;  // of a period: half of the way takes half of the period
  can.arrives = delay_s <= soon * s.period_s;
  return can;
}

FreeCameraChoice::FreeCameraChoice(const DecisionSettings& s, double sigma_acceleration_m_s2,
                                   double sigma_angular_acceleration_rad_s2, std::uint64_t seed,
                                   std::size_t who, double delay_s)
    : settings_(s),
      translations_(translations_of(s), s.period_s,
                    growth_over(s.period_s, sigma_acceleration_m_s2, sigma_angular_acceleration_rad_s2),
                    {s.min_bound_m, s.max_bound_m}),
      turns_(s.gaze_rate_rad_s, s.gaze_ahead_s,
             growth_over(s.gaze_ahead_s, sigma_acceleration_m_s2, sigma_angular_acceleration_rad_s2)),
      choice_(s, names_of(translations_.actions()), seed, 3, who, free_mobility(s, delay_s)),
      gaze_({gaze_metric(s.gaze), 1, turns_.count(), 3}) {}

void FreeCameraChoice::forget() {
  choice_.forget();
  looking_ = false;
}

/// Up and down between the largest elevations at the rate of the gaze.
void FreeCameraChoice::nod(double dt) {
  if (settings_.max_elevation_rad == 0) return;
  if (elevation_rate_rad_s_ == 0) elevation_rate_rad_s_ = settings_.gaze_rate_rad_s;
  elevation_rad_ += elevation_rate_rad_s_ * dt;
  if (std::abs(elevation_rad_) < settings_.max_elevation_rad) return;
  elevation_rad_ = std::copysign(settings_.max_elevation_rad, elevation_rad_);
  elevation_rate_rad_s_ = -std::copysign(settings_.gaze_rate_rad_s, elevation_rad_);
}

/// Turns to a direction as fast as the gaze may, and then follows it.
void FreeCameraChoice::look_at(const GazeDirection& wanted, double dt) {
  const double at_once_s = std::max(dt, settings_.gaze_period_s), most = settings_.gaze_rate_rad_s;
  heading_rate_rad_s_ = std::clamp(wrap_angle(wanted.heading_rad - heading_rad_) / at_once_s, -most, most);
  if (settings_.max_elevation_rad == 0) return;
  elevation_rad_ = std::clamp(elevation_rad_ + elevation_rate_rad_s_ * dt, -settings_.max_elevation_rad,
                              settings_.max_elevation_rad);
  elevation_rate_rad_s_ = std::clamp((wanted.elevation_rad - elevation_rad_) / at_once_s, -most, most);
}

/// Chooses the rate of the heading anew every gaze period.
void FreeCameraChoice::compare_turns(const AnyBelief& belief, BlockId vehicle, const CameraState& camera,
                                     const Expectation& expectation, double t) {
  gaze_t_ = t;
  const std::vector<double>& scores = gaze_.scores(belief, vehicle, camera, turns_, expectation);
  heading_rate_rad_s_ = turns_.rate_of(best_of(scores, gaze_.allowed(), turns_.stay()));
}

/// Returns whether it begins to look in this tick; else integrates the heading at the current rate.
bool FreeCameraChoice::begin_to_look(const CameraState& camera, double dt) {
  if (looking_) {
    heading_rad_ += heading_rate_rad_s_ * dt;
    return false;
  }
  heading_rad_ = heading_of(free_camera::orientation(camera));
  elevation_rad_ = settings_.max_elevation_rad > 0 ? elevation_of(free_camera::orientation(camera)) : 0;
  heading_rate_rad_s_ = settings_.gaze == Gaze::constant_rate ? settings_.gaze_rate_rad_s : 0;
  return looking_ = true;
}

void FreeCameraChoice::choose(const AnyBelief& belief, const Body& body, const Expectation& expectation,
                              const Surroundings& surroundings, const Tick& tick, BodyGoal& goal) {
  const CameraState camera = belief.mean(body.block);
  const std::optional<GazeDirection> wanted = choice_.gaze(camera, translations_, tick, surroundings);
  if (wanted || settings_.gaze != Gaze::swing) {
    const bool begins = begin_to_look(camera, tick.dt);
    if (wanted) {
      look_at(*wanted, tick.dt);
    } else {
      if (compares_turns(settings_.gaze) && (begins || has_come(gaze_t_ + settings_.gaze_period_s, tick.t)))
        compare_turns(belief, body.block, camera, expectation, tick.t);
      nod(tick.dt);
    }
    goal.heading_rad = heading_rad_;
    goal.heading_rate_rad_s = heading_rate_rad_s_;
    goal.elevation_rad = elevation_rad_;
    goal.elevation_rate_rad_s = elevation_rate_rad_s_;
    translations_.turn_at(heading_rate_rad_s_, elevation_rate_rad_s_, settings_.max_elevation_rad);
  } else {
    goal.heading_rad.reset();  // an earlier strategy may have turned the gaze
    translations_.turn_at(0);
  }
  goal.decided = choice_.choose(belief, body.block, camera, translations_, expectation, tick, surroundings);
  goal.scores = choice_.scores();
  goal.chosen = choice_.chosen();
  if (!goal.decided) return;
  goal.from = free_camera::position(camera);
  goal.to = translations_.after(camera, goal.chosen).state.head<3>();
  goal.start_t = tick.t;
  goal.end_t = choice_.end_t();
}

}  // namespace incognita
