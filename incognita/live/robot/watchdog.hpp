// Stops a robot whose commands do not come: the part that runs on the robot's side of the link.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace incognita {

/// Decides which velocity a robot drives with. Time is explicit: seconds on any clock that does not jump, such as the one since the
/// program started.
class CommandWatchdog {
 public:
  struct Settings {
    double timeout_s = 0.5;  ///< the robot stops if no command comes for so long
    double stale_s = 0.5;    ///< a command that was stamped longer ago does not count
  };
  /// Why the robot stands still.
  enum class Stop {
    none,          ///< it drives as commanded
    no_command,    ///< none has come yet
    silence,       ///< no command for timeout_s
    disconnected,  ///< the connection of the commander ended
    stale,         ///< the last command was stamped longer than stale_s ago
    invalid,       ///< the last command was not finite, or could not be read
    by_hand,       ///< somebody stopped it; until released
    ended          ///< the program that passes commands on ends
  };
  /// Speed, m/s, and turn rate, rad/s, to the left.
  using Velocity = Eigen::Vector2d;

  explicit CommandWatchdog(const Settings& settings);

  /// A command of commander `who` came. `age_s`: since its stamp, by the robot's clock; none without a stamp. A stamp in the future
  /// by more than stale_s is as bad as one in the past. Such a command, and one that is not finite, stops the robot until the next.
  void command(const Velocity& velocity, double now_s, std::uint64_t who, std::optional<double> age_s = {});
  /// The connection of `who` ended; stops the robot if the last command was theirs.
  void disconnected(std::uint64_t who);
  /// A message of `who` could not be read, and may have been a command; stops the robot if the last command was theirs.
  void unreadable(std::uint64_t who);
  /// Stops the robot until release() and a fresh command after it.
  void stop();
  void release();
  /// Stops the robot for good.
  void end() { stopped_ = Stop::ended; }

  /// To drive with at this time.
  Velocity velocity(double now_s) const { return reason(now_s) == Stop::none ? velocity_ : Velocity(0, 0); }
  Stop reason(double now_s) const;
  /// Time of the last command that counted; none before the first.
  std::optional<double> last_command_s() const { return last_command_s_; }

 private:
  bool is_held() const { return stopped_ == Stop::by_hand || stopped_ == Stop::ended; }

  Settings settings_;
  Velocity velocity_{0, 0};
  std::optional<double> last_command_s_;
  std::uint64_t who_ = 0;
  Stop stopped_ = Stop::no_command;  ///< until a fresh command; `none` while driving
};

const char* name(CommandWatchdog::Stop stop);

}  // namespace incognita
