#include "incognita/app/evaluate.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "incognita/analysis/pose_consistency.hpp"
#include "incognita/analysis/trajectory.hpp"
#include "incognita/app/say.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/number.hpp"
#include "incognita/record/tum.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t min_matches = 3;  // fewer points fit any trajectory

struct Options {
  std::string estimate, truth, covariance;
  std::string align = "auto";
  double max_dt_s = 0.01;
  double rpe_delta_s = 1;
  bool json = false;
};

struct Answer {
  std::size_t matched = 0, estimate_poses = 0, truth_poses = 0;
  AlignmentKind kind = AlignmentKind::none;
  Alignment alignment;
  ErrorStatistics ate;
  RelativePoseError rpe;
  std::optional<double> mean_nees;
};

/// A run directory stands for the files in it.
Options resolved(Options options) {
  const fs::path run = options.estimate;
  if (!fs::exists(run)) throw InputError(run.string() + ": there is no such file or folder");
  if (!fs::is_directory(run)) {
    if (options.truth.empty())
      throw InputError("evaluate: --truth is needed: a TUM or EuRoC file with the true poses");
    return options;
  }
  options.estimate = run / "estimate.tum";
  if (!fs::exists(options.estimate))
    throw InputError(run.string() + ": is a folder without estimate.tum, so no run directory");
  if (options.truth.empty()) {
    if (!fs::exists(run / "truth.tum"))
      throw InputError(run.string() + ": the run knew no truth; give it with --truth FILE");
    options.truth = run / "truth.tum";
  }
  if (options.covariance.empty() && fs::exists(run / "covariance.csv"))
    options.covariance = run / "covariance.csv";
  return options;
}

/// `auto`: what a run says of itself in summary.json, else se3, the field's custom.
AlignmentKind alignment_of(const Options& asked) {
  if (const auto kind = alignment_kind(asked.align)) return *kind;
  if (asked.align != "auto")
    throw InputError("--align " + asked.align + ": none of auto, none, se3, sim3, yaw");
  std::ifstream in(fs::path(asked.estimate) / "summary.json");
  const Json summary = in ? Json::parse(in, nullptr, false) : Json();
  if (summary.is_object() && summary.contains("ate_alignment") && summary["ate_alignment"].is_string())
    return alignment_kind(summary["ate_alignment"].get<std::string>()).value_or(AlignmentKind::se3);
  return AlignmentKind::se3;
}

std::string span_of(const Trajectory& trajectory) {
  const auto [first, last] = std::minmax_element(trajectory.begin(), trajectory.end(),
                                                 [](const auto& a, const auto& b) { return a.t < b.t; });
  return fmt::format("{} to {} s", first->t, last->t);
}

/// Says why there is none where one was asked for.
std::optional<double> nees(const Options& options, AlignmentKind kind, const MatchedTrajectories& matched) {
  if (options.covariance.empty()) return std::nullopt;
  if (kind != AlignmentKind::none) {
    say("evaluate: no NEES: it needs --align none, a fit would hide errors that the covariance counts\n");
    return std::nullopt;
  }
  const auto mean = mean_pose_nees(matched, read_covariances(options.covariance));
  if (!mean) say("evaluate: no NEES: {} has no usable covariance at the matched times\n", options.covariance);
  return mean;
}

bool is_finite(const Answer& answer) {
  const auto finite = [](const ErrorStatistics& s) { return s.count == 0 || std::isfinite(s.rmse); };
  return std::isfinite(answer.alignment.scale) && finite(answer.ate) && finite(answer.rpe.translation_m);
}

/// Nothing when the trajectories cannot be compared; the reason goes to standard error.
std::optional<Answer> compare(const Options& options, AlignmentKind kind) {
  const Trajectory estimate = read_trajectory(options.estimate), truth = read_trajectory(options.truth);
  MatchedTrajectories matched = match(estimate, truth, options.max_dt_s);
  Answer answer{matched.estimate.size(), estimate.size(), truth.size(), kind, {}, {}, {}, {}};
  if (answer.matched < min_matches) {
    say("evaluate: {} of {} estimated poses have a true one within {} s, at least {} are needed. The "
        "estimate spans {}, the truth {}; see --max-dt\n",
        answer.matched, estimate.size(), options.max_dt_s, min_matches, span_of(estimate), span_of(truth));
    return std::nullopt;
  }
  const auto alignment = align(matched, kind);
  if (!alignment) {
    say("evaluate: one of the trajectories never moves, so there is no scale; use --align se3\n");
    return std::nullopt;
  }
  answer.alignment = *alignment;
  answer.mean_nees = nees(options, kind, matched);
  matched.estimate = aligned(matched.estimate, *alignment);
  answer.ate = absolute_trajectory_error(matched);
  answer.rpe = relative_pose_error(matched, {options.rpe_delta_s, 0});
  if (is_finite(answer)) return answer;
  say("evaluate: the positions are too large to be compared; are they in metres?\n");
  return std::nullopt;
}

