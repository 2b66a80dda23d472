// Appendix C on images: depths of new features by particles, features that are close together, and bad features.
//
// Experiment: scenarios/explore-room.toml with the features of the thesis (thesis_features.hpp), moved at random, gaze at
// a constant rate, 10 s, 20 rooms. For bad features there is dirt on the lens: a square of 44 pixels with a texture of its
// own, always at the same place of the image, so that features on it are no points of the room; there with inverse
// depths, which are in the map at once. The plan, written before the runs:
// - "a small number of steps" is less than 15 measurements, one second of images, in the median of all lines that
//   become points;
// - close features are pairs of points less than 0.5 m apart at the end. "Uncertain with respect to the world but well
//   known relative to each other": the sigma (root of the trace) of their difference is less than that of independent
//   features would be, and less than half of it in the mean;
// - of features that are at least 2 s old at the end, more of those on the dirt are deleted than of others, and at least
//   half of them.
#include <map>
#include <set>

#include "experiments/appendix_c.hpp"
#include "experiments/common.hpp"
#include "experiments/exploring_comparison.hpp"
#include "experiments/thesis_features.hpp"
#include "incognita/app/loop/assembly.hpp"

namespace incognita {
namespace appendix_c_runs_on_images {
namespace {

constexpr double duration_s = 10, close_m = 0.5, old_s = 2;
constexpr int dirt_px = 44;
const Eigen::Array2d dirt_at(60, 40);  ///< its first column and row

/// Every image with the dirt.
class DirtyLens final : public Sensor {
 public:
  DirtyLens(std::unique_ptr<Sensor> sensors, std::uint64_t seed) : sensors_(std::move(sensors)) {
    RandomStream random(seed, "dirt");
    for (std::uint8_t& gray : grays_) gray = static_cast<std::uint8_t>(random.below(256));
  }

  Observation measure(const std::optional<Truth>& truth, const Tick& tick) override {
    Observation observation = sensors_->measure(truth, tick);
    std::shared_ptr<const Image>& image = observation.bodies.front().images.front();
    Image dirty = *image;
    for (int v = 0; v < dirt_px; ++v)
      for (int u = 0; u < dirt_px; ++u)
        dirty(static_cast<int>(dirt_at.x()) + u, static_cast<int>(dirt_at.y()) + v) =
            grays_[static_cast<std::size_t>(v / 4 * (dirt_px / 4) + u / 4)];
    image = std::make_shared<const Image>(std::move(dirty));
    return observation;
  }

 private:
  std::unique_ptr<Sensor> sensors_;
  std::array<std::uint8_t, (dirt_px / 4) * (dirt_px / 4)> grays_{};  ///< of squares of 4 pixels
};

struct Fate {
  double born_s = 0;
  bool on_dirt = false, deleted = false;
};

/// What became of the landmarks of one run.
struct Landmarks {
  std::map<std::int64_t, int> measured;  ///< lines: how often, until now
  std::vector<int> steps;                ///< of lines that became points
  std::map<std::int64_t, Fate> fates;    ///< of all but anchors
  std::vector<double>
      of_independent;  ///< of close pairs: sigma of the difference over that of independent ones
  std::vector<double> sigma_m, apart_m;  ///< of these: sigma of the positions, and of the difference

  void see(const Estimate& estimate, double t_s) {
    for (const Match& match : estimate.last.matches) {
      if (match.anchor || match.of_body) continue;
      if (match.ray && match.outcome == MatchOutcome::matched) ++measured[match.id];
      if (match.predicted.size() != 2) continue;
      const Eigen::Array2d at = match.predicted.array() - dirt_at;
      fates.try_emplace(match.id, Fate{t_s, (at > 0).all() && (at < dirt_px - 1).all(), false});
    }
    for (auto line = measured.begin(); line != measured.end();) {
      const auto landmark = estimate.landmarks.find(line->first);
      const bool known = landmark != estimate.landmarks.end();
      if (known && landmark->second.mapped()) steps.push_back(line->second);
      line = known && !landmark->second.mapped() ? std::next(line) : measured.erase(line);
    }
    for (auto& [id, fate] : fates) fate.deleted = !estimate.landmarks.contains(id);
  }

