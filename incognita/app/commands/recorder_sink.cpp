#include "incognita/app/commands/recorder_sink.hpp"

#include <fmt/format.h>

#include <utility>

#include "incognita/app/console/print_message.hpp"
#include "incognita/report/run_figures.hpp"

namespace incognita {

void StateReporter::report(const Snapshot& s) {
  const bool is_lost = s.status.state == TrackingState::lost;
  if (is_lost && !was_lost_) print_message("t = {:.3f} s: lost: {}\n", s.tick.t, s.status.reason);
  if (!is_lost && was_lost_)
    print_message("t = {:.3f} s: {}: {}\n", s.tick.t, name(s.status.state), s.status.reason);
  was_lost_ = is_lost;
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const SnapshotDecision& decision = s.bodies[i].decision;
    if (!s.bodies[i].operator_controlled || !decision.decided || decision.chosen < 0) continue;
    const std::string who = s.bodies.size() > 1 ? fmt::format("operator {}: ", i + 1) : "";
    print_message("t = {:.2f} s: {}{}\n", s.tick.t, who, chosen_action(decision));
  }
}

RecorderSink::RecorderSink(Options options, const RunInfo& info, std::int64_t frames)
    : options_(std::move(options)),
      alignment_(alignment_kind(info.ate_alignment).value_or(AlignmentKind::none)),
      lock_(options_.out),
      recorder_(options_.out, info),
      progress_(frames) {
  for (const std::string& warning : info.warnings) print_message("warning: {}\n", warning);
  if (options_.save_frames) pictures_.emplace(recorder_.path(), info.patch_size_px);
  if (options_.save_recording) recording_.emplace(recorder_.path());
}

void RecorderSink::publish(const Snapshot& s) {
  recorder_.publish(s);
  if (pictures_) pictures_->publish(s);
  if (recording_) recording_->publish(s);
  progress_->show(s.tick.frame + 1, fmt::format("{}, {} matched, {} landmarks", name(s.status.state),
                                                s.matched, s.landmarks.size()));
  reporter_.report(s);
  options_.frame_done(s);
}

void RecorderSink::note(const ObservabilityReport& report, const std::vector<std::string>& in_words) {
  progress_.reset();
  recorder_.note(report);
  for (const std::string& line : in_words) print_message("{}\n", line);
}

RunOutcome RecorderSink::finish(RunStatus status, const std::string& reason,
                                const std::vector<std::string>& warnings) {
  progress_.reset();  // removes the progress line
  const auto finishing = [&](const std::filesystem::path& directory) {
    std::vector<std::string> all = warnings;
    if (!options_.figures) return all;
    for (std::string& warning : draw_run_figures(directory, alignment_)) {
      print_message("{}\n", warning);
      all.push_back(std::move(warning));
    }
    return all;
  };
  for (const std::string& warning : warnings) print_message("{}\n", warning);
  return recorder_.finish(status, reason, finishing);
}

}  // namespace incognita
