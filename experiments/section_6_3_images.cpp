// Section 6.3.1 on images: a camera that moves freely explores the rendered room.
//
// Experiment: scenarios/explore-room.toml with the features of the thesis (thesis_features.hpp) and the metric as
// printed, which counts all landmarks that are expected in unobserved space; the room, its boxes and its textures drawn
// from the seed; 15 images a second; 0.3 m a second; 35 s. The scenario's own metric beside it. The plan of the
// comparison, written before the runs: as for points (section_6_3.cpp), in rooms that were not used to choose any
// setting; entropies are of always 150 landmarks. Closing loops is tested over 60 s, in which the gaze turns around
// twice: landmarks of the first turn come back after about 31 s. Features began as inverse depths in a first run, as our
// default is, and not as the lines of Appendix C.3.
#include "experiments/common.hpp"
#include "experiments/exploring_claims.hpp"
#include "experiments/thesis_features.hpp"

namespace incognita::exploring {
namespace {

const Common images{
    "6.3-images", "Section 6.3.1",
    "on images of rendered rooms (features of Appendix C, begun as depth lines; start before a known sheet)"};
/// What is run with gaze (i) alone.
const Common at_constant_rate{images.id, images.place, "gaze (i) constant rate, " + images.world};

/// Away for so long is no swing of the gaze but a turn.
constexpr double turned_away_s = 20;

/// Of the seconds from the first return on: how much more the camera's entropy fell, in the mean, in those in
/// which landmarks came back after `turned_away_s` than in the others. Not a number where one of the two never
/// was.
double fall_by_returning(const Run& run) {
  double fallen[2] = {0, 0}, count[2] = {0, 0};
  bool any = false;
  for (std::size_t i = 1; i < run.decisions.size(); ++i) {
    const Decision &before = run.decisions[i - 1], &now = run.decisions[i];
    const bool returned = now.longest_away_s > turned_away_s;
    any = any || returned;
    const double fall = before.entropy_camera - now.entropy_camera;
    if (!any || !std::isfinite(fall)) continue;
    fallen[returned] += fall;
    ++count[returned];
  }
  return fallen[1] / count[1] - fallen[0] / count[0];
}

Claim closing_loops(const Runs& runs) {
  const std::vector<double> all = less(each(runs, fall_by_returning), std::vector<double>(runs.size()));
  const Interval more = bootstrap_mean(all);
  return assessed(
      "6.3-images-loops", "Section 6.3.2, Figure 6.7",
      fmt::format(
          "Closing loops reduces the camera's entropy: it falls by more in seconds in which landmarks "
          "are matched that were out of view for {} s than in others, a camera that turns around twice, {}",
          turned_away_s, at_constant_rate.world),
      {.rule = Rule::superiority,
       .measured = {"{} more", text(more, "nats/s")},
       .number = ClaimNumber{"fall of the camera's entropy, with returns less without", more, "nats/s"},
       .seeds = all.size()},
      is_above(more, 0));
}

LedgerEntry run_section_6_3_images(const ExperimentSettings& all_seeds) {
  const ExperimentSettings settings = half_of(all_seeds);
  const auto runs = [&](const Sets& sets, const std::vector<Strategy>& all) {
    return runs_of_all("explore-room", with(sets, with(as_printed_on_images("0.4"), all)), settings,
                       fresh_rooms);
  };
  const std::vector<Runs> gaze = runs({}, by_gaze()), rivals = runs({}, baselines());
  const Runs as_mapped =
      runs({"exploration.counted=as-mapped"}, {{"counting as mapped", by_gaze()[0].sets}}).front();
  const Runs turning = runs({"run.duration_s=60"}, {by_gaze()[0]}).front();
  const auto each_gaze = [&](std::size_t k, const char* id) {
    return against({images.id + id, images.place, images.world},
                   "Moving by mutual information, gaze " + gaze[k].name, gaze[k], rivals);
  };
  return entry_of(
      section_6_3_images, settings,
      {with_numbers(each_gaze(0, "-i"), in_numbers(gaze) + "; " + in_numbers(rivals)), each_gaze(1, "-ii"),
       each_gaze(2, "-iii"), gaze_claims(images, gaze), inside_its_bounds(images, "Figure 6.5", gaze[2]),
       closing_loops(turning), counted_as_mapped(at_constant_rate, as_mapped, rivals, gaze[0])},
      {});
}

}  // namespace
}  // namespace incognita::exploring

const incognita::Experiment incognita::section_6_3_images{
    "6.3-images", "A camera that explores by its images", {}, exploring::run_section_6_3_images, true};
