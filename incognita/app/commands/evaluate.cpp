#include "incognita/app/commands/evaluate.hpp"

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
#include <utility>
#include <vector>

#include "incognita/analysis/evaluation/trajectory.hpp"
#include "incognita/app/commands/compare_trajectories.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/body_tables.hpp"
#include "incognita/record/files/number.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string estimate, truth, covariance;
  std::string align = "auto";
  double max_dt_s = 0.01;
  double rpe_delta_s = 1;
  bool json = false;
};

/// The files to evaluate.
struct EvaluationRequest {
  std::vector<TrajectoryFiles> vehicles;
  bool team = false;  ///< the run directory of a team
};

std::string if_there(const fs::path& file) { return fs::exists(file) ? file.string() : ""; }

TrajectoryFiles files_of(const fs::path& run, std::size_t vehicle) {
  const auto file = [&](const char* name) { return run / name_for_vehicle(name, vehicle); };
  return {file("estimate.tum").string(), if_there(file("truth.tum")), if_there(file("covariance.csv"))};
}

EvaluationRequest request_for_run(const Options& options) {
  const fs::path run = options.estimate;
  if (!fs::exists(run / "estimate.tum"))
    throw InputError(run.string() + ": is a folder without estimate.tum, and not a run directory");
  EvaluationRequest asked;
  for (std::size_t i = 0; i == 0 || fs::exists(run / name_for_vehicle("estimate.tum", i)); ++i)
    asked.vehicles.push_back(files_of(run, i));
  asked.team = asked.vehicles.size() > 1;
  if (asked.team && (!options.truth.empty() || !options.covariance.empty()))
    throw InputError(fmt::format(
        "{}: is a run of {} vehicles, but --truth and --covariance give one file: evaluate {} etc. separately, or the run with its own truth",
        run.string(), asked.vehicles.size(), (run / name_for_vehicle("estimate.tum", 1)).string()));
  TrajectoryFiles& first = asked.vehicles.front();
  if (!options.truth.empty()) first.truth = options.truth;
  if (!options.covariance.empty()) first.covariance = options.covariance;
  const auto has_truth = [](const TrajectoryFiles& files) { return !files.truth.empty(); };
  if (std::none_of(asked.vehicles.begin(), asked.vehicles.end(), has_truth))
    throw InputError(run.string() + ": the run has no truth; give one with --truth FILE");
  return asked;
}

/// Replaces a run directory by the files in it.
EvaluationRequest resolved(const Options& options) {
  if (!fs::exists(options.estimate)) throw InputError(options.estimate + ": there is no such file or folder");
  if (fs::is_directory(options.estimate)) return request_for_run(options);
  if (options.truth.empty())
    throw InputError("evaluate: --truth is needed: a TUM or EuRoC file with the true poses");
  return {{{options.estimate, options.truth, options.covariance}}, false};
}

/// `auto`: the alignment stated in the run's summary.json, else se3, which is customary.
AlignmentKind alignment_of(const Options& asked) {
  if (const auto kind = alignment_kind(asked.align)) return *kind;
  if (asked.align != "auto")
    throw InputError("--align " + asked.align + ": must be auto, none, se3, sim3 or yaw");
  std::ifstream in(fs::path(asked.estimate) / "summary.json");
  const Json summary = in ? Json::parse(in, nullptr, false) : Json();
  if (summary.is_object() && summary.contains("ate_alignment") && summary["ate_alignment"].is_string())
    return alignment_kind(summary["ate_alignment"].get<std::string>()).value_or(AlignmentKind::se3);
  return AlignmentKind::se3;
}

