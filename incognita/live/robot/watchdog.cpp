#include "incognita/live/robot/watchdog.hpp"

#include <cmath>
#include <stdexcept>

namespace incognita {

CommandWatchdog::CommandWatchdog(const Settings& settings) : settings_(settings) {
  if (!(settings.timeout_s > 0 && std::isfinite(settings.timeout_s) && settings.stale_s > 0 &&
        std::isfinite(settings.stale_s)))
    throw std::invalid_argument("the times of a watchdog must be positive and finite");
}

void CommandWatchdog::command(const Velocity& velocity, double now_s, std::uint64_t who,
                              std::optional<double> age_s) {
  if (is_held()) return;
  who_ = who;
  if (age_s && !(std::abs(*age_s) <= settings_.stale_s)) {
    stopped_ = Stop::stale;
    return;
  }
  if (!velocity.allFinite()) {
    stopped_ = Stop::invalid;
    return;
  }
  velocity_ = velocity;
  last_command_s_ = now_s;
  stopped_ = Stop::none;
}

void CommandWatchdog::disconnected(std::uint64_t who) {
  if (who == who_ && !is_held() && last_command_s_) stopped_ = Stop::disconnected;
}

void CommandWatchdog::unreadable(std::uint64_t who) {
  if (who == who_ && !is_held() && last_command_s_) stopped_ = Stop::invalid;
}

void CommandWatchdog::stop() {
  if (!is_held()) stopped_ = Stop::by_hand;
}

void CommandWatchdog::release() {
  if (stopped_ == Stop::by_hand) stopped_ = Stop::no_command;
}

CommandWatchdog::Stop CommandWatchdog::reason(double now_s) const {
  if (stopped_ != Stop::none) return stopped_;
  // Not by the difference, whose rounding could let the robot drive past the sum. Also for a clock that jumps back
  const double from_s = *last_command_s_ - settings_.timeout_s,
               until_s = *last_command_s_ + settings_.timeout_s;
  return from_s < now_s && now_s < until_s ? Stop::none : Stop::silence;
}

const char* name(CommandWatchdog::Stop stop) {
  switch (stop) {
    case CommandWatchdog::Stop::none:
      return "driving";
    case CommandWatchdog::Stop::no_command:
      return "no command";
    case CommandWatchdog::Stop::silence:
      return "silence";
    case CommandWatchdog::Stop::disconnected:
      return "disconnected";
    case CommandWatchdog::Stop::stale:
      return "stale";
    case CommandWatchdog::Stop::invalid:
      return "invalid command";
    case CommandWatchdog::Stop::by_hand:
      return "stopped by hand";
    case CommandWatchdog::Stop::ended:
      return "ended";
  }
  return "unknown";
}

}  // namespace incognita
