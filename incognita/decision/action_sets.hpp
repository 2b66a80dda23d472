// Action sets, and the state and error growth that each action leads to.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <vector>

#include "incognita/belief/linearized.hpp"
#include "incognita/decision/actions.hpp"
#include "incognita/models/motion/mount.hpp"
#include "incognita/slam/features/settings.hpp"

namespace incognita {

/// Predicted result of an action.
struct ActionOutcome {
  BlockVector state;
  BlockMatrix A, N;  ///< error after = A * error before + noise of covariance N
  /// Bound violation at the end, m; violating actions are scored, but chosen only if all violate.
  double outside_m = 0;
  bool allowed() const { return outside_m <= 0; }
};

class ActionSet {
 public:
  virtual ~ActionSet() = default;
  virtual int count() const = 0;
  virtual int stay() const = 0;  ///< index of the action that changes nothing
  virtual ActionOutcome after(const BlockVector& state, int action) const = 0;
};

/// World bounds that no action may end outside of, m.
struct WorldBounds {
  Eigen::Vector3d min_m{-1e9, -1e9, -1e9}, max_m{1e9, 1e9, 1e9};
  /// Distance outside along the worst axis, m; 0 inside.
  double outside_m(const Eigen::Vector3d& position) const {
    return std::max({0.0, (min_m - position).maxCoeff(), (position - max_m).maxCoeff()});
  }
};

/// The orientation turned about the world's vertical, to the left.
Eigen::Vector4d turned_left(const Eigen::Vector4d& world_from_camera, double rad);

/// Index of the action without displacement or change. Throws std::invalid_argument if there is none, since
/// it is the fallback when no action is allowed.
int find_stay(const std::vector<Translation>& actions);
int find_stay(const std::vector<SpeedChange>& actions);

/// Error growth of a free camera over `period_s` under unknown accelerations: constant velocity model,
/// linearized at rest, in 15 steps (the frame rate of the thesis is 15 Hz). Commanded accelerations do not
/// enter, so the growth is the same for all actions.
struct Growth {
  FreeCameraMotion::Jacobian A, N;
};
Growth growth_over(double period_s, double sigma_acceleration_m_s2, double sigma_angular_acceleration_rad_s2);

/// Translations of a free camera along its heading and gravity, from rest to rest (thesis 6.3.1). Meanwhile
/// the gaze keeps turning left at `gaze_rate_rad_s`.
class Translations final : public ActionSet {
 public:
  /// Throws std::invalid_argument if no action has zero displacement.
  Translations(std::vector<Translation> actions, double period_s, const Growth& growth,
               const WorldBounds& bounds);
  int count() const override { return static_cast<int>(actions_.size()); }
  int stay() const override { return stay_; }
  ActionOutcome after(const BlockVector& state, int action) const override;

  /// How the gaze turns meanwhile: to the left, and up until `max_elevation_rad`, where it turns back; 0: it stays level.
  void turn_at(double left_rad_s, double up_rad_s = 0, double max_elevation_rad = 0) {
    gaze_rate_rad_s_ = left_rad_s;
    elevation_rate_rad_s_ = up_rad_s;
    max_elevation_rad_ = max_elevation_rad;
  }
  const std::vector<Translation>& actions() const { return actions_; }

 private:
  std::vector<Translation> actions_;
  double period_s_;
  Growth growth_;
  WorldBounds bounds_;
  int stay_;
  double gaze_rate_rad_s_ = 0, elevation_rate_rad_s_ = 0, max_elevation_rad_ = 0;
};

/// Turns of a free camera's gaze about the vertical: right, left, stay (thesis 6.3.1), at `rate_rad_s` for
/// `ahead_s`, while the position continues at its current velocity.
class Turns final : public ActionSet {
 public:
  Turns(double rate_rad_s, double ahead_s, const Growth& growth);
  int count() const override { return 3; }
  int stay() const override { return 2; }
  ActionOutcome after(const BlockVector& state, int action) const override;
  /// Rate to the left, rad/s.
  double rate_of(int action) const { return action == 0 ? -rate_rad_s_ : action == 1 ? rate_rad_s_ : 0; }

 private:
  double rate_rad_s_, ahead_s_;
  Growth growth_;
};

/// Changes of a vehicle's speed and turn rate (Table 6.1). The state is that of the carried camera (13
/// numbers of a free camera). The vehicle is predicted to continue on the plane of its current tilt, thesis
/// (6.10), since the ground ahead is unknown.
class SpeedChanges final : public ActionSet {
 public:
  /// `growth`: over one period. `bounds`: only x and y are used. Speeds are clamped to `max_speed_m_s` and
  /// `max_turn_rate_rad_s`. Throws std::invalid_argument if no change is (0, 0).
  SpeedChanges(std::vector<SpeedChange> actions, double period_s, const Growth& growth,
               const WorldBounds& bounds, const Mount& mount, double max_speed_m_s,
               double max_turn_rate_rad_s);
  int count() const override { return static_cast<int>(actions_.size()); }
  int stay() const override { return stay_; }
  /// `state`: 13 numbers of the camera, then the speed (m/s) and turn rate (rad/s) of the vehicle.
  ActionOutcome after(const BlockVector& state, int action) const override;
  /// The state `s` seconds after the action began, at most one period.
  BlockVector along(const BlockVector& state, int action, double s) const;
  /// Bound violation of a state, m.
  double outside_m(const BlockVector& state) const { return bounds_.outside_m(state.head<3>()); }
  /// Speed and turn rate after the action, clamped.
  Eigen::Vector2d after(const Eigen::Vector2d& speeds, int action) const;

  const std::vector<SpeedChange>& actions() const { return actions_; }

 private:
  std::vector<SpeedChange> actions_;
  double period_s_;
  Growth growth_;
  WorldBounds bounds_;
  Mount mount_;
  double max_speed_m_s_, max_turn_rate_rad_s_;
  int stay_;
};

}  // namespace incognita
