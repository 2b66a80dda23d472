// The sink of `incognita run`: the run directory, pictures, progress, and the viewers of the page.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "incognita/app/console/folder_lock.hpp"
#include "incognita/app/console/progress.hpp"
#include "incognita/app/loop/scenario_run.hpp"
#include "incognita/record/frame_pictures.hpp"
#include "incognita/record/image_recording.hpp"
#include "incognita/record/recorder.hpp"

namespace incognita {

/// Reports loss and recovery of tracking, and the instructions to an operator, on standard error.
class StateReporter {
 public:
  void report(const Snapshot& snapshot);

 private:
  bool was_lost_ = false;
};

/// Writes the run directory and reports progress on standard error.
class RecorderSink : public RunSink {
 public:
  struct Options {
    std::string out;
    bool save_frames = false;
    bool save_recording = false;
    bool figures = true;
    std::function<void(const Snapshot&)> frame_done;  ///< called at the end of every frame
  };
  RecorderSink(Options options, const RunInfo& info, std::int64_t frames);

  void publish(const Snapshot& snapshot) override;
  void log(const Tick& tick, const std::vector<Intervention>& interventions) override {
    recorder_.log(tick, interventions);
  }
  void note(const ObservabilityReport& report, const std::vector<std::string>& in_words) override;
  void note(const std::string& key, const SummaryValue& value) override { recorder_.note(key, value); }
  RunOutcome finish(RunStatus status, const std::string& reason,
                    const std::vector<std::string>& warnings) override;

 private:
  Options options_;
  AlignmentKind alignment_;
  FolderLock lock_;  ///< acquired before any file of an earlier run is changed
  Recorder recorder_;
  std::optional<FramePictures> pictures_;
  std::optional<ImageRecording> recording_;
  std::optional<Progress> progress_;
  StateReporter reporter_;
};

}  // namespace incognita
