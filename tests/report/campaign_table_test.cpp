// Campaigns whose numbers can be worked out by hand.
#include "incognita/report/campaign_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

TEST(CampaignStatistics, AreOfTheRunsThatAreDone) {
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
  // 2.776445 is Student's t of 4 degrees of freedom at 97.5 %; squared distances from the mean are 17.2
  EXPECT_NEAR(error.mean.high - 3.6, 2.776445 * std::sqrt(17.2 / 4 / 5), 1e-6);
}

TEST(CampaignStatistics, PairSeedsThatBothHaveDone) {
  const auto all = statistics_of(two_variants());
  const PairedComparison& c = find(all[1], "error_m").versus_baseline;  // 1 -1 1 1 1
  EXPECT_EQ(c.pairs, 5u);
  EXPECT_DOUBLE_EQ(c.difference.value, 0.6);
  EXPECT_DOUBLE_EQ(c.share_lower, 0.2);
  EXPECT_DOUBLE_EQ(c.share_higher, 0.8);
  EXPECT_DOUBLE_EQ(c.difference.high, 1);
  EXPECT_DOUBLE_EQ(c.difference.low,
                   -0.2);  // three of five draws are the -1: 5.8 % have it or more, 0.7 % four
}

TEST(CampaignStatistics, CountFailuresAsAMeasure) {
  const auto all = statistics_of(two_variants());
  const MeasureStatistics& failed = find(all[1], "failed");
  EXPECT_EQ(failed.n, 6u);
  EXPECT_DOUBLE_EQ(failed.mean.value, 1.0 / 6);
  EXPECT_EQ(failed.versus_baseline.pairs, 6u);  // seed 7 has not ended in both
  EXPECT_DOUBLE_EQ(failed.versus_baseline.difference.value, 1.0 / 6);
}

TEST(CampaignTables, QuoteAndNeverSayInfinite) {
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
  EXPECT_HAS(table, "a=2,error_m,1,2,nan,nan,2,1,1,nan,nan,0,1\n");
  EXPECT_EQ(campaign_json(one, statistics_of(one), {"error_m"}).find("inf"), std::string::npos);
  EXPECT_HAS(table_text(one, statistics_of(one), {"error_m"}), "too few");
}

TEST(CampaignMeasures, AreTheNumbersOfASummary) {
  const RunMeasures run =
      measures_of(R"({"status": "done", "seed": 7, "frames": 3, "entropy": {"total": -1.5},
    "ate_m": null, "vehicles": [{"ate_m": 1}, {"ate_m": 2}], "timing_ms": {"frame": {"median": 4}},
    "observability": {"ambiguous": false, "directions": [{"name": "turn about x", "sigma": 0.5}]}})");
  std::vector<std::string> names;
  for (const auto& [name, value] : run.measures) names.push_back(name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"frames", "entropy.total", "ate_m", "vehicles.1.ate_m",
                                      "vehicles.2.ate_m", "observability.directions.turn_about_x.sigma"}));
  EXPECT_TRUE(std::isnan(value_of(run.measures, "ate_m")));
  EXPECT_EQ(value_of(run.measures, "vehicles.2.ate_m"), 2);
  ASSERT_EQ(run.timings.size(), 1u);
  EXPECT_EQ(run.timings[0].first, "timing_ms.frame.median");
  EXPECT_THROW(measures_of("[1"), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
