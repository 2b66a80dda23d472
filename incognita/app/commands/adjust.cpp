#include "incognita/app/commands/adjust.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "incognita/analysis/evaluation/pose_correction.hpp"
#include "incognita/app/commands/recorded_matches.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/math/median.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/durable_file.hpp"
#include "incognita/record/snapshot/pose_rows.hpp"
#include "incognita/slam/bundle/adjust_bundle.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

/// Of matches that are off by what adjustment leaves of well-textured images; the robust cost begins at three times this.
constexpr double sigma_pixel_px = 0.3;

struct Options {
  std::string run, out;
  int views = 600;
};

/// All poses of the run: those of views as adjusted, those between moved by the corrections of the two nearest, linear in time.
Trajectory adjusted_trajectory(const RecordedMatches& run, const std::vector<BundleView>& views) {
  std::vector<PoseCorrection> corrections;
  for (std::size_t i = 0; i < views.size(); ++i)
    corrections.push_back(correction(run.estimate[run.view[i]], {.position = views[i].position,
                                                                 .orientation = views[i].world_from_camera}));
  Trajectory out = run.estimate;
  std::size_t next = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    while (next + 1 < run.view.size() && run.view[next] < k) ++next;
    const std::size_t before = next > 0 && run.view[next] > k ? next - 1 : next;
    const double from_t = out[run.view[before]].t, to_t = out[run.view[next]].t;
    const double share = to_t > from_t ? (out[k].t - from_t) / (to_t - from_t) : 0;
    out[k] = corrected(out[k], between(corrections[before], corrections[next], share));
  }
  return out;
}

std::string tum_text(const Trajectory& trajectory) {
  std::string text = tum_header("camera") + "\n";
  for (const StampedPose& pose : trajectory) text += tum_row(pose) + "\n";
  return text;
}

/// Throws InputError for a file that cannot be written, or is one of the run's own.
fs::path output_file(const Options& options) {
  constexpr const char* name = "adjusted-whole.tum";
  if (options.out.empty()) return fs::path(options.run) / name;
  const fs::path file = options.out;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder))
    throw InputError(folder.string() + ": is no folder; create it, or choose another one with --out");
  if (fs::exists(file) && file.filename() != name && fs::equivalent(folder, options.run))
    throw InputError(file.string() + ": is a file of the run; choose another one with --out");
  return file;
}

/// Views that share few landmarks drift from each other.
void warn_of_gaps(const RunMatches& matches) {
  constexpr std::size_t few = 8;
  const std::size_t least = least_shared(matches);
  if (least < few)
    print_message(
        "adjust: successive views share {} landmarks where they are fewest: the trajectory may become worse than during the run; "
        "take more views with --views if the run has more frames\n",
        least);
}

Camera camera_of(const fs::path& run) {
  const fs::path file = run / "effective.toml";
  if (!fs::exists(file))
    throw InputError(file.string() + ": does not exist, and has the camera; every run writes it");
  const Scenario scenario = load_scenario(file.string()).scenario;
  if (scenario.is_simulated() || scenario.is_camera_vehicle())
    throw InputError(run.string() +
                     ": only the run of a camera that is tracked by images, on no vehicle, can be adjusted");
  return make_camera(scenario.camera);
}

double median_residual_px(const Bundle& bundle, const Camera& camera) {
  std::vector<double> all = residuals_px(bundle, camera);
  return median(all);
}

void print_hint(const Options& options, const fs::path& file, bool has_anchors) {
  fmt::print("written: {}\n", file.string());
  const fs::path truth = fs::path(options.run) / "truth.tum";
  if (fs::exists(truth))
    fmt::print("its errors: incognita evaluate {} --truth {} --align {}\n", file.string(), truth.string(),
               has_anchors ? "se3" : "sim3");
}

int adjust(const Options& options) {
  const fs::path run = options.run, file = output_file(options);
  const RecordedMatches recorded = read_matches(run, static_cast<std::size_t>(options.views));
  const Camera camera = camera_of(run);
  Bundle bundle = bundle_of(recorded.matches, camera, sigma_pixel_px);
  if (bundle.observations.empty())
    throw InputError(options.run +
                     ": no landmark was matched in three of the views; take more of them with --views");
  fmt::print("{} views of {} poses, {} landmarks, {} matches\n", bundle.views.size(),
             recorded.estimate.size(), bundle.points.size(), bundle.observations.size());
  warn_of_gaps(recorded.matches);
  const double before_px = median_residual_px(bundle, camera);
  BundleEquations equations;
  AdjustmentSettings settings;
  settings.max_iterations = 50;
  settings.min_relative_decrease = 1e-5;
  const AdjustmentReport report = incognita::adjust(bundle, camera, settings, equations);
  if (report.outcome == AdjustmentReport::Outcome::refused) {
    print_message(
        "adjust: the matches do not determine all views and landmarks: nothing is written. Frames that hang "
        "together by few landmarks cause it; more views with --views may help\n");
    return 1;
  }
  fmt::print("residuals: {:.2f} px in the median before, {:.2f} px after, in {} steps{}\n", before_px,
             median_residual_px(bundle, camera), report.iterations,
             report.outcome == AdjustmentReport::Outcome::stopped ? ", not at the minimum yet" : "");
  write_durably(file, tum_text(adjusted_trajectory(recorded, bundle.views)));
  print_hint(options, file, !recorded.matches.known.empty());
  return 0;
}

}  // namespace

CLI::App* add_adjust(CLI::App& app, std::function<int()>& job) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "adjust", "Trajectory of a run from all its images: bundle adjustment after its end");
  command->add_option("RUN", options->run, "run directory, of one camera on no vehicle")->required();
  command
      ->add_option(
          "--views", options->views,
          "most frames that are adjusted, evenly spaced; those between are interpolated. Time grows with their cube")
      ->check(CLI::Range(2, 1500))
      ->capture_default_str();
  command->add_option("--out", options->out,
                      "trajectory file, written whole or not at all [RUN/adjusted-whole.tum]");
  command->footer("Example: incognita adjust my-run");
  command->callback([options, &job] { job = [options] { return adjust(*options); }; });
  return command;
}

}  // namespace incognita
