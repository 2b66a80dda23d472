// Whether the viewers who drive bodies by hand are still there: a drive command holds for a short time only, unless its viewer
// renews it. The watchdog of a robot's own side is in live/robot.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "incognita/live/viewer_commands.hpp"

namespace incognita {

/// Time is explicit: it is that of the caller's clock. Viewers are identified by numbers.
class DriveWatchdog {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit DriveWatchdog(std::chrono::steady_clock::duration holds) : holds_(holds) {}

  /// Whether the command only repeats what this viewer asks for already. Such a command is no further one; the one that it repeats
  /// holds on, unless another viewer has commanded the body since.
  bool renews(std::uint64_t viewer, const ViewerCommand& command, Time now);
  /// A command that is no repetition has been accepted.
  void accept(std::uint64_t viewer, const ViewerCommand& command, Time now);
  /// What this viewer commanded is overdue.
  void leave(std::uint64_t viewer);
  /// Nobody drives any more: the run has ended.
  void clear() { drives_.clear(); }

  /// The bodies whose last command holds no longer, and which are to be stopped.
  std::vector<std::size_t> overdue(Time now);
  /// Such a body was stopped.
  void stopped(std::size_t body);
  /// When a command will be overdue if it is not renewed; none: nobody drives.
  std::optional<Time> next() const;

 private:
  struct Drive {
    DriveBody command;
    Time until;
    bool superseded = false;  ///< another viewer has commanded the body since
  };

  std::chrono::steady_clock::duration holds_;
  std::map<std::pair<std::uint64_t, std::size_t>, Drive> drives_;  ///< by viewer and body; none is at rest
};

}  // namespace incognita
