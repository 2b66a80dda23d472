// Cost of run.mcap per frame: at 30 Hz a frame may take 33 ms in total.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "../tests/record/synthetic_run.hpp"
#include "incognita/record/mcap/snapshot_log.hpp"

using namespace incognita;

namespace {

/// Noise compresses worst, and images of the rendered room are noisy.
std::shared_ptr<const Image> noisy_image() {
  auto image = std::make_shared<Image>(320, 240);
  RandomStream random(1, "record bench");
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u)
      (*image)(u, v) =
          static_cast<std::uint8_t>(120 + 60 * std::sin(0.05 * u * v / 40) + 3 * random.normal());
  return image;
}

/// Twelve searched features, 45 landmarks, an image in every other frame and a map in every thirtieth.
void publish(benchmark::State& state) {
  const auto path = std::filesystem::temp_directory_path() / ("record_bench_" + std::to_string(::getpid()));
  Snapshot snapshot = testing::synthetic_snapshot({}, 450);
  snapshot.image = noisy_image();
  for (int i = 0; i < 5; ++i) snapshot.matches.push_back(snapshot.matches[static_cast<std::size_t>(i)]);
  std::int64_t frame = 0;
  {
    SnapshotLog log(path, RunInfo{});
    for (auto _ : state) {
      snapshot.tick = {frame, static_cast<double>(frame) / 30, 1.0 / 30};
      log.publish(snapshot);
      ++frame;
    }
    log.close(snapshot.landmarks);
  }
  state.counters["kB"] =
      static_cast<double>(std::filesystem::file_size(path)) / 1e3 / static_cast<double>(frame);
  std::filesystem::remove(path);
}
BENCHMARK(publish)->Unit(benchmark::kMillisecond)->Iterations(1800);

}  // namespace
