// What can be done next, and what each action makes of a vehicle's state and of how sure it is.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <vector>

#include "incognita/belief/linearized.hpp"
#include "incognita/decision/actions.hpp"
#include "incognita/models/mount.hpp"
#include "incognita/slam/features/settings.hpp"

namespace incognita {

/// Where an action leads.
struct ActionOutcome {
  BlockVector state;
  BlockMatrix A, N;      ///< error after = A * error before + noise of covariance N
  double outside_m = 0;  ///< how far it ends out of bounds: told what it would teach, chosen where all do
  bool allowed() const { return outside_m <= 0; }
};

class ActionSet {
 public:
  virtual ~ActionSet() = default;
  virtual int count() const = 0;
  virtual int stay() const = 0;  ///< which of them changes nothing
  virtual ActionOutcome after(const BlockVector& state, int action) const = 0;
};

/// Bounds of the world that no action may end outside of, m.
struct WorldBounds {
  Eigen::Vector3d min_m{-1e9, -1e9, -1e9}, max_m{1e9, 1e9, 1e9};
  /// Along the axis where it is farthest out; 0 inside.
  double outside_m(const Eigen::Vector3d& position) const {
    return std::max({0.0, (min_m - position).maxCoeff(), (position - max_m).maxCoeff()});
  }
};

/// Which of the actions stays. Throws std::invalid_argument when none does: what would be done where nothing
/// is allowed?
int find_stay(const std::vector<Translation>& actions);
int find_stay(const std::vector<SpeedChange>& actions);

/// How the error of a free camera grows over `period_s` under accelerations nobody knows: the constant
/// velocity model at rest, in the 15 steps of the thesis' 15 frames a second. Commanded accelerations do not
/// enter, so it is the same for every action.
struct Growth {
  FreeCameraMotion::Jacobian A, N;
};
Growth growth_over(double period_s, double sigma_acceleration_m_s2, double sigma_angular_acceleration_rad_s2);

/// Translations of a free camera along its heading and gravity, from rest to rest: thesis 6.3.1. The gaze
/// goes on turning as it does, `gaze_rate_rad_s` to the left.
class Translations final : public ActionSet {
 public:
  /// Throws std::invalid_argument when none of the actions stays.
  Translations(std::vector<Translation> actions, double period_s, const Growth& growth,
               const WorldBounds& bounds);
  int count() const override { return static_cast<int>(actions_.size()); }
  int stay() const override { return stay_; }
  ActionOutcome after(const BlockVector& state, int action) const override;

  void turn_at(double rad_s) { gaze_rate_rad_s_ = rad_s; }
  const std::vector<Translation>& actions() const { return actions_; }

 private:
  std::vector<Translation> actions_;
  double period_s_;
  Growth growth_;
  WorldBounds bounds_;
  int stay_;
  double gaze_rate_rad_s_ = 0;
};

/// Turns of a free camera's gaze about the vertical: right, left, stay (thesis 6.3.1), at `rate_rad_s` for
/// `ahead_s`, while its position goes on at the velocity that it has.
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

/// Changes of a vehicle's speed and turn rate (Table 6.1). The vehicle carries the camera whose state is told
/// (13 numbers of a free camera); it is imagined to go on along the ground as it is tilted now, thesis
/// (6.10), since it does not know the ground ahead.
class SpeedChanges final : public ActionSet {
 public:
  /// `growth`: over the period; `bounds`: along x and y. `max_speed_m_s`, `max_turn_rate_rad_s`: what is
  /// faster is cut off. Throws std::invalid_argument when none of the changes is (0, 0).
  SpeedChanges(std::vector<SpeedChange> actions, double period_s, const Growth& growth,
               const WorldBounds& bounds, const Mount& mount, double max_speed_m_s,
               double max_turn_rate_rad_s);
  int count() const override { return static_cast<int>(actions_.size()); }
  int stay() const override { return stay_; }
  /// `state`: of the camera, and its last two numbers behind the 13 the speed and turn rate of the vehicle.
  ActionOutcome after(const BlockVector& state, int action) const override;
  /// Speed and turn rate that an action leads to.
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
