// Campaign statistics against values computed by hand.
#include "incognita/report/campaign_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "incognita/messages/errors.hpp"
#include "incognita/report/campaign_figure.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

CampaignRun run(std::int64_t seed, double error) {
  return {seed, true, "", 0.5, {{{"error_m", error}}, {{"timing_ms.frame.median", 2}}}};
}

CampaignRun failure(std::int64_t seed, double error) {
  CampaignRun failed = run(seed, error);
  failed.done = false;
  failed.reason = "lost, \"far\" away";
  return failed;
}

Campaign two_variants() {
  Campaign campaign{"small", "1", {1, 2, 3, 4, 5, 6, 7}, {}, 0};
  campaign.variants.push_back(
      {"a=1",
       {{"a", "1"}},
       {run(1, 1), run(2, 2), run(3, 3), run(4, 4), run(5, 5), run(6, 6), failure(7, 9)}});
  campaign.variants.push_back(
      {"a=2", {{"a", "2"}}, {run(1, 2), run(2, 1), run(3, 4), run(4, 5), run(5, 6), failure(6, 1e9)}});
  return campaign;
}

const MeasureStatistics& find(const VariantStatistics& s, const std::string& name) {
  return *std::find_if(s.measures.begin(), s.measures.end(),
                       [&](const auto& m) { return m.measure == name; });
}

TEST(CampaignStatistics, UseCompletedRuns) {
  const auto all = statistics_of(two_variants());
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[1].runs, 7u);
  EXPECT_EQ(all[1].done, 5u);
  EXPECT_EQ(all[1].failed, 1u);
  EXPECT_EQ(all[1].missing, 1u);
  const MeasureStatistics& error = find(all[1], "error_m");
  EXPECT_EQ(error.n, 5u);
  EXPECT_DOUBLE_EQ(error.mean.value, 3.6);
  EXPECT_EQ(error.median, 4);
  // 2.776445 is Student's t with 4 degrees of freedom at 97.5 %; squared deviations from the mean add up to
  // 17.2
  EXPECT_NEAR(error.mean.high - 3.6, 2.776445 * std::sqrt(17.2 / 4 / 5), 1e-6);
}

TEST(CampaignStatistics, PairSeedsThatAreCompletedInBoth) {
  const auto all = statistics_of(two_variants());
  const PairedComparison& c = find(all[1], "error_m").versus_baseline;  // 1 -1 1 1 1
  EXPECT_EQ(c.pairs, 5u);
  EXPECT_DOUBLE_EQ(c.difference.value, 0.6);
  EXPECT_DOUBLE_EQ(c.share_lower, 0.2);
  EXPECT_DOUBLE_EQ(c.share_higher, 0.8);
  EXPECT_DOUBLE_EQ(c.difference.high, 1);
  EXPECT_DOUBLE_EQ(c.difference.low,
                   -0.2);  // -1 occurs three or more times in five draws with 5.8 %, four times with 0.7 %
}

TEST(CampaignStatistics, CountFailuresAsAMeasure) {
  const auto all = statistics_of(two_variants());
  const MeasureStatistics& failed = find(all[1], "failed");
  EXPECT_EQ(failed.n, 6u);
  EXPECT_DOUBLE_EQ(failed.mean.value, 1.0 / 6);
  EXPECT_EQ(failed.versus_baseline.pairs, 6u);  // seed 7 is not completed in both
  EXPECT_DOUBLE_EQ(failed.versus_baseline.difference.value, 1.0 / 6);
}

TEST(CampaignStatistics, StateHowManyRunsAndPairsFailuresExclude) {
  const auto all = statistics_of(two_variants());
  const MeasureStatistics &a = find(all[0], "error_m"), &b = find(all[1], "error_m");
  EXPECT_EQ(a.ended, 7u);
  EXPECT_DOUBLE_EQ(a.share_failed, 1.0 / 7);
  EXPECT_EQ(b.ended, 6u);
  EXPECT_DOUBLE_EQ(b.share_failed, 1.0 / 6);
  EXPECT_EQ(b.pairs_left_out, 1u);  // seed 6; seed 7 is not completed in both
  EXPECT_EQ(find(all[1], "failed").pairs_left_out, 0u);
}

