#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "incognita/app/loop/assemblers.hpp"
#include "incognita/app/loop/body_models.hpp"
#include "incognita/app/loop/world_outline.hpp"
#include "incognita/control/steering_controller.hpp"
#include "incognita/decision/decision.hpp"
#include "incognita/io/recordings/camera_of_recording.hpp"
#include "incognita/io/recordings/recorded_images.hpp"
#include "incognita/io/recordings/recording.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/target_file.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/slam/estimator/single_camera.hpp"

namespace incognita {

void check_sheet(const LoadedScenario& loaded, const Target& target, const Sheet& sheet) {
  constexpr double tolerance_m = 0.05;
  for (const Target::Corner& corner : target.corners) {
    const Eigen::Vector3d& p = corner.position;
    double apart_m = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& hangs : sheet.corners()) apart_m = std::min(apart_m, (hangs - p).norm());
    if (apart_m <= tolerance_m) continue;
    throw InputError(
        fmt::format("{}: start.target = {}: has a corner at [{}, {}, {}], and the sheet in this room hangs "
                    "at x = {} (room.size_m, "
                    "{}): the target file must say the same",
                    loaded.source_of("start.target"), loaded.scenario.start.target, p.x(), p.y(), p.z(),
                    sheet.x, loaded.source_of("room.size_m")));
  }
}

std::optional<Target> start_target(const LoadedScenario& loaded) {
  if (loaded.scenario.start.from != StartSettings::From::target) return std::nullopt;
  return load_target(loaded);
}

std::unique_ptr<SlamEstimator> image_estimator(const LoadedScenario& loaded, const Camera& camera,
                                               const std::optional<Target>& target,
                                               const std::optional<WheelOdometry>& odometry) {
  const Scenario& s = loaded.scenario;
  return std::make_unique<SlamEstimator>(single_camera(camera, target, s.slam, s.start.max_search_s,
                                                       static_cast<std::uint64_t>(s.run.seed), odometry,
                                                       {.entropy = s.run.entropy}));
}

/// The frame of a recording's truth may differ from that of the target.
Assembly assemble_recorded_images(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  const Camera camera = make_camera(s.camera);
  const std::optional<Target> target = start_target(loaded);
  const auto recording = std::make_shared<const Recording>(with_rounded_stamps(read_recording(loaded)));
  const std::vector<double> times = frame_times(*recording, s.run.duration_s);
  Assembly out;
  put_scenario(loaded, out.info);
  out.info.rate_hz = mean_rate_hz(times);
  const bool is_frame_of_truth = s.recording.truth_frame == RecordingSettings::TruthFrame::estimate;
  out.info.ate_alignment = !target ? "sim3" : is_frame_of_truth ? "none" : "se3";
  out.notes = recording->notes;
  if (std::string compared = compare_camera(loaded, *recording); !compared.empty())
    out.notes.push_back(std::move(compared));
  if (!target) out.notes.emplace_back("no target: the scale is unobservable, lengths are in arbitrary units");
  auto estimator = image_estimator(loaded, camera, target);
  auto strategy = decide_for(*estimator, active_settings_of(s));
  out.parts = {std::make_unique<ReplayClock>(times, recording->whole_us),
               std::make_unique<ReplayWorld>(std::vector{recorded_truth(recording)}),
               std::make_unique<SensorSet>(sensors_of_body(
                   std::make_unique<RecordedImages>(recording, camera.width(), camera.height()))),
               std::move(estimator), std::move(strategy),
               // The recorded motion does not follow commands, and the filter must not predict by any
               std::make_unique<SteeringController>()};
  return out;
}

}  // namespace incognita
