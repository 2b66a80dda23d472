#include "incognita/record/summary/run_report.hpp"

#include <gtest/gtest.h>

namespace incognita {
namespace {

MeanNormalizedSquare mean(double value) { return {value, {1, 0.5, 2}}; }

RunReport room() {
  RunReport r;
  r.duration_s = 59.9667;
  r.frames = r.tracked_frames = 1800;
  r.degraded_frames = 3;
  r.true_path = true;
  r.body.path_length = 8.4123;
  r.body.ate_m = 0.00248;
  r.body.compared_frames = 1800;
  r.truth_known = true;
  r.body.drift_percent = 0.0412;
  r.landmarks = 36;
  r.anchors = 4;
  r.consistency.verdict = Consistency::consistent;
  r.consistency.nis = mean(0.0919);
  r.consistency.pose = {1797, 2, mean(0.654)};
  r.decisions = 59;
  return r;
}

TEST(RunReport, SummarizesARunInTenLines) {
  EXPECT_EQ(in_words(room(), 4.1, "out/room"),
            "run          done\n"
            "frames       1800 in 60.0 s: 1800 tracked (3 of them degraded), 0 lost\n"
            "path         8.41 m\n"
            "trajectory   ATE 2.5 mm, drift 0.041 % of the path\n"
            "map          36 landmarks, 4 anchors\n"
            "consistency  consistent: NEES 0.65 (0.50 to 2.00), NIS 0.092 (0.50 to 2.00), 2 of 1797 frames "
            "beyond 3 sigma\n"
            "decisions    59\n"
            "speed        439 frames/s\n"
            "results      out/room\n");
}

TEST(RunReport, StatesHowMuchIsMappedAndHowWell) {
  RunReport r = room();
  r.in_room = true;
  r.outcome.mapped = 0.712;
  r.outcome.within_5_cm = 0.96;
  r.outcome.within_3_sigma = 0.99;
  r.map_error_m = 0.0213;
  r.map_error_landmarks = 36;
  EXPECT_NE(in_words(r, 4, "x").find(
                "map          36 landmarks, 4 anchors; map error 2.1 cm rms over 36 landmarks\n"
                "mapped       71 % of the textured surface to 5 cm\n"
                "             96 % of the landmarks within 5 cm of the truth, 99 % within 3 sigma\n"),
            std::string::npos)
      << in_words(r, 4, "x");
  r.in_room = false;
  r.outcome.mapped_60_s = 0.4;
  r.outcome.t_90_mapped_s = 88.24;
  EXPECT_NE(in_words(r, 4, "x").find(
                "mapped       71 % of the unknown points to 5 cm, 40 % after 60 s, 90 % after 88.2 s\n"),
            std::string::npos)
      << in_words(r, 4, "x");
}

TEST(RunReport, StatesEntropiesAndADivergedRun) {
  RunReport r = room();
  r.entropy = -378.94;
  r.outcome.diverged = false;
  const std::string before = in_words(r, 4, "x");
  EXPECT_NE(before.find("entropy      -379 nats\n"), std::string::npos) << before;
  EXPECT_EQ(before.find("diverged"), std::string::npos) << before;
  r.entropy_extended = 1234.5678;
  r.outcome.diverged = true;
  const std::string text = in_words(r, 4, "x");
  EXPECT_NE(text.find("entropy      -379 nats, 1235 with what is not mapped yet\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("drift 0.041 % of the path, diverged\n"), std::string::npos) << text;
}

TEST(RunReport, StatesWhyARunFailed) {
  RunReport r = room();
  r.status = RunStatus::failed;
  r.reason = "lost at the end: 0 of 12 features matched";
  r.lost_frames = 20;
  const std::string text = in_words(r, 4, "x");
  EXPECT_EQ(text.find("run          failed, lost at the end: 0 of 12 features matched\n"), 0u) << text;
  EXPECT_NE(text.find("20 lost"), std::string::npos);
}

TEST(RunReport, OfARunWithoutFramesReportsUnknowns) {
  RunReport r;
  r.status = RunStatus::interrupted;
  r.reason = "stopped at t = 0.000 s";
  EXPECT_EQ(in_words(r, 0, "x"),
            "run          interrupted, stopped at t = 0.000 s\n"
            "frames       0 in 0.0 s: 0 tracked, 0 lost\n"
            "path         unknown\n"
            "trajectory   no error: the truth is unknown\n"
            "map          0 landmarks\n"
            "consistency  unknown\n"
            "decisions    0\n"
            "results      x\n");
}

TEST(RunReport, UsesNoMetersWhereTheScaleIsUnobservable) {
  RunReport r = room();
  r.alignment = AlignmentKind::sim3;
  r.scale_known = r.true_path = false;
  const std::string text = in_words(r, 4, "x");
  EXPECT_NE(text.find("path         8.41 arbitrary units (scale unobservable), estimated\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("ATE 2.5 mm after sim3 alignment"), std::string::npos) << "of the truth, which is in m";
  r.true_path = true;
  EXPECT_NE(in_words(r, 4, "x").find("path         8.41 m\n"), std::string::npos);
}

TEST(RunReport, StatesTheVerdictWithSymptomAndCauses) {
  RunReport r = room();
  r.consistency.verdict = Consistency::overconfident;
  r.consistency.symptom = "measurements do not fit";
  r.consistency.causes = {"sign", "unit"};
  const std::string text = in_words(r, 4, "x");
  EXPECT_NE(text.find("consistency  overconfident: NEES 0.65"), std::string::npos) << text;
  EXPECT_NE(text.find("             measurements do not fit\n"), std::string::npos);
  EXPECT_NE(text.find("             usual causes: sign; unit\n"), std::string::npos);
}

TEST(RunReport, HasALineForEachRobotOfATeam) {
  RunReport r = room();
  r.bodies = {r.body, r.body};
  r.bodies[0].consistency = {1797, 0, mean(1.1)};
  r.bodies[1].consistency = {900, 150, mean(3.4)};
  r.bodies[1].ate_m = 0.152;
  r.bodies[1].compared_frames = 900;
  const std::string text = in_words(r, 4, "x");
  EXPECT_NE(
      text.find("  robot 1    path 8.41 m, ATE 2.5 mm, drift 0.041 % of the path, NEES 1.10 (0.50 to 2.00), "
                "0 of 1797 frames beyond 3 sigma\n"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("  robot 2    path 8.41 m, ATE 15.2 cm"), std::string::npos);
  EXPECT_NE(text.find("NEES 3.40 (0.50 to 2.00), overconfident, 150 of 900 frames"), std::string::npos);
}

TEST(RunReport, ComparesTheMapWithTheSurvey) {
  RunReport r = room();
  r.surveyed = 15;
  EXPECT_NE(in_words(r, 4, "x").find("none matches one of the 15 surveyed"), std::string::npos);
  r.map_error_m = 0.0187;
  r.map_error_landmarks = 14;
  EXPECT_NE(in_words(r, 4, "x").find("map error 1.9 cm rms over 14 of 15 surveyed landmarks"),
            std::string::npos)
      << in_words(r, 4, "x");
}

TEST(LengthInWords, ChoosesAReadableUnit) {
  EXPECT_EQ(length_in_words(0.00248), "2.5 mm");
  EXPECT_EQ(length_in_words(0.0248), "2.5 cm");
  EXPECT_EQ(length_in_words(2.4816), "2.48 m");
  EXPECT_EQ(length_in_words(24.816), "24.8 m");
  EXPECT_EQ(length_in_words(4100.4), "4100 m");
}

}  // namespace
}  // namespace incognita
