#include "incognita/record/summary/consistency_summary.hpp"

#include <gtest/gtest.h>

#include "synthetic_run.hpp"

namespace incognita {
namespace {

using testing::SyntheticRun;

ConsistencyReport report_of(const SyntheticRun& run, double nis_factor = 1, bool compare = true) {
  ConsistencySummary summary(compare);
  for (int i = 0; i < run.frames; ++i) {
    Snapshot snapshot = testing::synthetic_snapshot(run, i);
    snapshot.nis *= nis_factor;
    summary.add(snapshot);
  }
  return summary.report();
}

SyntheticRun off_by(double factor) {
  SyntheticRun run;
  run.error_factor = factor;
  return run;
}

TEST(ConsistencySummary, UsesNeesWhereTheTruthIsKnown) {
  const ConsistencyReport right = report_of(off_by(1));
  EXPECT_EQ(right.verdict, Consistency::consistent);
  EXPECT_TRUE(right.symptom.empty() && right.causes.empty());
  EXPECT_NEAR(right.pose.nees->mean, 1, 0.2);
  EXPECT_EQ(right.pose.frames_with_truth, 117) << "120 minus those before the start";
  const ConsistencyReport over = report_of(off_by(3));
  EXPECT_EQ(over.verdict, Consistency::overconfident);
  EXPECT_GT(over.pose.overconfident_frames, 30);
  EXPECT_NE(over.symptom.find("pose errors are larger"), std::string::npos);
  EXPECT_EQ(report_of(off_by(0.3)).verdict, Consistency::conservative);
}

TEST(ConsistencySummary, UsesInnovationsWithoutTruth) {
  SyntheticRun blind;
  blind.with_truth = false;
  EXPECT_EQ(report_of(blind).verdict, Consistency::consistent);
  EXPECT_EQ(report_of(blind, 4).verdict, Consistency::overconfident);
  EXPECT_EQ(report_of(blind, 0.2).verdict, Consistency::conservative);
  EXPECT_FALSE(report_of(blind).pose.nees);
  EXPECT_EQ(report_of(off_by(5), 1, false).verdict, Consistency::consistent)
      << "the truth is in another frame";
}

TEST(ConsistencySummary, SmallInnovationsAloneAreConsistentWhereTheTruthIsKnown) {
  EXPECT_EQ(report_of(off_by(1), 0.1).verdict, Consistency::consistent);
  EXPECT_EQ(report_of(off_by(1), 4).verdict, Consistency::overconfident);
}

TEST(ConsistencySummary, SuggestsSignUnitAndClockFirstWhereNisIsLargeFromTheStart) {
  const ConsistencyReport report = report_of(off_by(1), 4);
  EXPECT_NE(report.symptom.find("from the start"), std::string::npos);
  ASSERT_GE(report.causes.size(), 4u);
  EXPECT_NE(report.causes[0].find("sign"), std::string::npos);
  EXPECT_NE(report.causes[1].find("unit"), std::string::npos);
  EXPECT_NE(report.causes[2].find("clock"), std::string::npos);
  EXPECT_NE(report.causes[3].find("noise"), std::string::npos);
  ConsistencySummary late(true);
  for (int i = 0; i < 120; ++i) {
    Snapshot snapshot = testing::synthetic_snapshot({}, i);
    if (i > 60) snapshot.nis *= 8;
    late.add(snapshot);
  }
  EXPECT_EQ(late.report().verdict, Consistency::overconfident);
  EXPECT_EQ(late.report().symptom.find("from the start"), std::string::npos);
}

// A gate that rejects inconsistent measurements hides them from NIS
TEST(ConsistencySummary, CountsMeasurementsOutsideTheirGates) {
  EXPECT_NEAR(*report_of({}).outlier_share, 1.0 / 6, 1e-9)
      << "of 8 measurements, 5 matched and 1 inconsistent";
  ConsistencySummary summary(true);
  for (int i = 0; i < 120; ++i) {
    Snapshot snapshot = testing::synthetic_snapshot({}, i);
    snapshot.nis_dof = 0;
    for (SnapshotMatch& match : snapshot.matches)
      if (match.outcome == MatchOutcome::matched) match.outcome = MatchOutcome::outlier;
    summary.add(snapshot);
  }
  EXPECT_EQ(summary.report().verdict, Consistency::overconfident);
  EXPECT_NE(summary.report().symptom.find("100 % of the measurements are outside their gates"),
            std::string::npos)
      << summary.report().symptom;
  EXPECT_NE(summary.report().causes.at(0).find("sign"), std::string::npos);
}

TEST(ConsistencySummary, HasNoVerdictOnAFewFrames) {
  SyntheticRun run;
  run.frames = 8;
  const ConsistencyReport report = report_of(run);
  EXPECT_EQ(report.verdict, Consistency::unknown);
  EXPECT_EQ(report.symptom, "fewer than 10 updates");
  EXPECT_FALSE(report.nis);
}

/// Two planar robots, with errors in x in sigmas.
Snapshot team_at(int frame, double first_off, double second_off, bool second_has_truth) {
  Snapshot s;
  s.tick = {frame, 0.1 * frame, 0.1};
  s.status.state = TrackingState::tracking;
  for (const double off : {first_off, second_off}) {
    SnapshotBody v;
    v.state = TrackingState::tracking;
    v.estimate.position.x() = 0.1 * off;
    v.covariance.diagonal() << 0.01, 0.01, 0, 0, 0, 0.01;
    if (s.bodies.empty() || second_has_truth) v.truth = StampedPose{};
    s.bodies.push_back(v);
  }
  return s;
}

TEST(ConsistencySummary, OfATeamCountsFramesPerRobot) {
  ConsistencySummary summary(true);
  for (int i = 0; i < 100; ++i) summary.add(team_at(i, 5, i < 30 ? 5 : 0, i < 60));
  const ConsistencyReport report = summary.report();
  EXPECT_EQ(report.pose.frames_with_truth, 100);
  EXPECT_EQ(report.pose.overconfident_frames, 100);
  ASSERT_EQ(report.bodies.size(), 2u);
  EXPECT_EQ(report.bodies[0].frames_with_truth, 100);
  EXPECT_EQ(report.bodies[0].overconfident_frames, 100);
  EXPECT_EQ(report.bodies[1].frames_with_truth, 60);
  EXPECT_EQ(report.bodies[1].overconfident_frames, 30);
  EXPECT_NEAR(report.bodies[0].nees->mean, 25.0 / 3, 1e-9);
  EXPECT_EQ(report.bodies[0].verdict(), Consistency::overconfident);
  // 100 samples of the first robot, 30 equal ones of the second, 30 of 0
  EXPECT_NEAR(summary.mean_nees(), 25.0 / 3 * 130 / 160, 1e-9);
}

TEST(ConsistencySummary, OneOverconfidentRobotMakesItsTeamOverconfident) {
  ConsistencySummary summary(true);
  for (int i = 0; i < 100; ++i) {
    Snapshot s = team_at(i, 4, 1.7, true);
    for (int k = 0; k < 6; ++k) s.bodies.push_back(s.bodies.back());
    summary.add(s);
  }
  EXPECT_EQ(summary.report().pose.verdict(), Consistency::consistent);
  EXPECT_EQ(summary.report().verdict, Consistency::overconfident);
}

}  // namespace
}  // namespace incognita