Json json_of(const ErrorStatistics& s) {
  if (s.count == 0)
    return {{"count", 0}, {"rmse", nullptr}, {"mean", nullptr}, {"median", nullptr}, {"max", nullptr}};
  return {{"count", s.count}, {"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median}, {"max", s.max}};
}

Json rpe_json(const RelativePoseError& rpe, double delta_s) {
  return {{"delta_s", delta_s},
          {"translation_m", json_of(rpe.translation_m)},
          {"rotation_rad", json_of(rpe.rotation_rad)}};
}

Json json_of(const TrajectoryErrors& v, double delta_s) {
  Json json{{"matched", v.matched},
            {"estimate_poses", v.estimate_poses},
            {"truth_poses", v.truth_poses},
            {"ate_m", json_of(v.ate_m)},
            {"rpe", rpe_json(v.rpe, delta_s)}};
  if (v.nees) json["mean_nees"] = v.nees->value;
  return json;
}

/// For a team, the errors over all poses, then those of each vehicle.
void print_json(const TrajectoryComparison& c, AlignmentKind kind, double delta_s, bool team) {
  Json json{{"matched", c.matched},    {"estimate_poses", c.estimate_poses}, {"truth_poses", c.truth_poses},
            {"alignment", name(kind)}, {"scale", c.alignment.scale},         {"ate_m", json_of(c.ate_m)}};
  if (!team) json["rpe"] = rpe_json(c.vehicles.front().rpe, delta_s);
  if (c.nees) json["mean_nees"] = c.nees->value;
  if (team)
    for (const TrajectoryErrors& v : c.vehicles) json["vehicles"].push_back(json_of(v, delta_s));
  fmt::print("{}\n", json.dump(2));
}

void print_row(const std::string& what, const ErrorStatistics& s) {
  if (s.count == 0)
    fmt::print("{:<22} no two matched poses are that far apart in time, or one has no orientation\n", what);
  else
    fmt::print("{:<22} rmse {:<10.5g} mean {:<10.5g} median {:<10.5g} max {:<10.5g} of {}\n", what, s.rmse,
               s.mean, s.median, s.max, s.count);
}

void print_nees(const std::optional<MeanNees>& nees) {
  if (!nees) return;
  fmt::print("NEES per degree of freedom {:.4g} (expected 1; more is overconfident)\n", nees->value);
}

void print_relative(const RelativePoseError& rpe, double delta_s) {
  print_row(fmt::format("RPE over {:g} s, m", delta_s), rpe.translation_m);
  print_row(fmt::format("RPE over {:g} s, rad", delta_s), rpe.rotation_rad);
}

void print_table(const TrajectoryComparison& c, AlignmentKind kind, double delta_s) {
  fmt::print("matched {} of {} estimated and {} true poses; alignment {}, scale {:.6g}\n", c.matched,
             c.estimate_poses, c.truth_poses, name(kind), c.alignment.scale);
  print_row("ATE, m", c.ate_m);
  print_relative(c.vehicles.front().rpe, delta_s);
  print_nees(c.nees);
}

/// Each vehicle with respect to its own truth, then all poses together.
void print_team(const TrajectoryComparison& c, AlignmentKind kind, double delta_s) {
  for (std::size_t i = 0; i < c.vehicles.size(); ++i) {
    const TrajectoryErrors& v = c.vehicles[i];
    fmt::print("vehicle {}: matched {} of {} estimated and {} true poses\n", i + 1, v.matched,
               v.estimate_poses, v.truth_poses);
    if (v.matched == 0) continue;
    print_row("ATE, m", v.ate_m);
    print_relative(v.rpe, delta_s);
    print_nees(v.nees);
  }
  fmt::print("all vehicles: matched {} of {} estimated and {} true poses; alignment {}, scale {:.6g}\n",
             c.matched, c.estimate_poses, c.truth_poses, name(kind), c.alignment.scale);
  print_row("ATE, m", c.ate_m);
  print_nees(c.nees);
}

/// CLI11's range checks accept NaN, as every comparison with it is false.
CLI::Validator number_where(const char* allowed, bool (*is_allowed)(double)) {
  const auto check = [=](const std::string& word) {
    const auto value = parse_number(word);
    return value && is_allowed(*value) ? "" : fmt::format("{}: must be {}", word, allowed);
  };
  return CLI::Validator(check, "");
}

int evaluate(const Options& options) {
  const AlignmentKind kind = alignment_of(options);
  const EvaluationRequest asked = resolved(options);
  const auto comparison = compare_trajectories(asked.vehicles, {kind, options.max_dt_s, options.rpe_delta_s});
  if (!comparison) return 1;
  if (options.json)
    print_json(*comparison, kind, options.rpe_delta_s, asked.team);
  else if (asked.team)
    print_team(*comparison, kind, options.rpe_delta_s);
  else
    print_table(*comparison, kind, options.rpe_delta_s);
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
  command->add_option("--max-dt", options->max_dt_s, "s: greatest time difference of matched poses")
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
