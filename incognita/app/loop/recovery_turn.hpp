// What a lost robot does to recognize its map again: it turns in place, since what is in the map may be out of view.
#pragma once

namespace incognita {

class StateArchive;

struct RecoveryTurnSettings {
  double rate_rad_s = 0;  ///< 0: it stands
  double after_s = 2;     ///< for which it stands first: what is in view is recognized best at rest
};

class RecoveryTurn {
 public:
  /// Throws std::invalid_argument if a setting is negative or not finite.
  explicit RecoveryTurn(const RecoveryTurnSettings& settings);

  /// A turn rate, rad/s, that was sent while the pose was known, or by a person.
  void drove(double turn_rate_rad_s);
  /// The turn rate, rad/s, for a lost robot; called once for each image of it, `dt_s` after the one before. Against the way it turned
  /// last, as that was not mapped when navigation was resumed from an earlier state. 0 at first, and after two turns in vain.
  double rate(double dt_s);
  /// Where a run is resumed the turn begins anew.
  void state(StateArchive& archive);

 private:
  RecoveryTurnSettings settings_;
  double direction_ = 1;  ///< 1: to the left, -1: to the right
  double lost_s_ = 0;
};

}  // namespace incognita
