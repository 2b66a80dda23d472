// One run of a scenario of any kind, from its settings to how it ended: what `run` does once and `campaign`
// often.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/record/recorder.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Where that goes which a run publishes. What publish() throws ends the run as `failed`.
class RunSink {
 public:
  virtual ~RunSink() = default;
  virtual void publish(const Snapshot& snapshot) = 0;
  /// What the filter can and cannot know, once, at the end; in words too.
  virtual void note(const ObservabilityReport& report, const std::vector<std::string>& in_words) = 0;
  /// A field for the summary.
  virtual void note(const std::string& key, const SummaryValue& value) = 0;
  virtual RunOutcome finish(RunStatus status, const std::string& reason,
                            const std::vector<std::string>& warnings) = 0;
};

/// `frames` to expect; 0: unknown. What it throws stops the run before its first frame.
using SinkFactory = std::function<std::unique_ptr<RunSink>(const RunInfo& info, std::int64_t frames)>;

struct RunCallbacks {
  std::function<void(const std::string& line)> report;    ///< what was guessed, for printing
  std::function<bool(const Tick& tick)> keep_going = {};  ///< false: the run is interrupted
};

/// Throws InputError, naming file and key or value, for a scenario that cannot start.
RunOutcome run_scenario(const LoadedScenario& loaded, const SinkFactory& open, const RunCallbacks& callbacks);

}  // namespace incognita
