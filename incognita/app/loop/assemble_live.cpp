#include <fmt/format.h>

#include "incognita/app/loop/assemblers.hpp"
#include "incognita/app/loop/body_models.hpp"
#include "incognita/control/steering_controller.hpp"
#include "incognita/decision/decision.hpp"
#include "incognita/io/cameras/video_address.hpp"
#include "incognita/io/cameras/video_stream.hpp"
#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/stream_times.hpp"
#include "incognita/world/live/sized_images.hpp"

namespace incognita {
namespace {

/// A device or an address as it is; a video beside the scenario or under the data folder.
std::string place_of(const LoadedScenario& loaded) {
  const std::string& source = loaded.scenario.live.source;
  if (is_device(source) || is_address(source)) return source;
  return find_data(source, loaded.file, loaded.source_of("live.source") + ": live.source").string();
}

std::shared_ptr<LiveSource> source_of(const LoadedScenario& loaded, const LiveSources& sources) {
  const Scenario& s = loaded.scenario;
  if (sources.is_check_only) return nullptr;
  if (s.live.source != LiveSettings::browser)
    return std::make_shared<VideoStream>(
        VideoStreamSettings{place_of(loaded), s.camera.width_px, s.camera.height_px, s.run.rate_hz});
  if (sources.browser) return sources.browser;
  throw InputError(fmt::format(
      "{}: live.source = browser: the camera is that of a device which has the page open; run with --view, on a phone with "
      "--phone, or name a device such as /dev/video0",
      loaded.source_of("live.source")));
}

}  // namespace

/// The operator moves the camera, and sees what is decided; the filter predicts without a command.
Assembly assemble_live_camera(const LoadedScenario& loaded, const LiveSources& sources) {
  const Scenario& s = loaded.scenario;
  const Camera camera = make_camera(s.camera);
  const std::optional<Target> target = start_target(loaded);
  LiveFeedSettings feed{s.run.duration_s, 1 / s.run.rate_hz, std::nullopt, s.live.give_up_s};
  Assembly out;
  put_scenario(loaded, out.info);
  out.info.ate_alignment = target ? "se3" : "sim3";
  out.live = std::make_shared<LiveFeed>(
      feed, std::make_shared<SizedImages>(source_of(loaded, sources), camera.width(), camera.height()),
      steady_s);
  if (sources.is_check_only)
    out.notes.push_back("the camera, " + without_password(s.live.source) + ", is not tried");
  if (!target) out.notes.emplace_back("no target: the scale is unobservable, lengths are in arbitrary units");
  auto estimator = image_estimator(loaded, camera, target);
  auto strategy = decide_for(*estimator, active_settings_of(s));
  out.parts = {std::make_unique<LiveClock>(out.live),
               std::make_unique<LiveWorld>(),
               std::make_unique<LiveSensors>(out.live),
               std::move(estimator),
               std::move(strategy),
               std::make_unique<SteeringController>(std::vector{free_camera_control(s.control, true)})};
  return out;
}

}  // namespace incognita