  void end(const Estimate& estimate) {
    std::vector<BlockId> points;
    for (const auto& [id, landmark] : estimate.landmarks)
      if (landmark.mapped() && landmark.form.kind == LandmarkParametrization::Kind::point)
        points.push_back(landmark.block);
    const auto& belief = estimate.belief;
    for (std::size_t a = 0; a < points.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        if ((belief.mean(points[a]) - belief.mean(points[b])).norm() > close_m) continue;
        const double alone = belief.covariance(points[a]).trace() + belief.covariance(points[b]).trace(),
                     together = alone - 2 * belief.covariance(points[a], points[b]).trace();
        of_independent.push_back(std::sqrt(together / alone));
        sigma_m.push_back(std::sqrt(alone / 2)), apart_m.push_back(std::sqrt(together));
      }
  }
};

Landmarks landmarks_of(std::uint64_t seed, bool dirty) {
  exploring::Sets sets =
      exploring::as_printed_on_images("0.4", dirty ? exploring::inverse_depths() : exploring::depth_lines());
  sets.insert(sets.end(),
              {"decision.strategy=random", "decision.gaze=constant-rate", "decision.schedule=at-decisions",
               fmt::format("run.duration_s={}", duration_s), fmt::format("run.seed={}", seed)});
  Assembly assembly = assemble(load_scenario("explore-room", sets));
  auto& sensor = assembly.parts.sensor;
  if (dirty) sensor = std::make_unique<DirtyLens>(std::move(sensor), seed);
  Landmarks landmarks;
  LoopState state;
  int frame = 0;
  run_loop(
      assembly.parts, state, [](const Snapshot&) {}, [](const Tick&) { return true; },
      [&](const Estimate& estimate) { landmarks.see(estimate, frame++ / 15.0); }, {});
  landmarks.end(state.estimate);
  return landmarks;
}

Claim small_number_of_steps(const std::vector<Landmarks>& rooms) {
  std::vector<double> medians, all;
  for (const Landmarks& room : rooms) {
    all.insert(all.end(), room.steps.begin(), room.steps.end());
    medians.push_back(median_of({room.steps.begin(), room.steps.end()}));
  }
  std::ranges::sort(all);
  const double slow = all.empty() ? std::nan("") : all[all.size() * 9 / 10];
  const Interval steps = bootstrap_mean(less(medians, std::vector<double>(medians.size())));
  return assessed(
      "C.3-steps", "Appendix C.3",
      "A small number of steps reduces sigma over depth of 100 particles from 0.5 to 5 m below the threshold of 0.3: "
      "fewer than 15 measurements, a second of images, in the median of a room",
      {.rule = Rule::superiority,
       .measured = {"median of a room {}; {} lines became points, the slowest tenth after {} or more",
                    text(steps), all.size(), decimals(slow, 0)},
       .number = ClaimNumber{"measurements until a line becomes a point, median of a room", steps},
       .seeds = rooms.size()},
      is_below(steps, 15));
}

double mean_or_nan(const std::vector<double>& numbers) {
  return numbers.empty() ? std::nan("") : mean_of(numbers).value;
}

Claim close_features(const std::vector<Landmarks>& rooms) {
  const auto of = [&](std::vector<double> Landmarks::*numbers) {
    const std::vector<double> means =
        each(rooms, [&](const Landmarks& room) { return mean_or_nan(room.*numbers); });
    return less(means, std::vector<double>(means.size()));
  };
  const Interval ratio = bootstrap_mean(of(&Landmarks::of_independent));
  return assessed(
      "C.1-close", "Appendix C.1",
      fmt::format(
          "Close features have positions that are uncertain in the world and differences that are well known: "
          "of points within {} m of each other the sigma of the difference is less than half of what it "
          "would be if they were independent, after {:.0f} s in rendered rooms",
          close_m, duration_s),
      {.rule = Rule::superiority,
       .measured = {"{} of it; sigma of a position {}, of a difference {}", text(ratio),
                    text(bootstrap_mean(of(&Landmarks::sigma_m)), "m"),
                    text(bootstrap_mean(of(&Landmarks::apart_m)), "m")},
       .number =
           ClaimNumber{"sigma of the difference of close features over that of independent ones", ratio},
       .why = "less than that of independent ones, but not by half",
       .seeds = rooms.size()},
      is_below(ratio, 0.5), in_truth(is_below(ratio, 1)));
}

Claim prunes_bad_features(const std::vector<Landmarks>& rooms) {
  struct Deleted {
    double bad, good;
  };
  int bad_deleted = 0, bad = 0;
  const std::vector<Deleted> deleted = [&] {
    std::vector<Deleted> all;
    for (const Landmarks& room : rooms) {
      double count[2] = {0, 0}, gone[2] = {0, 0};
      for (const auto& [id, fate] : room.fates)
        if (fate.born_s < duration_s - old_s) ++count[fate.on_dirt], gone[fate.on_dirt] += fate.deleted;
      all.push_back({gone[1] / count[1], gone[0] / count[0]});
      bad_deleted += static_cast<int>(gone[1]), bad += static_cast<int>(count[1]);
    }
    return all;
  }();
  const Interval more = bootstrap_mean(less(each(deleted, &Deleted::bad), each(deleted, &Deleted::good)));
  return assessed(
      "C.4-deletion", "Appendix C.4",
      fmt::format(
          "Deletion when more than half of the attempts fail prunes bad features, which are no true points: of "
          "features on dirt on the lens that are {} s old half or more are deleted, and a larger share than of "
          "others, in rendered rooms with features that are in the map at once, as inverse depths",
          old_s),
      {.rule = Rule::superiority,
       .measured = {"{} of {} on the dirt; share deleted, more than of others in the same room: {}",
                    bad_deleted, bad, text(more)},
       .number = ClaimNumber{"share of features on dirt that is deleted, less that of others", more},
       .seeds = rooms.size()},
      happens_in(0.5, bad_deleted, bad) && is_above(more, 0));
}

LedgerEntry run(const ExperimentSettings& settings) {
  const int rooms = (settings.seeds + 9) / 10;
  const auto of_rooms = [&](bool dirty) {
    return over_seeds(rooms, [&](std::uint64_t seed) { return landmarks_of(seed, dirty); });
  };
  const std::vector<Landmarks> clean = of_rooms(false), dirty = of_rooms(true);
  return entry_of(appendix_c_runs, settings,
                  {small_number_of_steps(clean), close_features(clean), prunes_bad_features(dirty),
                   appendix_c::clutter_claims(rooms)});
}

}  // namespace
}  // namespace appendix_c_runs_on_images

const Experiment appendix_c_runs{"C-images",
                                 "Appendix C on images: depths, close features and bad ones",
                                 {},
                                 appendix_c_runs_on_images::run,
                                 true};

}  // namespace incognita