/// A variant that fails on its bad seeds has the smaller mean error and no more successes.
TEST(CampaignStatistics, ALimitCountsFailedRuns) {
  Campaign campaign{"small", "1", {1, 2, 3, 4, 5, 6}, {}, 0};
  campaign.variants.push_back(
      {"keeps", {}, {run(1, 1), run(2, 1), run(3, 1), run(4, 5), run(5, 5), run(6, 5)}});
  campaign.variants.push_back(
      {"loses", {}, {run(1, 1), run(2, 1), run(3, 1), failure(4, 1), failure(5, 1), failure(6, 1)}});
  const auto all = statistics_of(campaign, limit_measures({"failed", "error_m.below:2", "error_m.above:2"}));
  EXPECT_LT(find(all[1], "error_m").mean.value, find(all[0], "error_m").mean.value);
  const MeasureStatistics &keeps = find(all[0], "error_m.below:2"), &loses = find(all[1], "error_m.below:2");
  EXPECT_EQ(loses.n, 6u);
  EXPECT_DOUBLE_EQ(keeps.mean.value, 0.5);
  EXPECT_DOUBLE_EQ(loses.mean.value, 0.5);
  EXPECT_NEAR(loses.mean.low, 0.1876, 1e-4);  // Wilson's interval for 3 of 6
  EXPECT_EQ(loses.versus_baseline.pairs, 6u);
  EXPECT_EQ(loses.pairs_left_out, 0u);
  EXPECT_EQ(loses.versus_baseline.difference.value, 0);
  EXPECT_DOUBLE_EQ(find(all[1], "error_m.above:2").versus_baseline.difference.value, -0.5);
}

/// An event that does not occur in a run has no time.
TEST(CampaignStatistics, ALimitCountsAMissingEventAsAMiss) {
  const double never = std::nan("");
  Campaign campaign{"small", "1", {1, 2, 3}, {}, 0};
  campaign.variants.push_back({"often", {}, {run(1, 1), run(2, 1), run(3, never)}});
  campaign.variants.push_back({"seldom", {}, {run(1, 1), run(2, never), run(3, never)}});
  const auto all = statistics_of(campaign, limit_measures({"error_m.below:2", "nothing.below:2"}));
  EXPECT_DOUBLE_EQ(find(all[0], "error_m.below:2").mean.value, 2.0 / 3);
  EXPECT_DOUBLE_EQ(find(all[1], "error_m.below:2").mean.value, 1.0 / 3);
  EXPECT_EQ(find(all[1], "error_m.below:2").n, 3u);
  EXPECT_EQ(find(all[1], "nothing.below:2").n, 0u);
}

TEST(CampaignStatistics, ALimitIsANumber) {
  EXPECT_FALSE(limit_measure("vehicles.1.ate_m"));
  EXPECT_EQ(limit_measure("vehicles.1.ate_m.below:1e-2")->base, "vehicles.1.ate_m");
  for (const char* wrong :
       {"ate_m.below:", "ate_m.below:low", "ate_m.above:nan", ".below:1", "failed.below:0.5"})
    EXPECT_THROW(limit_measure(wrong), InputError) << wrong;
}

TEST(CampaignTables, StateTheShareOfFailuresBesideEveryMean) {
  const Campaign campaign = two_variants();
  const auto all = statistics_of(campaign, limit_measures({"error_m.below:2.5"}));
  const std::vector<std::string> requested{"error_m", "error_m.below:2.5"};
  const std::string text = table_text(campaign, all, requested);
  EXPECT_HAS(text, "     5 of 6    17 %  3.6 (");
  EXPECT_HAS(text, "5 of 6    20 %    80 %");
  const std::string table = table_csv(campaign, all, requested);
  EXPECT_HAS(table, "variant,measure,n,ended,share_failed,mean,");
  EXPECT_HAS(table, "a=2,error_m,5,6,0.166");
  EXPECT_HAS(table, "a=2,error_m.below:2.5,6,6,0.166");
  const std::string json = campaign_json(campaign, all, requested);
  EXPECT_HAS(json, "\"ended\": 6");
  EXPECT_HAS(json, "\"pairs_left_out\": 1");
}

TEST(CampaignTables, QuoteNamesAndContainNoInfinity) {
  const Campaign campaign = two_variants();
  const std::string runs = runs_csv(campaign);
  EXPECT_HAS(runs, "variant,seed,status,reason,error_m\n");
  EXPECT_HAS(runs, "a=1,7,failed,\"lost, \"\"far\"\" away\",9\n");
  EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 1 + 13);
  EXPECT_HAS(timings_csv(campaign), "a=2,5,0.5,2\n");
  Campaign one = campaign;
  one.seeds = {1};
  for (CampaignVariant& variant : one.variants) variant.runs.resize(1);
  const std::string table = table_csv(one, statistics_of(one), {"failed", "error_m"});
  EXPECT_EQ(table.find("inf"), std::string::npos) << table;
  EXPECT_HAS(table, "a=2,error_m,1,1,0,2,nan,nan,2,1,0,1,nan,nan,0,1\n");
  EXPECT_EQ(campaign_json(one, statistics_of(one), {"error_m"}).find("inf"), std::string::npos);
  EXPECT_HAS(table_text(one, statistics_of(one), {"error_m"}), "too few");
}

