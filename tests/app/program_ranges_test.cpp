// The program on range-bearing recordings: complete runs, and invalid recordings and scenarios.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "incognita/io/recordings/range_recording.hpp"
#include "incognita/world/points/planar_loop.hpp"
#include "tests/app/program.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Ended;
using testing::Scratch;
using testing::Words;

constexpr const char* scenario = R"([world]
type = "recording"

[sensor]
type = "range-bearing"
sigma_range_m = 0.1
sigma_bearing_rad = 0.1

[recording]
folder = "FOLDER"

[vehicle]
model = "differential-drive"
sensor_forward_m = 0
sensor_left_m = 0
sigma_speed_m_s = 0.1
sigma_turn_rate_rad_s = 0.1

[association]
method = "known"
gate_probability = 0.999999
)";

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

RangeRecording minute_of_driving() {
  PlanarLoopSettings settings;
  settings.duration_s = 60;
  return drive_planar_loop(settings, 5);
}

/// A minute of the simulated loop as tables in `drive`, and a scenario `s.toml` that uses them.
class ProgramRanges : public ::testing::Test {
 protected:
  ProgramRanges() {
    write_range_tables(minute_of_driving(), drive());
    std::string text = scenario;
    text.replace(text.find("FOLDER"), 6, drive().string());
    scratch_.write("s.toml", text);
  }
  std::filesystem::path drive() const { return scratch_.folder() / "drive"; }
  std::filesystem::path run() const { return scratch_.folder() / "run"; }
  Ended go(Words more = {}) {
    Words words{"run", "s.toml", "--out", "run", "--no-figures"};
    words.insert(words.end(), more.begin(), more.end());
    return testing::incognita(words, scratch_.folder());
  }
  Ended refused(Words more = {}) {
    const Ended ended = go(std::move(more));
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(run()));
    return ended;
  }
  /// A scenario that declares the drive to be that of a car.
  std::string write_car() {
    scratch_.write("car.toml",
                   "[world]\ntype = \"recording\"\n[sensor]\ntype = \"range-bearing\"\n[recording]\n"
                   "folder = \"" +
                       drive().string() + "\"\n\n[vehicle]\nmodel = \"ackermann\"\n");
    return "car.toml";
  }
  /// Replaces a line of a table, counted from 1.
  void rewrite(const std::string& table, int line, const std::string& with) {
    std::istringstream in(bytes_of(drive() / table));
    std::string out, one;
    for (int n = 1; std::getline(in, one); ++n) out += (n == line ? with : one) + "\n";
    std::ofstream(drive() / table, std::ios::binary) << out;
  }
  /// Rewrites the whole drive.
  void write_drive(RangeRecording recording) {
    std::filesystem::remove_all(drive());
    write_range_tables(recording, drive());
  }
  Scratch scratch_;
};

TEST_F(ProgramRanges, RunsOnTables) {
  const Ended ended = go();
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.err, "detected format `tables`");
  const auto summary = testing::summary_of(run());
  EXPECT_EQ(summary["status"], "done");
  EXPECT_EQ(summary["frames"], 61);
  EXPECT_EQ(summary["lost_frames"], 0);
  EXPECT_GT(summary["landmarks"], 10);
  EXPECT_EQ(summary["ate_alignment"], "se3");
  EXPECT_LT(summary["ate_m"], 0.5);
  testing::expect_whole_tables(run());
  EXPECT_SAYS(bytes_of(run() / "measurements.csv"), "predicted_1");
  EXPECT_SAYS(bytes_of(run() / "measurements.csv"), "initialized");
  EXPECT_SAYS(bytes_of(run() / "estimate.tum"), "world_from_vehicle");
  EXPECT_SAYS(bytes_of(run() / "effective.toml"), "[vehicle]");
  EXPECT_SILENT_ON(bytes_of(run() / "effective.toml"), "[camera]");
}