Json json_of(const ErrorStatistics& s) {
  if (s.count == 0)
    return {{"count", 0}, {"rmse", nullptr}, {"mean", nullptr}, {"median", nullptr}, {"max", nullptr}};
  return {{"count", s.count}, {"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median}, {"max", s.max}};
}

void print_json(const Answer& answer, double delta_s) {
  Json json{{"matched", answer.matched},
            {"estimate_poses", answer.estimate_poses},
            {"truth_poses", answer.truth_poses},
            {"alignment", name(answer.kind)},
            {"scale", answer.alignment.scale},
            {"ate_m", json_of(answer.ate)},
            {"rpe",
             {{"delta_s", delta_s},
              {"translation_m", json_of(answer.rpe.translation_m)},
              {"rotation_rad", json_of(answer.rpe.rotation_rad)}}}};
  if (answer.mean_nees) json["mean_nees"] = *answer.mean_nees;
  fmt::print("{}\n", json.dump(2));
}

void print_row(const char* what, const ErrorStatistics& s) {
  if (s.count == 0)
    fmt::print("{:<22} no two matched poses are that far apart in time, or one has no orientation\n", what);
  else
    fmt::print("{:<22} rmse {:<10.5g} mean {:<10.5g} median {:<10.5g} max {:<10.5g} of {}\n", what, s.rmse,
               s.mean, s.median, s.max, s.count);
}

void print_table(const Answer& answer, double delta_s) {
  fmt::print("matched {} of {} estimated and {} true poses; alignment {}, scale {:.6g}\n", answer.matched,
             answer.estimate_poses, answer.truth_poses, name(answer.kind), answer.alignment.scale);
  print_row("ATE, m", answer.ate);
  print_row(fmt::format("RPE over {:g} s, m", delta_s).c_str(), answer.rpe.translation_m);
  print_row(fmt::format("RPE over {:g} s, rad", delta_s).c_str(), answer.rpe.rotation_rad);
  if (answer.mean_nees)
    fmt::print("NEES per degree of freedom {:.4g} (1 is right, more is overconfident)\n", *answer.mean_nees);
}

/// CLI11's own checks let NaN pass, which compares with nothing.
CLI::Validator number_where(const char* allowed, bool (*is_allowed)(double)) {
  const auto check = [=](const std::string& word) {
    const auto value = parse_number(word);
    return value && is_allowed(*value) ? "" : fmt::format("{}: must be {}", word, allowed);
  };
  return CLI::Validator(check, "");
}

int evaluate(const Options& asked) {
  const AlignmentKind kind = alignment_of(asked);
  const Options options = resolved(asked);
  const auto answer = compare(options, kind);
  if (!answer) return 1;
  if (options.json)
    print_json(*answer, options.rpe_delta_s);
  else
    print_table(*answer, options.rpe_delta_s);
  return 0;
}

}  // namespace

CLI::App* add_evaluate(CLI::App& app, std::function<int()>& job) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("evaluate", "Trajectory errors: ATE, RPE, and NEES where covariances are known");
  command
      ->add_option("ESTIMATE", options->estimate, "run directory, or trajectory file (TUM, or EuRoC's table)")
      ->required();
  command->add_option("--truth", options->truth, "file with the true poses; a run directory has its own");
  command
      ->add_option(
          "--align", options->align,
          "auto (as the run says, else se3), none, se3, sim3 or yaw (about the vertical, and position)")
      ->capture_default_str();
  command->add_option("--max-dt", options->max_dt_s, "s: poses further apart in time do not match")
      ->check(number_where("0 or more", [](double value) { return value >= 0; }))
      ->capture_default_str();
  command->add_option("--rpe-delta-s", options->rpe_delta_s, "s: interval of the relative pose error")
      ->check(number_where("more than 0", [](double value) { return value > 0; }))
      ->capture_default_str();
  command->add_option("--covariance", options->covariance, "covariance.csv of the estimate, for NEES");
  command->add_flag("--json", options->json, "one JSON document on standard output");
  command->footer("Example: incognita evaluate my-run --align none --json");
  command->callback([options, &job] { job = [options] { return evaluate(*options); }; });
  return command;
}

}  // namespace incognita
