// The command `incognita campaign`: its runs, tables, measures and refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/app/campaign_folder.hpp"

namespace incognita {
namespace {

using namespace testing;

TEST(ProgramCampaign, HelpHasAnExample) {
  const Scratch scratch;
  const Ended help = testing::incognita({"campaign", "--help"}, scratch.folder());
  EXPECT_EQ(help.code, 0);
  EXPECT_SAYS(help.out, "incognita campaign room --seeds");
}

TEST(ProgramCampaign, MakesTheSameRunsAsTheCommandRun) {
  const CampaignFolder campaigns;
  const Ended ended = campaigns.campaign({"--seeds", "3..5", "--vary", vary});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.out, "ate_m");
  EXPECT_SAYS(ended.out, "plant.sigma_speed_m_s=0.2");
  const Json answer = Json::parse(campaigns.read("campaign.json"));
  EXPECT_EQ(answer["seeds"], Json({3, 4, 5}));
  ASSERT_EQ(answer["variants"].size(), 2u);
  double mean = 0;
  for (const char* seed : {"3", "4", "5"}) {
    const Ended alone = testing::incognita({"run", "small.toml", "--seed", seed, "--set",
                                            "plant.sigma_speed_m_s=0.2", "--no-figures", "--out", "alone"},
                                           campaigns.folder());
    ASSERT_EQ(alone.code, 0) << alone.err;
    mean += testing::summary_of(campaigns / "alone")["ate_m"].get<double>() / 3;
  }
  const Json& ate = answer["variants"][1]["measures"]["ate_m"];
  EXPECT_EQ(ate["n"], 3);
  EXPECT_NEAR(ate["mean"].get<double>(), mean, 1e-12);
  EXPECT_EQ(ate["versus_baseline"]["pairs"], 3);
  EXPECT_EQ(testing::lines(campaigns / "c/runs.csv").size(), 1u + 6u);
  EXPECT_EQ(campaigns.results().size(), 6u);
}

TEST(ProgramCampaign, AnswerConformsToItsSchema) {
  const CampaignFolder campaigns;
  const Ended ended = campaigns.campaign({"--seeds", "1..6", "--vary", vary, "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, campaigns.read("campaign.json"));
  EXPECT_EQ(testing::problems(Json::parse(ended.out), schema()), "");
  const Ended again = campaigns.campaign({"--seeds", "1..6", "--vary", vary, "--json", "--measure", "ate_m"});
  const Json answer = Json::parse(again.out);
  EXPECT_EQ(testing::problems(answer, schema()), "");
  for (const Json& variant : answer["variants"]) EXPECT_EQ(variant["measures"].size(), 1u);
}

TEST(ProgramCampaign, MeasuresHowMuchIsMapped) {
  const CampaignFolder campaigns;
  const Ended ended = campaigns.campaign({"--seeds", "1..2", "--duration", "61", "--json", "--measure",
                                          "exploration.mapped_60_s", "--measure", "exploration.diverged"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json measures = Json::parse(ended.out)["variants"][0]["measures"];
  EXPECT_EQ(measures["exploration.mapped_60_s"]["n"], 2);
  EXPECT_GT(measures["exploration.mapped_60_s"]["mean"], 0);
  EXPECT_EQ(measures["exploration.diverged"]["n"], 2);
  const Ended table = campaigns.campaign({"--seeds", "1..2", "--duration", "61", "--table"});
  ASSERT_EQ(table.code, 0) << table.err;
  for (const char* shown :
       {"entropy.total ", "exploration.mapped_60_s ", "exploration.mapped ", "map_error_m ",
        "exploration.within_5_cm ", "exploration.within_3_sigma ", "exploration.diverged "})
    EXPECT_SAYS(table.out, std::string("\n") + shown);
}

TEST(ProgramCampaign, TableDoesNotDependOnTheDistributionOfRuns) {
  const CampaignFolder campaigns;
  const Words what = {"--seeds", "1..7", "--vary", vary, "--vary", "points.count=8,16"};
  const auto with = [&](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  ASSERT_EQ(campaigns.campaign(with(what, {"--jobs", "1"}), "one").code, 0);
  ASSERT_EQ(campaigns.campaign(with(what, {"--jobs", "5"}), "five").code, 0);
  for (const char* shard : {"3/3", "1/3", "2/3"}) {
    const Ended ended = campaigns.campaign(with(what, {"--shard", shard}), "shards");
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out, "");
  }
  const Ended early = campaigns.campaign(with(what, {"--table"}), "shards");
  EXPECT_EQ(early.code, 0) << early.err;
  expect_same_tables(campaigns, "one", "five");
  expect_same_tables(campaigns, "one", "shards");
  EXPECT_EQ(campaigns.results("one").size(), 28u);
}

TEST(ProgramCampaign, ReportsRunsMissingFromAnEarlyTable) {
  const CampaignFolder campaigns;
  const Words what = {"--seeds", "1..4", "--vary", vary};
  ASSERT_EQ(campaigns.campaign({"--seeds", "1..4", "--vary", vary, "--shard", "1/2"}).code, 0);
  const Ended table = campaigns.campaign({"--seeds", "1..4", "--vary", vary, "--table", "--json"});
  EXPECT_EQ(table.code, 1);
  EXPECT_SAYS(table.err, "4 of 8 runs are missing");
  EXPECT_EQ(Json::parse(table.out)["variants"][1]["missing"], 4);
  EXPECT_EQ(campaigns.campaign(what).code, 0);
}

TEST(ProgramCampaign, CountsFailedRuns) {
  const CampaignFolder campaigns;
  const Words what = {"--seeds", "1..5", "--vary", "health.max_sigma_position_m=10,0.011"};
  const Ended ended = campaigns.campaign(what);
  EXPECT_EQ(ended.code, 0) << ended.err;
  const Json answer = Json::parse(campaigns.read("campaign.json"));
  const Json& lost = answer["variants"][1];
  EXPECT_EQ(answer["variants"][0]["failed"], 0);
  EXPECT_EQ(lost["failed"], 5);
  EXPECT_EQ(lost["done"], 0);
  ASSERT_EQ(lost["failures"].size(), 5u);
  EXPECT_SAYS(lost["failures"][0]["reason"].get<std::string>(), "lost");
  EXPECT_EQ(lost["measures"]["failed"]["mean"], 1);
  EXPECT_EQ(lost["measures"]["failed"]["versus_baseline"]["difference"], 1);
  EXPECT_EQ(lost["measures"]["ate_m"]["n"], 0);
  EXPECT_EQ(lost["measures"]["ate_m"]["mean"], nullptr);
  EXPECT_EQ(lost["measures"]["ate_m"]["ended"], 5);
  EXPECT_EQ(lost["measures"]["ate_m"]["share_failed"], 1);
  EXPECT_EQ(lost["measures"]["ate_m"]["versus_baseline"]["pairs"], 0);
  EXPECT_EQ(lost["measures"]["ate_m"]["versus_baseline"]["pairs_left_out"], 5);
  EXPECT_SAYS(ended.out, "failed, and excluded above");
  EXPECT_SAYS(ended.out, "0 of 5   100 %");
  EXPECT_SAYS(ended.out, "--measure ate_m.below:0.1");
  EXPECT_SAYS(ended.err, "seed 3: failed: ");
  EXPECT_EQ(testing::lines(campaigns / "c/runs.csv").size(), 1u + 10u);
  EXPECT_EQ(testing::problems(answer, schema()), "");
  const Ended again = campaigns.campaign(what);
  EXPECT_SAYS(again.err, "10 made before, 0 to make");
  Words limited = what;
  limited.insert(limited.end(), {"--measure", "ate_m.below:1000", "--json"});
  const Json within = Json::parse(campaigns.campaign(limited).out);
  EXPECT_EQ(testing::problems(within, schema()), "");
  EXPECT_EQ(within["variants"][0]["measures"]["ate_m.below:1000"]["mean"], 1);
  EXPECT_EQ(within["variants"][1]["measures"]["ate_m.below:1000"]["mean"], 0);
  EXPECT_EQ(within["variants"][1]["measures"]["ate_m.below:1000"]["versus_baseline"]["difference"], -1);
}

TEST(ProgramCampaign, RefusesAnInvalidLimitBeforeAnyRun) {
  const CampaignFolder campaigns;
  const Ended ended = campaigns.campaign({"--seeds", "1..3", "--measure", "ate_m.below:low"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_SAYS(ended.err, "--measure ate_m.below:low: a limit is a number");
  EXPECT_TRUE(campaigns.results().empty());
  const Ended unknown = campaigns.campaign({"--seeds", "1..3", "--jobs", "1", "--measure", "ate.below:1"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_SAYS(unknown.err, "--measure ate: no run has this measure; the nearest is ate_m");
}

TEST(ProgramCampaign, KeepsRunDirectoriesOnRequest) {
  const CampaignFolder campaigns;
  ASSERT_EQ(campaigns.campaign({"--seeds", "1..2", "--keep-runs"}).code, 0);
  ASSERT_EQ(campaigns.campaign({"--seeds", "1..2"}, "bare").code, 0);
  expect_same_tables(campaigns, "bare", "c");
  int runs = 0;
  for (const fs::path& file : campaigns.results()) {
    fs::path run = file;
    run.replace_extension();
    testing::expect_whole_tables(run);
    EXPECT_EQ(testing::summary_of(run)["status"], "done");
    EXPECT_TRUE(fs::exists(run / "run.mcap"));
    ++runs;
  }
  EXPECT_EQ(runs, 2);
  EXPECT_SAYS(campaigns.campaign({"--seeds", "1..2", "--keep-runs"}, "bare").err,
              "2 runs were made before without it");
  EXPECT_SILENT_ON(*testing::everything_in(campaigns / "bare").rbegin(), "run.mcap");
}

TEST(ProgramCampaign, ValuesMayBeLists) {
  const CampaignFolder campaigns;
  const Ended ended = campaigns.campaign({"--seeds", "1", "--vary", "points.size_m=[20, 20, 0],[30,30,0]",
                                          "--baseline", "points.size_m=[30.0, 30.0, 0.0]"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json answer = Json::parse(campaigns.read("campaign.json"));
  ASSERT_EQ(answer["variants"].size(), 2u);
  EXPECT_EQ(answer["variants"][0]["varied"]["points.size_m"], "[20.0, 20.0, 0.0]");
  EXPECT_EQ(answer["baseline"], "points.size_m=[30.0, 30.0, 0.0]");
  EXPECT_TRUE(answer["variants"][0]["measures"]["ate_m"].contains("versus_baseline"));
  EXPECT_FALSE(answer["variants"][1]["measures"]["ate_m"].contains("versus_baseline"));
}

TEST(ProgramCampaign, ComparesVariantsOfSeveralSettingsWithTheScenarioAsItIs) {
  const CampaignFolder campaigns;
  const Ended ended =
      campaigns.campaign({"--seeds", "2", "--json", "--variant", "points.count=8  points.size_m=[20, 20, 0]",
                          "--variant", "plant.sigma_speed_m_s=0.2", "--measure", "ate_m"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json answer = Json::parse(ended.out);
  ASSERT_EQ(answer["variants"].size(), 3u);
  EXPECT_EQ(answer["baseline"], "small");
  EXPECT_EQ(answer["variants"][0]["name"], "small");
  EXPECT_EQ(answer["variants"][1]["name"], "points.count=8 points.size_m=[20.0, 20.0, 0.0]");
  EXPECT_EQ(answer["variants"][1]["varied"]["points.count"], "8");
  EXPECT_EQ(answer["variants"][2]["name"], "plant.sigma_speed_m_s=0.2");
  EXPECT_EQ(answer["variants"][0]["varied"].size(), 0u);
  EXPECT_EQ(answer["variants"][2]["varied"].size(), 1u);
  const Ended alone =
      testing::incognita({"run", "small.toml", "--seed", "2", "--set", "points.count=8", "--set",
                          "points.size_m=[20, 20, 0]", "--no-figures", "--out", "alone"},
                         campaigns.folder());
  ASSERT_EQ(alone.code, 0) << alone.err;
  EXPECT_EQ(answer["variants"][1]["measures"]["ate_m"]["mean"],
            testing::summary_of(campaigns / "alone")["ate_m"]);
  const Ended more = campaigns.campaign(
      {"--seeds", "2", "--variant", "plant.sigma_speed_m_s=0.2", "--variant", "plant.sigma_speed_m_s=0.3"});
  EXPECT_EQ(more.code, 0) << more.err;
  EXPECT_SAYS(more.err, "2 made before, 1 to make");
}

TEST(ProgramCampaign, RefusesInvalidArgumentsBeforeAnyRun) {
  const CampaignFolder campaigns;
  campaigns.write("in-the-way", "a file\n");
  const std::size_t before = testing::everything_in(campaigns.folder()).size();
  const std::pair<Words, std::string> wrong[] = {
      {{"--vary", "plant.sigma_sped_m_s=1"},
       "there is no setting `plant.sigma_sped_m_s`; the nearest is "
       "`plant.sigma_speed_m_s`"},
      {{"--vary", "plant.sigma_speed_m_s=-1,1"}, "--vary: plant.sigma_speed_m_s = -1"},
      {{"--vary", "plant.sigma_speed_m_s"}, "must be written section.name=value,value"},
      {{"--vary", "plant.sigma_speed_m_s="}, "a value is missing"},
      {{"--vary", "plant.sigma_speed_m_s=1,,2"}, "a value is missing"},
      {{"--vary", "points.size_m=[1,2"}, "do not close"},
      {{"--vary", "plant.sigma_speed_m_s=0.1,0.10"}, "occurs twice"},
      {{"--vary", "points.count=8", "--vary", "points.count=9"}, "given twice"},
      {{"--vary", "points.count=8", "--set", "points.count=9"}, "set the same"},
      {{"--vary", "run.duration_s=1,2", "--duration", "3"}, "set the same"},
      {{"--vary", "run.seed=1,2"}, "--seeds"},
      {{"--variant", "points.count=8", "--vary", "points.count=9"}, "has one of them"},
      {{"--variant", "points.count=8 points.count=9"}, "sets points.count twice"},
      {{"--variant", "points.count=8", "--variant", "points.count=8"}, "occurs twice"},
      {{"--variant", "points.count=8", "--set", "points.count=9"}, "--variant points.count set the same"},
      {{"--variant", "points.count"}, "it is written 'section.name=value section.name=value'"},
      {{"--variant", "points.size_m=[1,2"}, "do not close"},
      {{"--variant", "points.count=8 plant.sigma_speed_m_s=0.2", "--variant",
        "plant.sigma_speed_m_s=0.2 points.count=8"},
       "occurs twice"},
      {{"--variant", "points.count=8", "--baseline", "points.count=8"}, "remove --baseline"},
      {{"--variant", "start.positions_m=[[0, 0, 0]] go_left"}, "`go_left` is not a key and its value"},
      {{"--variant", "points.count="}, "`points.count=` is not a key and its value"},
      {{"--variant", " "}, "has no settings"},
      {{"--variant", "run.seed=3"}, "--seeds"},
      {{"--set", "run.seed=1"}, "--seeds"},
      {{"--vary", "decision.strategy=none,mutual-information"}, "belongs to `controller.law = \"active\"`"},
      {{"--seeds", "5..1"}, "is decreasing"},
      {{"--seeds", "1..3,2"}, "2 occurs twice"},
      {{"--seeds", ""}, "is not a seed"},
      {{"--seeds", "-1"}, "is not a seed"},
      {{"--seeds", "1..x"}, "`x` is not a seed"},
      {{"--seeds", "1..99999999999"}, "more than 1000000 runs"},
      {{"--seeds", "0..9223372036854775807"}, "more than 1000000 runs"},
      {{"--jobs", "0"}, "--jobs 0: must be a whole number from 1"},
      {{"--shard", "0/2"}, "must be written i/N"},
      {{"--shard", "3/2"}, "must be written i/N"},
      {{"--shard", "1"}, "must be written i/N"},
      {{"--table"}, "contains no campaign"},
      {{"--baseline", "points.count=8"}, "is not varied"},
      {{"--vary", "points.count=8,9", "--baseline", "points.count=7"}, "not one of the values"},
      {{"--out", ""}, "--out: is empty"},
      {{"--out", "in-the-way"}, "a file with this name exists"},
      {{"--out", "/proc/incognita"}, "--out /proc/incognita: cannot write"},
      {{"--sheds", "1"}, "the nearest is `--seeds`"}};
  for (const auto& [words, message] : wrong) {
    Words all = {"campaign", "small.toml"};
    all.insert(all.end(), words.begin(), words.end());
    const Ended ended = testing::incognita(all, campaigns.folder());
    EXPECT_EQ(ended.code, 2) << message << ended.err;
    EXPECT_SAYS(ended.err, message);
    EXPECT_EQ(ended.out, "");
  }
  EXPECT_EQ(testing::everything_in(campaigns.folder()).size(), before);
}

TEST(ProgramCampaign, LeavesNothingIfNoRunCanStart) {
  const CampaignFolder campaigns;
  campaigns.write(
      "recorded.toml",
      "[world]\ntype = \"recording\"\n[recording]\nfolder = \"nowhere\"\n[start]\nfrom = \"free\"\n");
  const std::size_t before = testing::everything_in(campaigns.folder()).size();
  const Ended ended = testing::incognita({"campaign", "recorded.toml", "--seeds", "1..3", "--out", "a/b"},
                                         campaigns.folder());
  EXPECT_EQ(ended.code, 2) << ended.err;
  EXPECT_SAYS(ended.err, "nowhere");
  EXPECT_EQ(testing::everything_in(campaigns.folder()).size(), before);
}

TEST(ProgramCampaign, WarnsIfSeedsHaveNoEffect) {
  const CampaignFolder campaigns;
  Words still = {"--seeds", "1..2", "--set", "points.file=points.csv"};
  for (const char* noise : {"plant.sigma_speed_m_s", "plant.sigma_turn_rate_rad_s", "plant.sigma_range_m",
                            "plant.sigma_bearing_rad", "start.sigma_position_m", "start.sigma_heading_rad"})
    still.insert(still.end(), {"--set", std::string(noise) + "=0"});
  campaigns.write("points.csv", "id,x,y\n1,5,1\n2,6,-3\n");
  const Ended ended = campaigns.campaign(still);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.err, "small: every seed gave the same result");
  EXPECT_SILENT_ON(campaigns.campaign({"--seeds", "1..2"}, "noisy").err, "every seed gave the same result");
}

TEST(ProgramCampaign, RefusesAnUnknownMeasureAfterTheFirstRun) {
  const CampaignFolder campaigns;
  const Ended ended = campaigns.campaign({"--seeds", "1..200", "--jobs", "1", "--measure", "ate"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_SAYS(ended.err, "--measure ate: no run has this measure; the nearest is ate_m. Completed runs");
  EXPECT_EQ(ended.out, "");
  ASSERT_EQ(campaigns.results().size(), 1u);
  const fs::path kept = campaigns.results()[0];
  const std::string made = contents(kept);
  const Ended again = campaigns.campaign({"--seeds", "1..200", "--measure", "entropy.totl"});
  EXPECT_EQ(again.code, 2) << "from the results in the folder, before any run";
  EXPECT_SAYS(again.err, "the nearest is entropy.total");
  EXPECT_EQ(campaigns.results().size(), 1u);
  const Ended right = campaigns.campaign({"--seeds", "1..3", "--measure", "ate_m", "--measure", "failed"});
  EXPECT_EQ(right.code, 0) << right.err;
  EXPECT_SAYS(right.err, "1 made before, 2 to make");
  EXPECT_EQ(contents(kept), made);
}

TEST(ProgramCampaign, AcceptsAMeasureOfTheLastVariantOnly) {
  const CampaignFolder campaigns;
  const Words what = {"--seeds", "1..3",   "--jobs",
                      "1",       "--vary", "start.positions_m=[[0, 0, 0]],[[0, 0, 0], [2, 0, 0]]"};
  Words right = what, wrong = what;
  right.insert(right.end(), {"--measure", "vehicles.2.ate_m"});
  wrong.insert(wrong.end(), {"--measure", "vehicles.3.ate_m"});
  const Ended refused = campaigns.campaign(wrong, "wrong");
  EXPECT_EQ(refused.code, 2);
  EXPECT_SAYS(refused.err, "the nearest is vehicles.");
  EXPECT_EQ(campaigns.results("wrong").size(), 2u) << "one of each variant";
  const Ended ended = campaigns.campaign(right);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(campaigns.results().size(), 6u);
}

TEST(ProgramCampaign, AFailedRunDoesNotDetermineTheMeasures) {
  const CampaignFolder campaigns;
  // every run of this campaign is lost
  const Ended ended = campaigns.campaign(
      {"--seeds", "1..5", "--jobs", "1", "--measure", "ate", "--set", "health.max_sigma_position_m=0.011"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_SAYS(ended.err, "--measure ate: ");
  EXPECT_EQ(campaigns.results().size(), 5u) << "only after the last run";
}

}  // namespace
}  // namespace incognita
