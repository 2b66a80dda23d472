// How wrong a matched patch is, against the truth of the rendered room, and for how long it stays wrong.
//
// A landmark is the patch at one pixel of one image: its true position is where the true ray of that pixel
// meets the room. The error of a match is the pixel that was measured minus the pixel where the true camera
// projects the true position. Noise differs from frame to frame; the part that does not makes a filter
// overconfident.
//
//   build/patch_error "1 2 3" [KEY=VALUE...] > errors.csv       # seeds; settings of `incognita config room`
//
// Prints `lag_s,covariance_px2,pairs`: the mean product of a match's error with that of the same landmark
// `lag_s` later, over both axes, all landmarks and seeds; at lag 0 it is the mean square error.
#include <cstdio>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/first_surface.hpp"
#include "incognita/app/loop/assembly.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/slam/estimator/slam_estimator.hpp"

using namespace incognita;

namespace {

constexpr double rate_hz = 30;
constexpr int lags[] = {0, 1, 2, 3, 5, 10, 15, 30, 45, 60, 90, 120, 180, 240, 300};  // frames

using Errors = std::map<std::int64_t, Eigen::Vector2d>;  ///< px, by frame

/// Runs the loop as the program does, and keeps the error of every match that was used.
std::map<std::int64_t, Errors> errors_of_a_run(const std::string& seed,
                                               const std::vector<std::string>& sets) {
  const LoadedScenario loaded =
      load_scenario("room", sets, std::vector<Flag>{{"run.seed", seed, "argument"}});
  Assembly assembly = assemble(loaded);
  const Camera camera = make_camera(loaded.scenario.camera);
  const RoomLayout room = room_layout(loaded.scenario.room, std::stoull(seed));
  auto& [clock, world, sensor, estimator, decision, controller, map_truth] = assembly.parts;
  Estimate estimate;
  Command command;
  std::map<std::int64_t, Eigen::Vector3d> places;
  std::map<std::int64_t, Errors> errors;
  while (const Tick tick = clock->next()) {
    const auto truth = world->move(command, tick);
    const Observation observation = sensor->measure(truth, tick);
    estimator->update(estimate, command, observation, tick);
    const Eigen::Vector3d position = truth->bodies[0].pose->position;
    const Eigen::Matrix3d R = rotation_matrix<double>(truth->bodies[0].pose->world_from_body);
    for (const Match& match : estimate.last.matches) {
      const auto place = places.find(match.id);
      if (match.outcome != MatchOutcome::matched || place == places.end()) continue;
      const auto at = camera.project(R.transpose() * (place->second - position));
      if (at) errors[match.id][tick.frame] = match.measured - at->pixel;
    }
    const auto& tracker = dynamic_cast<const SlamEstimator&>(*estimator).cameras().front();
    for (const auto& [id, feature] : tracker.camera().features) {
      if (places.count(id)) continue;
      const Landmark& initialized = estimate.landmarks.at(id);
      const auto ray = camera.unproject(feature.view.pixel);
      if (ray)
        places[id] = initialized.fixed ? Eigen::Vector3d(initialized.position)
                                       : first_surface(room, position, R * *ray);
    }
    command = controller->act(estimate, decision->choose(estimate, observation, tick), observation, tick);
  }
  return errors;
}

struct Sum {
  double products = 0;
  std::int64_t pairs = 0;
};

void add_products(const Errors& errors, std::map<int, Sum>& by_lag) {
  for (const auto& [frame, error] : errors)
    for (const int lag : lags) {
      const auto later = errors.find(frame + lag);
      if (later == errors.end()) continue;
      by_lag[lag].products += error.dot(later->second) / 2;
      ++by_lag[lag].pairs;
    }
}

}  // namespace

int main(int argc, char** argv) try {
  std::istringstream seeds(argc > 1 ? argv[1] : "1");
  const std::vector<std::string> sets(argv + std::min(argc, 2), argv + argc);
  std::map<int, Sum> by_lag;
  for (std::string seed; seeds >> seed;)
    for (const auto& [id, errors] : errors_of_a_run(seed, sets)) add_products(errors, by_lag);
  std::printf("lag_s,covariance_px2,pairs\n");
  for (const auto& [lag, sum] : by_lag)
    std::printf("%.4f,%.6f,%lld\n", lag / rate_hz, sum.products / static_cast<double>(sum.pairs),
                static_cast<long long>(sum.pairs));
  return 0;
} catch (const InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
