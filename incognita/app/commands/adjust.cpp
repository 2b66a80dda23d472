#include "incognita/app/commands/adjust.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "incognita/app/commands/recorded_matches.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/math/median.hpp"
#include "incognita/math/quaternion.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/row_file.hpp"
#include "incognita/record/snapshot/pose_rows.hpp"
#include "incognita/slam/bundle/adjust_bundle.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

/// Of matches that are off by what adjustment leaves of well-textured images; the robust cost begins at three times this.
constexpr double sigma_pixel_px = 0.3;

struct Options {
  std::string run, out;
  int views = 300;
};

/// Of the position, m, and rotation vector, in world axes.
struct Correction {
  Eigen::Vector3d position, rotation;
};

Correction correction(const StampedPose& from, const BundleView& to) {
  return {to.position - from.position,
          quaternion_log(quaternion_product(to.world_from_camera, quaternion_conjugate(from.orientation)))};
}

/// All poses of the run: those of views as adjusted, those between moved by the corrections of the two nearest, linear in time.
Trajectory adjusted_trajectory(const RecordedMatches& run, const std::vector<BundleView>& views) {
  Trajectory out = run.estimate;
  std::size_t next = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    while (next + 1 < run.view.size() && run.view[next] < k) ++next;
    const std::size_t before = next > 0 && run.view[next] > k ? next - 1 : next;
    const StampedPose &a = run.estimate[run.view[before]], &b = run.estimate[run.view[next]];
    const double share = b.t > a.t ? (out[k].t - a.t) / (b.t - a.t) : 0;
    const Correction from = correction(a, views[before]), to = correction(b, views[next]);
    out[k].position += from.position + share * (to.position - from.position);
    out[k].orientation = quaternion_product(
        quaternion_exp(Eigen::Vector3d(from.rotation + share * (to.rotation - from.rotation))),
        out[k].orientation);
  }
  return out;
}

void write(const fs::path& file, const Trajectory& trajectory) {
  RowFile rows(file, tum_header("camera"));
  for (const StampedPose& pose : trajectory) rows.append(tum_row(pose), pose.t);
  rows.close();
}

double median_residual_px(const Bundle& bundle, const Camera& camera) {
  std::vector<double> all = residuals_px(bundle, camera);
  return median(all);
}

void print_hint(const Options& options, const fs::path& file) {
  fmt::print("written: {}\n", file.string());
  const fs::path truth = fs::path(options.run) / "truth.tum";
  if (fs::exists(truth))
    fmt::print("its errors: incognita evaluate {} --truth {} --align sim3\n", file.string(), truth.string());
}

int adjust(const Options& options) {
  const fs::path run = options.run;
  const RecordedMatches recorded = read_matches(run, static_cast<std::size_t>(options.views));
  const Scenario scenario = load_scenario((run / "effective.toml").string()).scenario;
  if (scenario.is_simulated() || scenario.is_room_vehicle())
    throw InputError(options.run +
                     ": only the run of a camera that is tracked by images, on no vehicle, can be adjusted");
  const Camera camera = make_camera(scenario.camera);
  Bundle bundle = bundle_of(recorded.matches, camera, sigma_pixel_px);
  if (bundle.observations.empty())
    throw InputError(options.run +
                     ": no landmark was matched in three of the views; take more of them with --views");
  fmt::print("{} views of {} poses, {} landmarks, {} matches\n", bundle.views.size(),
             recorded.estimate.size(), bundle.points.size(), bundle.observations.size());
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
  fmt::print("residuals: {:.2f} px in the median before, {:.2f} px after, in {} steps\n", before_px,
             median_residual_px(bundle, camera), report.iterations);
  const fs::path file = options.out.empty() ? run / "adjusted-whole.tum" : fs::path(options.out);
  write(file, adjusted_trajectory(recorded, bundle.views));
  print_hint(options, file);
  return 0;
}

}  // namespace

CLI::App* add_adjust(CLI::App& app, std::function<int()>& job) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "adjust", "The most accurate trajectory of a run: bundle adjustment of all its matches, after its end");
  command->add_option("RUN", options->run, "run directory, of one camera on no vehicle")->required();
  command
      ->add_option(
          "--views", options->views,
          "most frames that are adjusted, evenly spaced; those between are interpolated. Time grows with their cube")
      ->check(CLI::Range(2, 5000))
      ->capture_default_str();
  command->add_option("--out", options->out, "trajectory file [RUN/adjusted-whole.tum]");
  command->footer("Example: incognita adjust my-run");
  command->callback([options, &job] { job = [options] { return adjust(*options); }; });
  return command;
}

}  // namespace incognita
