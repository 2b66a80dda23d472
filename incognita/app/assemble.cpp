#include "incognita/app/assemble.hpp"

#include "incognita/io/camera.hpp"
#include "incognita/io/recorded.hpp"
#include "incognita/io/recording.hpp"
#include "incognita/io/target_file.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/world/room_camera.hpp"
#include "incognita/world/room_clock.hpp"
#include "incognita/world/room_world.hpp"

namespace incognita {
namespace {

struct Place {
  std::unique_ptr<Clock> clock;
  std::unique_ptr<World> world;
  std::unique_ptr<Sensor> sensor;
};

Place recorded_place(const LoadedScenario& loaded, const Camera& camera, std::vector<std::string>& notes) {
  const auto recording = std::make_shared<const Recording>(read_recording(loaded));
  notes = recording->notes;
  return {std::make_unique<RecordedClock>(recording, loaded.scenario.run.duration_s),
          std::make_unique<RecordedWorld>(recording),
          std::make_unique<RecordedSensor>(recording, camera.width(), camera.height())};
}

Place rendered_place(const Scenario& scenario, const Camera& camera) {
  const auto seed = static_cast<std::uint64_t>(scenario.run.seed);
  auto room = std::make_shared<const Room>(scenario.room, seed);
  return {std::make_unique<RoomClock>(scenario.run.rate_hz, scenario.run.duration_s),
          std::make_unique<RoomWorld>(room->layout(), scenario.room, seed),
          std::make_unique<RoomCamera>(room, camera, scenario.room, seed)};
}

}  // namespace

Assembly assemble(const LoadedScenario& loaded) {
  const Scenario& scenario = loaded.scenario;
  const Camera camera = make_camera(scenario.camera);
  std::optional<Target> target;
  if (scenario.start.from == "target") target = load_target(loaded);
  const bool scale_is_known = target.has_value();
  std::vector<std::string> notes;
  Place place = scenario.run.world == "recording" ? recorded_place(loaded, camera, notes)
                                                  : rendered_place(scenario, camera);
  return {{std::move(place.clock), std::move(place.world), std::move(place.sensor),
           CameraEstimator(camera, std::move(target), scenario.slam, scenario.start.max_search_s,
                           static_cast<std::uint64_t>(scenario.run.seed)),
           CameraDecision(camera, scenario.slam, scenario.decision), CameraController(scenario.control)},
          scale_is_known,
          std::move(notes)};
}

}  // namespace incognita
