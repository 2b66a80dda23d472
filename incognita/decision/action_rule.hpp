// A rule that picks the next action without its score: baselines with which strategies by information are compared.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "incognita/decision/action_sets.hpp"
#include "incognita/decision/exploration.hpp"
#include "incognita/decision/settings.hpp"
#include "incognita/messages/exploration_volume.hpp"
#include "incognita/messages/observation.hpp"

namespace incognita {

class StateArchive;
struct Estimate;

/// How the actions of a body move it.
struct Mobility {
  /// Numbers at the front of the state that are the position and that the actions change: x, y, z or fewer
  int axes = 3;
  bool has_gaze = true;          ///< whether the state is that of a camera
  double step_m = 0.3;           ///< longest way of one action
  double speed_m_s = 0.3;        ///< largest
  double turn_rate_rad_s = 0.2;  ///< largest, of the gaze or of the vehicle
  /// Whether it keeps moving and goes where it heads, as with Table 6.1; else an action ends at rest, in any direction
  bool drives = false;
  double yaw_rad = 0;      ///< of the camera, to the left of the direction in which it drives
  double forward_m = 0;    ///< of the position of the state, before the center of the axle
  double clearance_m = 0;  ///< distance to keep from `Surroundings::obstacles`
  /// Whether an action ends where it is predicted to end unless something stops the body
  bool arrives = true;
};

/// What a rule may use beside the state of the body. Nothing of it is true that was not measured or estimated.
struct Surroundings {
  std::shared_ptr<const ExplorationVolume> seen = {};  ///< null without an exploration prior
  /// Whether the sensors of the body would measure a landmark at a position (world, m) from a state
  std::function<bool(const BlockVector& state, const Eigen::Vector3d& position)> in_view = {};
  const Estimate* estimate = nullptr;
  std::span<const ExpectedLandmark> unmapped = {};
  double expected_var_m2 = 0;                 ///< of each of their coordinates
  std::span<const ConeRange> obstacles = {};  ///< readings of this tick; empty without such a sensor
};

struct RuleInput {
  const BlockVector& state;  ///< estimated, as the action set takes it
  const ActionSet& action_set;
  const Surroundings& surroundings;
  double t;  ///< s
};

struct GazeDirection {
  double heading_rad = 0, elevation_rad = 0;
};

class ActionRule {
 public:
  virtual ~ActionRule() = default;
  /// The next action, once per period: one that is allowed.
  virtual int choose(const RuleInput& now, const std::vector<bool>& allowed) = 0;
  /// Where the camera shall look, asked in every tick; none: the gaze is that of the settings.
  virtual std::optional<GazeDirection> gaze(const RuleInput&) { return std::nullopt; }
  /// To be called when tracking is lost: the action under way no longer counts.
  virtual void forget() = 0;
  /// Saves or restores: math/saved_state/.
  virtual void state(StateArchive& archive) = 0;
};

/// The rule of `settings.strategy`; null for strategies that are none. Throws std::invalid_argument for settings with which it
/// cannot work; the message names the setting.
std::unique_ptr<ActionRule> make_rule(const DecisionSettings& settings, const Mobility& mobility);

/// The position in a state, m; z is 0 where actions do not change it.
Eigen::Vector3d position_in(const BlockVector& state, const Mobility& mobility);

}  // namespace incognita
