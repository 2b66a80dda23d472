// The controller of a real robot: limits what its own controller commands, and sends it at once, without waiting for the next image.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "incognita/app/loop/recovery_turn.hpp"
#include "incognita/control/controller.hpp"
#include "incognita/control/velocity_limits.hpp"
#include "incognita/world/live/robot_link.hpp"

namespace incognita {

/// When commands are expected, s. Without one for `late_s` the link has sent zero by itself, as RobotClientSettings says.
struct CommandPace {
  double period_s = 0.1;
  double late_s = 0.3;
};

class RobotController final : public Controller {
 public:
  /// `controller`: of one body that takes speed and turn rate. Throws std::invalid_argument for limits that are not positive, and as
  /// RecoveryTurn does. `now`: a clock that does not jump.
  RobotController(
      std::unique_ptr<Controller> controller, std::shared_ptr<RobotLink> link, const VelocityLimits& limits,
      const CommandPace& pace = {}, const RecoveryTurnSettings& recovery = {},
      std::function<std::chrono::steady_clock::time_point()> now = std::chrono::steady_clock::now);

  /// The command that was sent. It is zero, at once and whatever the accelerations, while the image of this tick is late, the
  /// robot is stopped by hand, or the state is lost or not known yet. But a lost robot makes its recovery turn, and a person who has
  /// taken over may drive it.
  Command act(const Estimate& estimate, const Goal& goal, const Observation& observation,
              const Tick& tick) override;
  /// A robot stands still while its navigation is restarted.
  void state(StateArchive& archive) override;

 private:
  /// Nothing: it must stand.
  std::optional<Eigen::Vector2d> wanted(const Command& command, const Estimate& estimate, const Goal& goal,
                                        const Observation& observation, double dt_s);

  std::unique_ptr<Controller> controller_;
  std::shared_ptr<RobotLink> link_;
  VelocityLimits limits_;
  CommandPace pace_;
  RecoveryTurn recovery_;
  std::function<std::chrono::steady_clock::time_point()> now_;
  Eigen::Vector2d last_{0, 0};
  std::optional<std::chrono::steady_clock::time_point> driven_;  ///< when last_ was sent
};

}  // namespace incognita
