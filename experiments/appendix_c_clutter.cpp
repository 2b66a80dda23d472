// Clutter that occludes landmarks for a while: Appendix C.4.
//
// Experiment: scenarios/explore-room.toml with the features of the thesis, moved at random, gaze at a constant rate,
// 10 s, 20 rooms; with and without clutter: three squares of 48 pixels, 9 % of the image, each with a texture of its own,
// that cross the image at 30 to 60 px/s and come back at the other side. The plan, written before the runs: clutter can
// be dealt with if the position errors are within a factor of 1.25 of those without clutter, which a lost camera's
// are not. After a first run one square was added.
#include "experiments/appendix_c.hpp"
#include "experiments/common.hpp"
#include "experiments/exploring_comparison.hpp"
#include "experiments/paired_factor.hpp"
#include "experiments/thesis_features.hpp"
#include "incognita/app/loop/assembly.hpp"

namespace incognita::appendix_c {
namespace {

using exploring::Runs;

constexpr int clutter_px = 48, texel_px = 4, texels = clutter_px / texel_px;

struct Occluder {
  Vector2d start, velocity_px_s;
  std::array<std::uint8_t, texels * texels> grays;

  explicit Occluder(RandomStream& random) {
    start = {random.uniform(0, 320), random.uniform(0, 240)};
    const double way = random.uniform(0, 2 * pi), speed = random.uniform(30, 60);
    velocity_px_s = speed * Vector2d(std::cos(way), std::sin(way));
    for (std::uint8_t& gray : grays) gray = static_cast<std::uint8_t>(random.below(256));
  }

  void draw(Image& image, double t_s) const {
    const auto wrapped = [](double x, int size) {
      const double within = std::fmod(x, size);
      return static_cast<int>(within < 0 ? within + size : within);
    };
    const Vector2d at = start + t_s * velocity_px_s;
    for (int v = 0; v < clutter_px; ++v)
      for (int u = 0; u < clutter_px; ++u)
        image(wrapped(at.x() + u, image.width()), wrapped(at.y() + v, image.height())) =
            grays[static_cast<std::size_t>(v / texel_px * texels + u / texel_px)];
  }
};

/// Draws them into every image.
class Cluttered final : public Sensor {
 public:
  Cluttered(std::unique_ptr<Sensor> sensors, int occluders, std::uint64_t seed)
      : sensors_(std::move(sensors)) {
    RandomStream random(seed, "clutter");
    for (int i = 0; i < occluders; ++i) occluders_.emplace_back(random);
  }

  Observation measure(const std::optional<Truth>& truth, const Tick& tick) override {
    Observation observation = sensors_->measure(truth, tick);
    std::shared_ptr<const Image>& image = observation.bodies.front().images.front();
    Image drawn = *image;
    for (const Occluder& occluder : occluders_) occluder.draw(drawn, tick.t);
    image = std::make_shared<const Image>(std::move(drawn));
    return observation;
  }

 private:
  std::unique_ptr<Sensor> sensors_;
  std::vector<Occluder> occluders_;
};

Runs runs_of(int occluders, int rooms) {
  exploring::Sets sets = exploring::as_printed_on_images("0.4");
  sets.insert(sets.end(), {"decision.strategy=random", "decision.gaze=constant-rate",
                           "decision.schedule=at-decisions", "run.duration_s=10"});
  const auto run = [&](std::uint64_t seed) {
    return exploring::explore("explore-room", sets, seed, [&](Assembly& assembly) {
      auto& sensor = assembly.parts.sensor;
      if (occluders > 0) sensor = std::make_unique<Cluttered>(std::move(sensor), occluders, seed);
    });
  };
  return {over_seeds(rooms, run), fmt::format("{} occluders", occluders)};
}

}  // namespace

std::vector<Claim> clutter_claims(int rooms) {
  const Runs without = runs_of(0, rooms), with = runs_of(3, rooms), with_one = runs_of(1, rooms);
  const auto error_of = [&](const Runs& runs) {
    return exploring::times(without, runs, &exploring::Run::position_rms_m);
  };
  const Interval error = error_of(with), of_one = error_of(with_one);
  return {assessed(
      "C.4-clutter", "Appendix C.4",
      "A degree of clutter can be dealt with even if it sometimes occludes landmarks: with 9 % of the image covered by "
      "what moves through it position errors are within a factor of 1.25 of those without clutter, on images of rendered "
      "rooms",
      {.rule = Rule::equality,
       .measured =
           {"error over that without clutter: {}; diverged {}, without {} of {}. With one square, 3 %: {}, diverged {}",
            text(error), exploring::diverged_of(with), exploring::diverged_of(without), rooms, text(of_one),
            exploring::diverged_of(with_one)},
       .number = ClaimNumber{"position error with clutter over that without", error},
       .why = "the errors are larger, with a third of that clutter, too",
       .seeds = rooms},
      as_good(error), in_truth(is_above(error, as_good_factor) && is_above(of_one, 1)))};
}

}  // namespace incognita::appendix_c
