#include "incognita/app/loop/assemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "incognita/app/loop/operator_assembly.hpp"
#include "incognita/control/camera_controller.hpp"
#include "incognita/decision/camera_decision.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/recordings/camera_of_recording.hpp"
#include "incognita/io/recordings/recorded.hpp"
#include "incognita/io/recordings/recording.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/target_file.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/slam/estimator/single_camera.hpp"
#include "incognita/world/rendered/room_camera.hpp"
#include "incognita/world/rendered/room_world.hpp"
#include "incognita/world/room_clock.hpp"

namespace incognita {
namespace {

struct Environment {
  std::unique_ptr<Clock> clock;
  std::unique_ptr<World> world;
  std::unique_ptr<Sensor> sensor;
};

Environment recorded_environment(const LoadedScenario& loaded, const Camera& camera,
                                 std::vector<std::string>& notes) {
  const auto recording = std::make_shared<const Recording>(read_recording(loaded));
  notes = recording->notes;
  if (std::string compared = compare_camera(loaded, *recording); !compared.empty())
    notes.push_back(std::move(compared));
  return {std::make_unique<RecordedClock>(recording, loaded.scenario.run.duration_s),
          std::make_unique<RecordedWorld>(recording),
          std::make_unique<RecordedSensor>(recording, camera.width(), camera.height())};
}

Environment rendered_environment(const LoadedScenario& loaded, const Camera& camera,
                                 const std::optional<Target>& target) {
  const Scenario& scenario = loaded.scenario;
  const auto seed = static_cast<std::uint64_t>(scenario.run.seed);
  auto room = std::make_shared<const Room>(scenario.room, seed);
  if (target) check_sheet(loaded, *target, room->layout().sheet);
  std::unique_ptr<Sensor> sensor = std::make_unique<RoomCamera>(room, camera, scenario.room, seed);
  std::optional<OperatorActuator> actuator;
  if (scenario.operator_settings.holds) actuator = operator_of(scenario, 0);
  return {std::make_unique<FixedRateClock>(scenario.run.rate_hz, scenario.run.duration_s),
          std::make_unique<RoomWorld>(room->layout(), scenario.room, seed, std::move(actuator)),
          std::move(sensor)};
}

Assembly assembled(const LoadedScenario& loaded) {
  const Scenario& scenario = loaded.scenario;
  const auto seed = static_cast<std::uint64_t>(scenario.run.seed);
  const Camera camera = make_camera(scenario.camera);
  std::optional<Target> target;
  if (scenario.start.from == StartSettings::From::target) target = load_target(loaded);
  const bool scale_is_known = target.has_value();
  std::vector<std::string> notes;
  Environment environment = scenario.is_recording() ? recorded_environment(loaded, camera, notes)
                                                    : rendered_environment(loaded, camera, target);
  return {
      {std::move(environment.clock), std::move(environment.world), std::move(environment.sensor),
       std::make_unique<SlamEstimator>(
           single_camera(camera, target, scenario.slam, scenario.start.max_search_s, seed)),
       std::make_unique<CameraDecision>(camera, scenario.slam, scenario.decision, scenario.exploration, seed),
       std::make_unique<CameraController>(scenario.control, scenario.operator_settings.holds)},
      scale_is_known,
      std::move(notes)};
}

}  // namespace

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

Assembly assemble(const LoadedScenario& loaded) {
  try {
    return assembled(loaded);
  } catch (const std::invalid_argument& error) {  // e.g. a room too small for its boxes
    throw InputError(shown(loaded.file) + ": " + error.what());
  }
}

}  // namespace incognita
