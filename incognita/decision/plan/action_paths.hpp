// What a plan is made of: actions of one period each, with the state along their way; those of a free camera join motion and gaze.
#pragma once

#include <string>
#include <vector>

#include "incognita/decision/action_sets.hpp"
#include "incognita/decision/actions.hpp"

namespace incognita {

class ActionPaths {
 public:
  virtual ~ActionPaths() = default;
  virtual int count() const = 0;
  virtual int stay() const = 0;
  /// The action that goes on as this one did for another period.
  virtual int then(int action) const = 0;
  /// `state` begins with that of the camera, 13 numbers; the state `s` seconds after the action began, at most one period.
  virtual BlockVector along(const BlockVector& state, int action, double s) const = 0;
  /// Bound violation of a state, m.
  virtual double outside_m(const BlockVector& state) const = 0;
};

/// Every translation of a free camera with every turn of its gaze: none, to the left, to the right, and, where it need not be
/// level, up and down.
class JointActions final : public ActionPaths {
 public:
  /// Throws std::invalid_argument if no translation has zero displacement.
  JointActions(std::vector<Translation> translations, double period_s, double gaze_rate_rad_s,
               double max_elevation_rad, const WorldBounds& bounds);
  int count() const override { return static_cast<int>(translations_.size()) * turns_; }
  int stay() const override { return stay_ * turns_; }
  int then(int action) const override { return action; }
  BlockVector along(const BlockVector& state, int action, double s) const override;
  double outside_m(const BlockVector& state) const override;

  /// To the left and up, rad/s.
  Eigen::Vector2d rates_of(int action) const;
  /// `go_left`, `go_left_turning_left` and so on of each translation.
  std::vector<std::string> names() const;
  double max_elevation_rad() const { return max_elevation_rad_; }

 private:
  std::vector<Translation> translations_;
  double period_s_, gaze_rate_rad_s_, max_elevation_rad_;
  WorldBounds bounds_;
  int stay_, turns_;
};

/// The changes of speed of a vehicle that carries a camera.
class DriveActions final : public ActionPaths {
 public:
  explicit DriveActions(const SpeedChanges& changes) : changes_(changes) {}
  int count() const override { return changes_.count(); }
  int stay() const override { return changes_.stay(); }
  int then(int) const override { return changes_.stay(); }
  BlockVector along(const BlockVector& state, int action, double s) const override {
    return changes_.along(state, action, s);
  }
  double outside_m(const BlockVector& state) const override { return changes_.outside_m(state); }

 private:
  const SpeedChanges& changes_;
};

}  // namespace incognita
