#include "incognita/record/summary/run_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace incognita {
namespace {

std::string line(const std::string& label, const std::string& text) {
  return fmt::format("{:<12} {}\n", label, text);
}

std::string counted(std::int64_t count, const std::string& one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

/// A rounded number without exponent.
std::string rounded(double value) {
  const double size = std::abs(value);
  return fmt::format("{:.{}f}", value, size < 0.1 ? 3 : size < 10 ? 2 : size < 100 ? 1 : 0);
}

std::string estimated_length(double length, bool scale_known) {
  return scale_known ? length_in_words(length) : rounded(length) + " arbitrary units (scale unobservable)";
}

std::string frames_in_words(const RunReport& r) {
  std::string text = fmt::format("{} in {:.1f} s: {} tracked", r.frames, r.duration_s, r.tracked_frames);
  if (r.degraded_frames > 0) text += fmt::format(" ({} of them degraded)", r.degraded_frames);
  return text + fmt::format(", {} lost", r.lost_frames);
}

std::string path_in_words(const BodyReport& body, const RunReport& r) {
  if (!std::isfinite(body.path_length)) return "unknown";
  if (r.true_path) return length_in_words(body.path_length);
  return estimated_length(body.path_length, r.scale_known) + ", estimated";
}

std::string errors_in_words(const BodyReport& body, const RunReport& r) {
  if (!std::isfinite(body.ate_m))
    return !r.truth_known                       ? "no error: the truth is unknown"
           : r.tracked_frames == 0              ? "no error: there is no pose to compare with the truth"
           : r.alignment == AlignmentKind::none ? "no error: the truth is unknown at all tracked frames"
                                                : "no error: too few poses with truth for an alignment";
  std::string text = "ATE " + length_in_words(body.ate_m);
  if (r.alignment != AlignmentKind::none) text += fmt::format(" after {} alignment", name(r.alignment));
  if (r.bodies.size() == 1 && std::isfinite(r.ate_adjusted_m))
    text += fmt::format(" ({} with the keyframes as adjusted last)", length_in_words(r.ate_adjusted_m));
  if (std::isfinite(body.drift_percent))
    text += fmt::format(", drift {} % of the path", rounded(body.drift_percent));
  if (body.compared_frames < r.tracked_frames)
    text += fmt::format(", truth at {} of {} tracked frames", body.compared_frames, r.tracked_frames);
  return text;
}

std::string map_in_words(const RunReport& r) {
  std::string text = counted(r.landmarks, "landmark");
  if (r.anchors > 0) text += ", " + counted(r.anchors, "anchor");
  if (r.surveyed == 0 && r.map_error_landmarks == 0) return text;
  if (r.surveyed == 0)
    return text + fmt::format("; map error {} rms over {}", length_in_words(r.map_error_m),
                              counted(r.map_error_landmarks, "landmark"));
  if (r.map_error_landmarks == 0)
    return text + fmt::format("; none matches one of the {} surveyed", r.surveyed);
  return text + fmt::format("; map error {} rms over {} of {} surveyed landmarks",
                            length_in_words(r.map_error_m), r.map_error_landmarks, r.surveyed);
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

/// Empty where the truth is not known.
std::string outcome_lines(const OutcomeMeasures& outcome, bool in_room) {
  if (!outcome.mapped) return "";
  std::string text = fmt::format("{} of the {} to 5 cm", percent(*outcome.mapped),
                                 in_room ? "textured surface" : "unknown points");
  if (outcome.mapped_60_s) text += fmt::format(", {} after 60 s", percent(*outcome.mapped_60_s));
  if (outcome.t_90_mapped_s) text += fmt::format(", 90 % after {:.1f} s", *outcome.t_90_mapped_s);
  std::string lines = line("mapped", text);
  if (outcome.within_5_cm && outcome.within_3_sigma)
    lines += line("", fmt::format("{} of the landmarks within 5 cm of the truth, {} within 3 sigma",
                                  percent(*outcome.within_5_cm), percent(*outcome.within_3_sigma)));
  return lines;
}

/// Empty where it is unknown.
std::string entropy_line(const RunReport& r) {
  if (!std::isfinite(r.entropy)) return "";
  std::string text = fmt::format("{:.0f} nats", r.entropy);
  if (r.entropy_extended) text += fmt::format(", {:.0f} with what is not mapped yet", *r.entropy_extended);
  return line("entropy", text);
}

std::string in_words(const char* what, const std::optional<MeanNormalizedSquare>& value) {
  if (!value) return "";
  return fmt::format("{} {} ({} to {})", what, rounded(value->mean), rounded(value->band.low),
                     rounded(value->band.high));
}

std::string overconfident_in_words(const PoseConsistency& pose) {
  if (pose.frames_with_truth == 0) return "";
  return fmt::format(", {} of {} frames beyond 3 sigma", pose.overconfident_frames, pose.frames_with_truth);
}

std::string consistency_lines(const ConsistencyReport& c) {
  std::string text = name(c.verdict);
  const std::string nees = in_words("NEES", c.pose.nees), nis = in_words("NIS", c.nis);
  if (!nees.empty()) text += ": " + nees;
  if (!nis.empty()) text += (nees.empty() ? ": " : ", ") + nis;
  std::string lines = line("consistency", text + overconfident_in_words(c.pose));
  if (!c.symptom.empty()) lines += line("", c.symptom);
  if (!c.causes.empty()) lines += line("", fmt::format("usual causes: {}", fmt::join(c.causes, "; ")));
  return lines;
}

std::string robot_lines(const RunReport& r) {
  std::string lines;
  constexpr std::size_t most = 20;  // summary.json has more
  if (r.bodies.size() < 2) return lines;
  for (std::size_t i = 0; i < r.bodies.size() && i < most; ++i) {
    const BodyReport& robot = r.bodies[i];
    std::string text = fmt::format("path {}", path_in_words(robot, r));
    if (std::isfinite(robot.ate_m)) text += ", " + errors_in_words(robot, r);
    if (robot.consistency.nees) text += ", " + in_words("NEES", robot.consistency.nees);
    if (robot.consistency.verdict() == Consistency::overconfident) text += ", overconfident";
    lines += line(fmt::format("  robot {}", i + 1), text + overconfident_in_words(robot.consistency));
  }
  if (r.bodies.size() > most)
    lines += line("", fmt::format("{} more robots: see vehicles.csv", r.bodies.size() - most));
  return lines;
}

}  // namespace

const char* name(RunStatus status) {
  switch (status) {
    case RunStatus::done:
      return "done";
    case RunStatus::failed:
      return "failed";
    case RunStatus::interrupted:
      return "interrupted";
  }
  return "unknown";
}

std::string length_in_words(double length_m) {
  const double size = std::abs(length_m);
  if (size < 0.01) return fmt::format("{:.1f} mm", 1000 * length_m);
  if (size < 1) return fmt::format("{:.1f} cm", 100 * length_m);
  return fmt::format("{:.{}f} m", length_m, size < 10 ? 2 : size < 100 ? 1 : 0);
}

std::string in_words(const RunReport& r, double wall_s, const std::string& out) {
  std::string text = line("run", std::string(name(r.status)) + (r.reason.empty() ? "" : ", " + r.reason));
  text += line("frames", frames_in_words(r));
  text += line("path", path_in_words(r.body, r));
  text += line("trajectory",
               errors_in_words(r.body, r) + (r.outcome.diverged.value_or(false) ? ", diverged" : ""));
  text += robot_lines(r);
  text += line("map", map_in_words(r));
  text += outcome_lines(r.outcome, r.in_room);
  text += entropy_line(r);
  text += consistency_lines(r.consistency);
  text += line("decisions", std::to_string(r.decisions));
  if (wall_s > 0) text += line("speed", rounded(static_cast<double>(r.frames) / wall_s) + " frames/s");
  if (!r.warnings.empty())
    text += line("warnings", fmt::format("{}, the first: {}", r.warnings.size(), r.warnings.front()));
  return text + line("results", out);
}

}  // namespace incognita
