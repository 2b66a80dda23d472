#include "incognita/app/view/live_control.hpp"

#include <algorithm>
#include <utility>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::chrono::milliseconds nap{50};
constexpr double late_s = 0.25;  // a loop that is later than this does not hurry to catch up
constexpr const char* no_run = "no run is going on; start one first";
constexpr std::size_t most_interventions = 1000;
constexpr std::ptrdiff_t most_changes = 10;  // of settings: each reads the scenario again

}  // namespace

struct LiveControl::Change {
  LiveControl& on;
  void operator()(PauseRun) const { on.state_.paused = true; }
  void operator()(ResumeRun) const {
    on.state_.paused = false;
    on.anchor_.reset();
  }
  void operator()(StepRun) const {
    on.state_.paused = true;
    ++on.steps_;
  }
  void operator()(const SetSpeed& speed) const {
    on.state_.speed = speed.factor;
    on.anchor_.reset();
  }
  void operator()(StopRun) const { on.stop_ = true; }
  void operator()(const StopRobot& stop) const {
    if (!on.stop_robot_) throw InputError("this run has no robot to stop");
    on.stop_robot_(stop.stopped);
    on.state_.robot_stopped = stop.stopped;
  }
  void operator()(SaveRun) const {
    if (!on.request_save_) throw InputError(no_run);
    on.request_save_();
  }
  void operator()(const StartRun& start) const {
    on.start_ = start;
    on.stop_ = true;
  }
  void operator()(const Intervention& intervention) const {
    if (!on.state_.running) throw InputError(no_run);
    if (on.interventions_.size() >= most_interventions)
      throw InputError("too many interventions wait for the next frame; resume the run");
    const auto is_change = [](const Intervention& i) { return std::holds_alternative<ChangeDecision>(i); };
    if (is_change(intervention) &&
        std::count_if(on.interventions_.begin(), on.interventions_.end(), is_change) >= most_changes)
      throw InputError("too many changes of settings wait for the next frame; wait for it");
    on.interventions_.push_back(intervention);
  }
};

/// Under the lock, so that states are reported in their order.
void LiveControl::changed() {
  woken_.notify_all();
  if (on_change) on_change(state_);
}

void LiveControl::command(const ViewerCommand& command) {
  const std::lock_guard lock(mutex_);
  std::visit(Change{*this}, command);
  changed();
}

void LiveControl::begin(bool paced) {
  const std::lock_guard lock(mutex_);
  paced_ = paced;
  state_ = {true, false, state_.speed, "", ""};
  stop_robot_ = {};
  request_save_ = {};
  steps_ = 0;
  stop_ = start_.has_value();  // a viewer may have started yet another run while this one was loaded
  interventions_.clear();
  anchor_.reset();
  changed();
}

void LiveControl::set_robot(std::function<void(bool)> stop) {
  const std::lock_guard lock(mutex_);
  stop_robot_ = std::move(stop);
  state_.robot_stopped = false;
  changed();
}

void LiveControl::set_saving(std::function<void()> request) {
  const std::lock_guard lock(mutex_);
  request_save_ = std::move(request);
}

std::optional<LiveControl::Clock::time_point> LiveControl::due(double t) {
  if (state_.speed == 0 || !paced_) return std::nullopt;
  const auto now = Clock::now();
  if (!anchor_) anchor_ = {now, t};
  const auto after = [&](double s) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
  };
  const auto at = anchor_->first + after((t - anchor_->second) / state_.speed);
  if (now - at > after(late_s)) anchor_ = {now, t};
  return at;
}

bool LiveControl::wait_for(const Tick& tick, const std::function<void()>& meanwhile) {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (meanwhile) {
      lock.unlock();
      meanwhile();
      lock.lock();
    }
    if (stop_ || interrupted_()) return false;
    if (state_.paused) {
      if (steps_ > 0) {
        --steps_;
        anchor_.reset();
        return true;
      }
      woken_.wait_for(lock, nap);
      continue;
    }
    const auto at = stop_robot_ ? std::nullopt : due(tick.t);  // a robot's clock is that of the run
    const auto now = Clock::now();
    if (!at || *at <= now) return true;
    woken_.wait_until(lock, std::min(*at, now + nap));
  }
}

bool LiveControl::is_ending() {
  const std::lock_guard lock(mutex_);
  return stop_ || interrupted_();
}

std::vector<Intervention> LiveControl::take_interventions() {
  const std::lock_guard lock(mutex_);
  return std::exchange(interventions_, {});
}

void LiveControl::end(const std::string& status, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  state_.running = state_.paused = false;
  state_.robot_stopped.reset();
  stop_robot_ = {};
  request_save_ = {};
  state_.ended_status = status;
  state_.ended_reason = reason;
  changed();
}

std::optional<StartRun> LiveControl::wait_for_start() {
  std::unique_lock lock(mutex_);
  while (!start_ && !interrupted_()) woken_.wait_for(lock, nap);
  if (interrupted_()) return std::nullopt;
  return std::exchange(start_, std::nullopt);
}

}  // namespace incognita
