// Executes one run of a scenario of any kind; used by `run` and by `campaign`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "incognita/app/loop/assembly.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/messages/intervention.hpp"
#include "incognita/record/files/state_file.hpp"
#include "incognita/record/recorder.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

class ObservabilityWatch;
class RobotLink;

/// Receives what a run publishes. An exception of publish() ends the run as `failed`.
class RunSink {
 public:
  virtual ~RunSink() = default;
  virtual void publish(const Snapshot& snapshot) = 0;
  /// Interventions of a tick that failed: it has no snapshot.
  virtual void log(const Tick&, const std::vector<Intervention>&) {}
  /// Observability report, once at the end; also as text.
  virtual void note(const ObservabilityReport& report, const std::vector<std::string>& in_words) = 0;
  /// Adds a field to the summary.
  virtual void note(const std::string& key, const SummaryValue& value) = 0;
  virtual RunOutcome finish(RunStatus status, const std::string& reason,
                            const std::vector<std::string>& warnings) = 0;
};

/// `frames`: expected number; 0: unknown. An exception stops the run before its first frame.
using SinkFactory = std::function<std::unique_ptr<RunSink>(const RunInfo& info, std::int64_t frames)>;

/// Where the interventions of a run come from: a person at the page, or the log of an earlier run.
class InterventionSource {
 public:
  virtual ~InterventionSource() = default;
  /// Those that take effect before the motion of this tick.
  virtual std::vector<Intervention> due(const Tick& tick) = 0;
  /// An intervention that this run cannot take, with the reason; it has no effect and is not logged. An exception ends
  /// the run.
  virtual void refused(const Intervention& intervention, const std::string& why) = 0;
  /// The scenario of the run with further settings, "key=value". Throws InputError.
  virtual LoadedScenario reloaded(const std::vector<std::string>& settings) = 0;
};

/// How a save went.
struct SaveReport {
  double t = 0;           ///< of the last frame in it, s
  std::size_t bytes = 0;  ///< of the file
  std::string failure;    ///< why it could not be written; empty if it was
};

/// What becomes of the whole state of a run.
struct RunSaving {
  /// Receives the content of a state file, record/files/state_file.hpp: at the end, as often as run.save_every_s says, and on
  /// request. Throws RecordError if it cannot be written.
  std::function<void(const std::string& bytes)> write = {};
  /// Asked after each frame and at the end: whether to save now.
  std::function<bool()> is_requested = {};
  /// Receives, before the first frame, what saves the run if that is requested: to be called by a RunCallbacks::keep_going that
  /// waits. It is valid until the run ends, and does nothing before the first frame is done.
  std::function<void(std::function<void()> save_if_requested)> may_wait = {};
  /// Receives how each requested save went, and each that failed.
  std::function<void(const SaveReport&)> on_save = {};
  const StateFile* resumed = nullptr;  ///< the run goes on from there
  const StateFile* map = nullptr;      ///< or only the map of that run is restored
  /// The scenario of the run with settings that were changed while it went on. Throws InputError.
  std::function<LoadedScenario(const std::vector<std::string>& settings)> reload = {};
};

struct RunCallbacks {
  std::function<void(const std::string& line)> report;    ///< receives the assumptions, for printing
  std::function<bool(const Tick& tick)> keep_going = {};  ///< false: the run is interrupted
  /// Whether the run is to end; asked while it waits for a camera or a robot.
  std::function<bool()> is_over = {};
  LiveSources live_sources = {};
  /// Receives the link to a robot, if the scenario has one, before the first frame.
  std::function<void(const std::shared_ptr<RobotLink>&)> robot = {};
  InterventionSource* interventions = nullptr;
  /// Receives the observability monitor after each update, where the scenario has one.
  std::function<void(const ObservabilityWatch&)> observe = {};
  RunSaving saving = {};
};

/// Throws InputError, naming file and key or value, if the scenario cannot start, or not from the state that is to be resumed.
RunOutcome run_scenario(const LoadedScenario& loaded, const SinkFactory& open, const RunCallbacks& callbacks);

}  // namespace incognita