TEST(CampaignFigure, ShowsMeansWithTheirIntervals) {
  Campaign campaign = two_variants();
  campaign.variants[0].varied = {{"a", "\"none\""}};
  const auto statistics = statistics_of(campaign);
  const Plot plot = campaign_figure(campaign, statistics, {"failed", "error_m", "of_no_run"});
  EXPECT_EQ(plot.title, "small, by a");
  EXPECT_EQ(plot.columns, 2);
  ASSERT_EQ(plot.panels.size(), 2u);
  const Panel& error = plot.panels[1];
  EXPECT_EQ(error.title, "error_m");
  EXPECT_EQ(error.y_names, (std::vector<std::string>{"2", "none"})) << "the first variant is above";
  ASSERT_EQ(error.curves.size(), 2u);
  EXPECT_EQ(error.curves[1].x, (std::vector<double>{3.5, 3.6}));
  EXPECT_EQ(error.curves[1].y, (std::vector<double>{1, 0}));
  const Interval& mean = find(statistics[1], "error_m").mean;
  EXPECT_EQ(error.curves[0].x[3], mean.low);
  EXPECT_EQ(error.curves[0].x[4], mean.high);
}

TEST(CampaignFigure, NamesRowsByWhatDiffers) {
  Campaign campaign = two_variants();
  campaign.variants.push_back(campaign.variants[1]);
  campaign.variants[0].name = "small";
  campaign.variants[0].varied = {};
  campaign.variants[1].varied = {{"decision.strategy", "\"lawn-mower\""}, {"map.max_landmarks", "800"}};
  campaign.variants[2].varied = {{"decision.strategy", "\"random\""}, {"map.max_landmarks", "800"}};
  const auto figure = [&] { return campaign_figure(campaign, statistics_of(campaign), {"error_m"}); };
  EXPECT_EQ(figure().title, "small, by decision.strategy");
  EXPECT_EQ(figure().panels[0].y_names, (std::vector<std::string>{"random", "lawn-mower", "small"}));
  campaign.variants[2].varied = {{"map.max_landmarks", "400"}};
  EXPECT_EQ(figure().title, "small");
  EXPECT_EQ(figure().columns, 1);
  EXPECT_EQ(
      figure().panels[0].y_names,
      (std::vector<std::string>{"max_landmarks=400", "strategy=lawn-mower max_landmarks=800", "small"}));
}

TEST(CampaignFigure, HasNoIntervalForASingleRun) {
  Campaign one = two_variants();
  one.seeds = {1};
  for (CampaignVariant& variant : one.variants) variant.runs.resize(1);
  const Plot plot = campaign_figure(one, statistics_of(one), {"error_m"});
  ASSERT_EQ(plot.panels.size(), 1u);
  EXPECT_TRUE(plot.panels[0].curves[0].x.empty());
  EXPECT_EQ(plot.panels[0].curves[1].x, (std::vector<double>{1, 2}));
}

TEST(CampaignMeasures, AreTheNumbersOfASummary) {
  const RunMeasures run =
      measures_of(R"({"status": "done", "seed": 7, "frames": 3, "entropy": {"total": -1.5},
    "ate_m": null, "vehicles": [{"ate_m": 1}, {"ate_m": 2}], "consistency": {"nis": 1, "nis_band": [0.5, 2], "outlier_share": 0.1}, "timing_ms": {"frame": {"median": 4}},
    "observability": {"ambiguous": false, "directions": [{"name": "rotation about x", "sigma": 0.5}]}})");
  std::vector<std::string> names;
  for (const auto& [name, value] : run.measures) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"frames", "entropy.total", "ate_m", "vehicles.1.ate_m",
                                             "vehicles.2.ate_m", "consistency.outlier_share",
                                             "observability.directions.rotation_about_x.sigma"}));
  EXPECT_TRUE(std::isnan(value_of(run.measures, "ate_m")));
  EXPECT_EQ(value_of(run.measures, "vehicles.2.ate_m"), 2);
  ASSERT_EQ(run.timings.size(), 1u);
  EXPECT_EQ(run.timings[0].first, "timing_ms.frame.median");
  EXPECT_THROW(measures_of("[1"), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