/// Motion capture is often started after the robot.
TEST_F(ProgramRanges, ALateTruthIsComparedFromItsStart) {
  std::istringstream truth(bytes_of(drive() / "truth.csv"));
  std::string late, line;
  for (int n = 0; std::getline(truth, line); ++n)
    if (n == 0 || std::stod(line) > 10) late += line + "\n";
  std::ofstream(drive() / "truth.csv", std::ios::binary) << late;
  const auto landmark = drive_planar_loop({}, 5).landmarks[0].position;
  const Ended ended = go({"--set", "estimator.anchors_m=[[" + std::to_string(landmark.x()) + ", " +
                                       std::to_string(landmark.y()) + "]]"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto summary = testing::summary_of(run());
  EXPECT_EQ(summary["compared_poses"], 50);  // scans from 11 s to 60 s
  EXPECT_SAYS(ended.out, "truth at 50 of 61 tracked frames");
  EXPECT_SAYS(testing::lines(run() / "series.csv").front(), ",error_x_m,");
  testing::expect_whole_tables(run());
}

TEST_F(ProgramRanges, AnchorsMakeErrorsAbsolute) {
  const auto landmark = drive_planar_loop({}, 5).landmarks[0].position;  // relative to the start
  const Ended ended = go({"--set", "estimator.anchors_m=[[" + std::to_string(landmark.x()) + ", " +
                                       std::to_string(landmark.y()) + "]]"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto summary = testing::summary_of(run());
  EXPECT_EQ(summary["ate_alignment"], "none");
  EXPECT_EQ(summary["anchors"], 1);
  EXPECT_FALSE(summary["mean_nees"].is_null());
}

TEST_F(ProgramRanges, IsDeterministicToTheByte) {
  ASSERT_EQ(go().code, 0);
  const std::string map = bytes_of(run() / "map.csv"), series = bytes_of(run() / "series.csv"),
                    log = bytes_of(run() / "run.mcap");
  ASSERT_EQ(go().code, 0);
  EXPECT_TRUE(map == bytes_of(run() / "map.csv") && series == bytes_of(run() / "series.csv"));
  EXPECT_TRUE(log == bytes_of(run() / "run.mcap"));
}

/// The rows of a table without their first cell, the time.
std::vector<std::string> without_times(const std::filesystem::path& table) {
  std::vector<std::string> rows;
  std::ifstream in(table);
  for (std::string row; std::getline(in, row);)
    rows.push_back(row.substr(std::min(row.find_first_of(" ,"), row.size())));
  return rows;
}

TEST_F(ProgramRanges, DoesNotDependOnTheOriginAndTheDigitsOfTheStamps) {
  // Stamps with many digits, none half way between two microseconds; then the origin is moved
  const auto shifted = [](double offset_s, double per_s) {
    RangeRecording recording = minute_of_driving();
    const auto rounded = [per_s](double t) { return std::round(t * per_s) / per_s; };
    const auto shift = [&](auto& events) {
      for (auto& event : events) event.t = rounded(rounded(event.t * 1.000123703141592) + offset_s);
    };
    shift(recording.odometry), shift(recording.scans), shift(recording.truth), shift(recording.fixes);
    return recording;
  };
  write_drive(shifted(0, 1e12));
  ASSERT_EQ(go().code, 0);
  const auto path = without_times(run() / "estimate.tum"),
             covariance = without_times(run() / "covariance.csv");
  const std::string map = bytes_of(run() / "map.csv");
  ASSERT_GT(path.size(), 50u);
  for (const double offset_s : {0.0, 1000.0, 1.4e9}) {
    write_drive(shifted(offset_s, 1e6));
    ASSERT_EQ(go().code, 0);
    EXPECT_EQ(without_times(run() / "estimate.tum"), path) << offset_s;
    EXPECT_EQ(without_times(run() / "covariance.csv"), covariance) << offset_s;
    EXPECT_EQ(bytes_of(run() / "map.csv"), map) << offset_s;
  }
}

TEST_F(ProgramRanges, ReportsSpuriousInformation) {
  EXPECT_SAYS(
      go().err,
      "position: unobservable\nheading: unobservable, but the filter has spurious information from measurements: sigma ");
  EXPECT_EQ(testing::summary_of(run())["observability"]["spurious_information"], 1);
  const Ended better = go({"--set", "estimator.linearization=first-estimate"});
  EXPECT_SAYS(better.err, "position: unobservable\nheading: unobservable\n");
  EXPECT_EQ(testing::summary_of(run())["observability"]["spurious_information"], 0);
}

TEST_F(ProgramRanges, EveryFilterRuns) {
  for (const char* set : {"estimator.linearization=iterated", "estimator.linearization=unscented-vehicle",
                          "estimator.linearization=first-estimate", "estimator.map_frame=vehicle",
                          "estimator.decorrelate=everything", "estimator.decorrelate=map",
                          "estimator.decorrelate=map-linear", "estimator.use_fixes=true"}) {
    const Ended ended = go({"--set", set});
    EXPECT_EQ(ended.code, 0) << set << ": " << ended.err;
    EXPECT_LT(testing::summary_of(run())["ate_m"], 1.5) << set;
  }
}

TEST_F(ProgramRanges, SkipsInvalidRangesAndReportsThem) {
  rewrite("detections.csv", 3, "0,nan,0.1,3");
  const Ended ended = go();
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.err, "detections.csv:3");
}

TEST_F(ProgramRanges, RefusesAMissingColumn) {
  rewrite("detections.csv", 1, "t_s,range_m,bearing,identity");
  const Ended ended = refused();
  EXPECT_SAYS(ended.err, "detections.csv");
  EXPECT_SAYS(ended.err, "bearing_rad");
}

TEST_F(ProgramRanges, RefusesDecreasingTimes) {
  rewrite("odometry.csv", 5, "0.05,1,0.1");
  EXPECT_SAYS(refused().err, "odometry.csv:5");
}

TEST_F(ProgramRanges, RefusesTheWrongVehicle) {
  const Ended ended = testing::incognita({"run", write_car(), "--out", "run"}, scratch_.folder());
  EXPECT_EQ(ended.code, 2);
  EXPECT_SAYS(ended.err, "the odometry of this recording is that of `differential-drive`");
}

TEST_F(ProgramRanges, RefusesKnownAssociationWithoutIdentities) {
  RangeRecording anonymous = drive_planar_loop({.duration_s = 10}, 5);
  for (auto& scan : anonymous.scans)
    for (Detection& d : scan.detections) d.identity = Detection::unknown;
  write_range_tables(anonymous, scratch_.folder() / "anonymous");
  EXPECT_SAYS(refused({"--set", "recording.folder=" + (scratch_.folder() / "anonymous").string()}).err,
              "association.method = known");
}

TEST_F(ProgramRanges, RefusesAnAnchorWithoutADetection) {
  EXPECT_SAYS(refused({"--set", "estimator.anchors_m=[[100, 100]]"}).err, "estimator.anchors_m");
}

TEST_F(ProgramRanges, RefusesADurationWithoutAScan) {
  rewrite("odometry.csv", 2, "-100,1,0.1");
  EXPECT_SAYS(refused({"--duration", "5"}).err,
              "the first scan of this recording comes 100.0 s after its start");
}

TEST_F(ProgramRanges, RefusesSettingsOfOtherVehiclesAndMethods) {
  EXPECT_SAYS(refused({"--set", "vehicle.wheelbase_m=3"}).err,
              "`vehicle.wheelbase_m` belongs to `vehicle.model = \"ackermann\"`");
  EXPECT_SAYS(refused({"--set", "association.max_nodes=3"}).err,
              "`association.max_nodes` belongs to `association.method = \"joint\"`");
  EXPECT_SAYS(refused({"--set", "run.rate_hz=3"}).err, "`run.rate_hz` belongs to `world.type = ");
}

TEST_F(ProgramRanges, RefusesCameraSettings) {
  const Ended ended = refused({"--set", "camera.fu_px=200"});
  EXPECT_SAYS(ended.err, "camera.fu_px");
  EXPECT_SAYS(ended.err, "belongs to `sensor.type = \"camera\"`");
}

TEST_F(ProgramRanges, RefusesIncompatibleFilterOptions) {
  EXPECT_SAYS(refused({"--set", "estimator.map_frame=vehicle", "--set", "estimator.decorrelate=map"}).err,
              "estimator.decorrelate");
  EXPECT_SAYS(
      refused({"--set", "estimator.map_frame=vehicle", "--set", "estimator.linearization=first-estimate"})
          .err,
      "estimator.linearization");
  EXPECT_SAYS(refused({"--set", "recording.format=tum"}).err, "recording.format");
  EXPECT_SAYS(refused({"--set", "world.type=room"}).err, "world.type");
  EXPECT_SAYS(refused({"--save-frames"}).err, "--save-frames");
}

TEST_F(ProgramRanges, ReportsACappedJointSearch) {
  const Ended ended = go({"--set", "association.method=joint", "--set", "association.max_nodes=1", "--set",
                          "association.initialization_probability=0.9999999"});
  EXPECT_SAYS(bytes_of(run() / "series.csv"), "degraded");
}

TEST_F(ProgramRanges, CheckRefusesWhatARunRefuses) {
  const Ended ended = testing::incognita({"config", write_car(), "--check"}, scratch_.folder());
  EXPECT_EQ(ended.code, 2) << ended.out;
}

TEST_F(ProgramRanges, ChecksAScenario) {
  const Ended ended = testing::incognita({"config", "s.toml", "--check"}, scratch_.folder());
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.out, "61 scans");
  const Ended json = testing::incognita({"config", "s.toml", "--json"}, scratch_.folder());
  EXPECT_SAYS(json.out, "estimator.anchors_m");
  EXPECT_SILENT_ON(json.out, "camera.fu_px");
}

TEST_F(ProgramRanges, EndsWithASummary) {
  const Ended ended = go();
  EXPECT_SAYS(ended.out, "run          done\n");
  EXPECT_SAYS(ended.out, "frames       61 in 60.0 s: 61 tracked, 0 lost\n");
  EXPECT_SAYS(ended.out, "after se3 alignment, drift ");
  EXPECT_SAYS(ended.out, "; map error ");
  EXPECT_SAYS(ended.out, "of 20 surveyed landmarks\n");
  EXPECT_SAYS(ended.out, "consistency  consistent: NIS ");
  EXPECT_SAYS(ended.out, "results      run\n");
  EXPECT_LE(std::count(ended.out.begin(), ended.out.end(), '\n'), 12);
  EXPECT_SILENT_ON(ended.err, "results");
  const auto summary = testing::summary_of(run());
  EXPECT_NEAR(summary["path_m"], 60, 6) << "1 m/s for a minute";
  EXPECT_GT(summary["map_error_landmarks"], 10);
  EXPECT_LT(summary["map_error_m"], 1);
  EXPECT_EQ(summary["consistency"]["verdict"], "consistent");
  EXPECT_TRUE(summary["consistency"]["causes"].empty());
}

TEST_F(ProgramRanges, MapErrorIsThatOfTheTables) {
  ASSERT_EQ(go().code, 0);
  std::map<std::string, std::pair<double, double>> surveyed;
  std::istringstream survey(bytes_of(run() / "surveyed.csv")), map(bytes_of(run() / "map.csv"));
  const auto cells = [](const std::string& row) {
    std::istringstream in(row);
    std::vector<std::string> out;
    for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
    return out;
  };
  std::string row;
  std::getline(survey, row);
  EXPECT_EQ(row, "id,x,y,z");
  while (std::getline(survey, row)) {
    const auto c = cells(row);
    surveyed[c[0]] = {std::stod(c[1]), std::stod(c[2])};
  }
  EXPECT_EQ(surveyed.size(), 20u);
  std::getline(map, row);
  double sum = 0;
  int count = 0;
  while (std::getline(map, row)) {
    const auto c = cells(row);
    ASSERT_TRUE(surveyed.contains(c[0]));
    sum += std::pow(std::stod(c[2]) - surveyed[c[0]].first, 2) +
           std::pow(std::stod(c[3]) - surveyed[c[0]].second, 2);
    ++count;
  }
  const auto summary = testing::summary_of(run());
  EXPECT_EQ(summary["map_error_landmarks"], count);
  EXPECT_NEAR(summary["map_error_m"], std::sqrt(sum / count), 1e-4);
}

TEST_F(ProgramRanges, MirroredBearingsAreOverconfident) {
  RangeRecording mirrored = minute_of_driving();
  for (auto& scan : mirrored.scans)
    for (Detection& d : scan.detections) d.bearing_rad = -d.bearing_rad;
  write_drive(mirrored);
  const Ended ended = go({"--duration", "40"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_SAYS(ended.out, "consistency  overconfident: NIS ");
  EXPECT_SAYS(ended.out, "from the start");
  EXPECT_SAYS(ended.out, "usual causes: sign or axis of a measurement");
  const auto consistency = testing::summary_of(run())["consistency"];
  EXPECT_EQ(consistency["verdict"], "overconfident");
  EXPECT_GT(consistency["nis"], consistency["nis_band"][1]);
  EXPECT_GE(consistency["causes"].size(), 4u);
}

TEST_F(ProgramRanges, MirroredBearingsRejectedByTheGateAreOverconfident) {
  PlanarLoopSettings exact;
  exact.duration_s = 60;
  exact.sigma_range_m = exact.sigma_bearing_rad = exact.sigma_speed_m_s = exact.sigma_turn_rate_rad_s = 0.02;
  RangeRecording mirrored = drive_planar_loop(exact, 5);
  for (auto& scan : mirrored.scans)
    for (Detection& d : scan.detections) d.bearing_rad = -d.bearing_rad;
  write_drive(mirrored);
  const Ended ended =
      go({"--set", "sensor.sigma_range_m=0.02", "--set", "sensor.sigma_bearing_rad=0.02", "--set",
          "vehicle.sigma_speed_m_s=0.02", "--set", "vehicle.sigma_turn_rate_rad_s=0.02"});
  EXPECT_SAYS(ended.out, "consistency  overconfident");
  EXPECT_SAYS(ended.out, "of the measurements are outside their gates");
  EXPECT_SAYS(ended.out, "usual causes: sign or axis of a measurement");
}

TEST_F(ProgramRanges, WarnsOfOdometryInMilliseconds) {
  RangeRecording milliseconds = minute_of_driving();
  for (Odometry& odometry : milliseconds.odometry) odometry.t *= 1000;
  write_drive(milliseconds);
  const Ended ended = go();
  EXPECT_SAYS(ended.err,
              "warning: the odometry (0 s to 60000 s) and the scans (0 s to 60 s) overlap by only 0.1 %");
  EXPECT_SAYS(ended.err, "is held for 60 s");
  const auto warnings = testing::summary_of(run())["warnings"];
  EXPECT_EQ(warnings.size(), 2u);
  EXPECT_SAYS(ended.out, "warnings     2, the first: the odometry");
}

TEST_F(ProgramRanges, CanBeEvaluated) {
  ASSERT_EQ(go().code, 0);
  const Ended ended = testing::incognita({"evaluate", "run"}, scratch_.folder());
  EXPECT_EQ(ended.code, 0) << ended.err;
}

}  // namespace
}  // namespace incognita
