// Section 6.4: a vehicle with a camera explores a room over uneven ground, and how it drives.
//
// Experiment: scenarios/terrain.toml (room of 6 x 6 x 2.5 m, 31 points, 6 of them known; Table 6.1 with 0.5
// m/s^2 and 0.3 rad/s^2 every 15th of 15 cycles a second, acting until 0.3 m/s and 0.3 rad/s; waves of 0.1 m;
// 60 s). What is estimated is a
// camera that flies, which knows nothing of the wheels. The plan of the comparison, written before the runs:
// as in Section 6.3, strategies paired by seed, judged by the entropy of camera, map and what is not mapped
// yet together at the end.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/evidence.hpp"
#include "experiments/exploring_comparison.hpp"
#include "experiments/list.hpp"
#include "incognita/math/quaternion.hpp"

namespace incognita {
namespace {

using namespace exploring;

const char* const to_and_fro = "decision.sequence=faster stay stay stay slower slower stay stay stay faster";

const std::vector<Strategy>& strategies() {
  static const std::vector<Strategy> all{{"mutual information", {}},
                                         {"at random", {"decision.strategy=random"}},
                                         {"to and fro", {"decision.strategy=fixed-path", to_and_fro}},
                                         {"standing", {"decision.strategy=none"}}};
  return all;
}

/// Of the way that it went the share that it went backwards.
double share_backwards(const Run& run) {
  double back = 0, all = 0;
  for (std::size_t i = 1; i < run.instants.size(); ++i) {
    const StampedPose &from = run.instants[i - 1].truth, &to = run.instants[i].truth;
    const Eigen::Vector3d ahead = rotation_matrix<double>(from.orientation).col(2);
    const double way = (to.position - from.position).dot(ahead);
    back += std::max(0.0, -way);
    all += std::abs(way);
  }
  return all > 0 ? back / all : std::nan("");
}

/// Of the errors of position, axis by axis, the share inside 2 sigma.
double share_inside(const Run& run) {
  double inside = 0, all = 0;
  for (const Instant& i : run.instants) {
    const Eigen::Vector3d error = i.truth.position - i.estimate.position;
    for (int axis = 0; axis < 3; ++axis)
      inside += std::abs(error[axis]) <= 2 * std::sqrt(i.covariance(axis, axis)), ++all;
  }
  return inside / all;
}

Claim backs_away(const Runs& runs) {
  const std::vector<double> shares = each(runs, share_backwards);
  std::vector<double> beyond_half;
  for (const double share : shares)
    if (std::isfinite(share)) beyond_half.push_back(share - 0.5);
  const Interval more = bootstrap_mean(beyond_half, judged_at);
  int slower = 0, faster = 0;
  for (const Run& run : runs)
    for (const exploring::Decision& d : run.decisions) {
      slower += d.action.starts_with("slower");
      faster += d.action.starts_with("faster");
    }
  return judged(
      {.id = "6.4-backwards",
       .place = "Section 6.4.2, Figure 6.9",
       .statement = "The vehicle explores by repeatedly choosing a negative linear acceleration: of "
                    "the way that it goes more than half is backwards",
       .printed = "backwards linear motion increasing the field of view",
       .measured = fmt::format("share backwards less a half: {} (99.9 %); {} decisions for slower, "
                               "{} for faster",
                               text(more), slower, faster),
       .why = "it starts at a wall here, with nowhere to back to, and then drives both ways alike",
       .runs = static_cast<int>(runs.size())},
      more.low > 0);
}

Claim inside_its_bounds(const Runs& runs) {
  const Interval inside = bootstrap_mean(each(runs, share_inside));
  return judged({.id = "6.4-bounds",
                 .place = "Figure 6.10",
                 .statement = "A camera that flies is model enough for one on wheels: 95 % of the errors of "
                              "its position are inside their 2 sigma bounds, ground and wheels unknown to "
                              "the filter",
                 .printed = "2 sigma variance bounds",
                 .measured = fmt::format("{} inside", text(inside)),
                 .why = "it is a little too sure: what the ground does to the camera is no noise that is "
                        "drawn anew in every frame",
                 .runs = static_cast<int>(runs.size())},
                inside.high >= 0.95);
}

LedgerEntry run(const ExperimentSettings& all_seeds) {
  ExperimentSettings settings = all_seeds;
  settings.seeds = (all_seeds.seeds + 3) / 4;
  LedgerEntry entry{section_6_4.id, section_6_4.title, "", {}, {}};
  std::vector<Runs> runs;
  for (const Strategy& s : strategies()) runs.push_back(runs_of("terrain", s, settings));
  const char* place = "Section 6.4.2";
  Claim random = beats("6.4-random", place,
                       "Driving by mutual information leaves less entropy than driving at random, by the "
                       "accelerations of Table 6.1",
                       "driving at random", runs[0], runs[1], "");
  random.measured += ". ";
  for (std::size_t s = 0; s < runs.size(); ++s)
    random.measured += in_numbers(strategies()[s].name, runs[s]) + (s + 1 < runs.size() ? "; " : "");
  entry.claims = {
      random,
      beats("6.4-fixed", place, "Likewise less than driving to and fro", "driving to and fro", runs[0],
            runs[2], ""),
      beats("6.4-standing", place, "Likewise less than standing", "standing", runs[0], runs[3], ""),
      backs_away(runs[0]), inside_its_bounds(runs[0])};
  std::vector<std::string> names;
  for (const Strategy& s : strategies()) names.push_back(s.name);
  for (const Plot& plot :
       {map_figure("fig-6.9", "A vehicle that explores, by how it drives", names, runs),
        error_figure("fig-6.10", "Estimation errors of its camera and their 2 sigma bounds", names, runs)})
    entry.figures.push_back(draw_plot(settings.out, plot, nullptr));
  return entry;
}

}  // namespace

const Experiment section_6_4{
    "6.4", "A vehicle that explores over uneven ground", {"fig-6.9", "fig-6.10"}, run};

}  // namespace incognita
