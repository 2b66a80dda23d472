// Cost of rendering: at 30 Hz a frame may take 33 ms in total, of which rendering should use little.
#include <benchmark/benchmark.h>

#include "incognita/models/motion/heading.hpp"
#include "incognita/models/sensors/wide_angle_camera.hpp"
#include "incognita/world/motion_spline.hpp"
#include "incognita/world/rendered/room_bodies.hpp"
#include "incognita/world/rendered/room_camera.hpp"

using namespace incognita;

namespace {

const std::shared_ptr<const Room>& room() {
  static const auto shared = std::make_shared<const Room>(RoomSettings{}, 1);
  return shared;
}

/// One complete image with noise, while the camera turns once around in the middle of the room.
void measure(benchmark::State& state) {
  RoomCamera camera(room(), WideAngleCamera{.kd1 = 9e-6}, RoomSettings{}, 1);
  RigidPose pose{{0.3, -0.2, 1.3}};
  std::int64_t frame = 0;
  for (auto _ : state) {
    pose.world_from_body = level_gaze(0.05 * static_cast<double>(frame));
    benchmark::DoNotOptimize(camera.image_from(pose, Tick{frame++, 0, 0}));
  }
  state.counters["frames"] = benchmark::Counter(static_cast<double>(frame), benchmark::Counter::kIsRate);
}
BENCHMARK(measure)->Unit(benchmark::kMillisecond);

/// The same at 640x480 with a rolling shutter and an exposure of the given ms: a hand that turns by 0.9 rad/s.
void measure_blurred(benchmark::State& state) {
  RoomSettings settings;
  settings.texel_m = 0.002;
  static const auto fine = std::make_shared<const Room>(settings, 1);
  RoomCamera camera(fine, WideAngleCamera{640, 480, 390, 390, 319.5, 239.5}, settings, 1, "sensor.image",
                    {.duration_s = 1e-3 * static_cast<double>(state.range(0)), .readout_s = 0.02});
  camera.follow([](double t) {
    return extrapolated({{{0.3, -0.2, 1.3}, level_gaze(0)}, {0.05, 0.05, 0}, {0.05, 0.9, 0.05}}, t);
  });
  Truth truth{{BodyTruth{RigidPose{}}}};
  std::int64_t frame = 0;
  for (auto _ : state) {
    BodyObservation observation;
    camera.measure(truth, 0, Tick{frame, static_cast<double>(frame % 30) / 30, 0}, observation);
    benchmark::DoNotOptimize(observation);
    ++frame;
  }
}
BENCHMARK(measure_blurred)->Arg(0)->Arg(5)->Arg(15)->Unit(benchmark::kMillisecond);

void paint_room(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Room(RoomSettings{}, 2));
}
BENCHMARK(paint_room)->Unit(benchmark::kMillisecond);

void move(benchmark::State& state) {
  SimulatedWorld world(camera_in_room(RoomSettings{}, room()->layout(), 1), 1);
  const Command command{{BodyCommand{(SmallVector(6) << 0.1, 0, 0, 0, 0.1, 0).finished()}}};
  for (auto _ : state) benchmark::DoNotOptimize(world.move(command, {1, 1.0 / 30, 1.0 / 30}));
}
BENCHMARK(move);

}  // namespace
