// How viewers control the loop: their commands arrive in one thread, and take effect between two ticks in another.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/live/page_channel.hpp"
#include "incognita/live/viewer_commands.hpp"
#include "incognita/messages/tick.hpp"

namespace incognita {

class LiveControl {
 public:
  /// `interrupted`: whether the program is to end; asked about 20 times per second while waiting.
  explicit LiveControl(std::function<bool()> interrupted) : interrupted_(std::move(interrupted)) {}

  // From the thread of the server:

  /// Throws InputError for an intervention or a save when no run goes on.
  void command(const ViewerCommand& command);

  // From the thread of the loop:

  /// A run begins, not paused, at the speed of the last one; at first in real time. Not `paced`: the world sets the pace, as a
  /// live camera does.
  void begin(bool paced = true);
  /// The run has a robot: `stop` stops and releases it, and is called at once, in the server's thread.
  void set_robot(std::function<void(bool)> stop);
  /// The run can be saved: `request` asks for that, and is called in the server's thread.
  void set_saving(std::function<void()> request);
  /// Waits for the time of this tick, or for a step or the end of a pause. False if the run is to end. `meanwhile`, if given, is
  /// called again and again, about 20 times per second; commands are taken while it works.
  bool wait_for(const Tick& tick, const std::function<void()>& meanwhile = {});
  /// Whether the run is to end; does not wait.
  bool is_ending();
  /// The interventions since the last call, in their order.
  std::vector<Intervention> take_interventions();
  /// The run has ended, as `RunStatus` says.
  void end(const std::string& status, const std::string& reason);
  /// Waits until a viewer starts another run. None: the program is to end.
  std::optional<StartRun> wait_for_start();

  /// Called from either thread after each change of the state; must not call back.
  std::function<void(const LiveState&)> on_change = {};

 private:
  using Clock = std::chrono::steady_clock;
  struct Change;
  void changed();
  /// Wall time at which run time `t` is due; none while as fast as possible.
  std::optional<Clock::time_point> due(double t);

  std::function<bool()> interrupted_;
  std::mutex mutex_;
  std::condition_variable woken_;
  LiveState state_;
  int steps_ = 0;  ///< frames to do while paused
  bool stop_ = false, paced_ = true;
  std::function<void(bool)> stop_robot_;  ///< empty without a robot
  std::function<void()> request_save_;    ///< empty without a run
  std::vector<Intervention> interventions_;
  std::optional<StartRun> start_;
  std::optional<std::pair<Clock::time_point, double>> anchor_;  ///< a wall time and its run time, s
};

}  // namespace incognita
