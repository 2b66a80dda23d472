// Range-bearing recordings as tables, valid and invalid, and how a format is detected.
#include "incognita/io/recordings/range_recording.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "tests/io/notes.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::contents;
using testing::message_of;
using testing::Scratch;

using std::numbers::pi;

const std::string drive = "t_s,speed_m_s,turn_rate_rad_s\n";
const std::string drive_rows = "0,0.5,0\n0.1,0.5,0.2\n0.2,0.4,0.2\n";
const std::string seen = "t_s,range_m,bearing_rad,identity\n";
const std::string seen_rows = "0.05,2,0.5,7\n0.05,3,-0.25,\n0.15,,,\n";

/// A folder of tables, valid except for what a test changes.
struct Tables {
  std::string odometry = drive + drive_rows;
  std::string detections = seen + seen_rows;
  std::string truth;
  std::string fixes;
  std::string landmarks;

  RangeRecording read(const std::string& format = "tables") const {
    const Scratch scratch;
    scratch.write("odometry.csv", odometry);
    scratch.write("detections.csv", detections);
    if (!truth.empty()) scratch.write("truth.csv", truth);
    if (!fixes.empty()) scratch.write("fixes.csv", fixes);
    if (!landmarks.empty()) scratch.write("landmarks.csv", landmarks);
    return read_range_recording(scratch.folder(), format);
  }
  std::string complaint() const {
    return message_of([&] { read(); });
  }
};

std::string odometry_complaint(const std::string& text) {
  Tables tables;
  tables.odometry = text;
  return tables.complaint();
}
std::string detections_complaint(const std::string& text) {
  Tables tables;
  tables.detections = text;
  return tables.complaint();
}
std::string truth_complaint(const std::string& text) {
  Tables tables;
  tables.truth = text;
  return tables.complaint();
}
std::string landmarks_complaint(const std::string& text) {
  Tables tables;
  tables.landmarks = text;
  return tables.complaint();
}

TEST(RangeTables, AreRead) {
  Tables tables;
  tables.truth = "t_s,x_m,y_m,heading_rad\n0,1,2,3\n0.1,1.5,2,\n";
  tables.fixes = "t_s,x_m,y_m\n0,1.25,2\n";
  tables.landmarks = "identity,x_m,y_m\n7,3,4\n";
  const RangeRecording recording = tables.read("auto");
  EXPECT_EQ(recording.format, "tables");
  EXPECT_EQ(recording.vehicle, "differential-drive");
  ASSERT_EQ(recording.odometry.size(), 3u);
  EXPECT_EQ(recording.odometry[1].t, 0.1);
  EXPECT_EQ(recording.odometry[1].input, Eigen::Vector2d(0.5, 0.2));
  ASSERT_EQ(recording.scans.size(), 2u);
  ASSERT_EQ(recording.scans[0].detections.size(), 2u);
  EXPECT_EQ(recording.scans[0].detections[0].identity, 7);
  EXPECT_EQ(recording.scans[0].detections[1].identity, Detection::unknown);
  EXPECT_EQ(recording.scans[0].detections[1].bearing_rad, -0.25);
  EXPECT_EQ(recording.scans[1].t, 0.15);
  EXPECT_TRUE(recording.scans[1].detections.empty());
  ASSERT_EQ(recording.truth.size(), 2u);
  EXPECT_EQ(recording.truth[0].heading_rad, 3.0);
  EXPECT_FALSE(recording.truth[1].heading_rad);
  ASSERT_EQ(recording.fixes.size(), 1u);
  EXPECT_EQ(recording.fixes[0].position, Eigen::Vector2d(1.25, 2));
  ASSERT_EQ(recording.landmarks.size(), 1u);
  EXPECT_EQ(recording.landmarks[0].position, Eigen::Vector2d(3, 4));
  ASSERT_EQ(recording.notes.size(), 1u);
  EXPECT_HAS(recording.notes[0], "detected format `tables`");
}

/// The odometry covers 0 to 0.2 s.
TEST(RangeTables, WarnOfFixesOutsideTheOdometry) {
  Tables tables;
  const auto note_on = [&](const char* fix) {
    tables.fixes = std::string("t_s,x_m,y_m\n") + fix + "\n";
    const RangeRecording recording = tables.read();
    return recording.notes.empty() ? "" : recording.notes.back();
  };
  EXPECT_HAS(note_on("-0.5,1,2"), "the fixes (-0.5 s to -0.5 s) are all from before the odometry");
  EXPECT_HAS(note_on("-0.5,1,2"), "with start.at_first_fix the vehicle starts at the first fix");
  EXPECT_HAS(note_on("5,1,2"),
             "are all from after the odometry (0 s to 0.2 s): check that both are on the same clock");
  EXPECT_EQ(note_on("0.1,1,2").find("fixes"), std::string::npos);
}

const std::string moved = "t_s,dx_m,dy_m,dheading_rad,var_x_m2,var_y_m2,var_heading_rad2,cov_xy_m2\n";

TEST(RangeTables, TakePoseIncrementsWithTheirCovariance) {
  Tables tables;
  tables.odometry =
      moved + "0,0,0,0,0,0,0,0\n0.1,0.05,-0.01,0.2,4e-4,1e-4,1e-6,1e-5\n0.3,0.1,0,0,1e-4,1e-4,0,0\n";
  const RangeRecording recording = tables.read();
  EXPECT_EQ(recording.vehicle, "differential-drive");
  ASSERT_EQ(recording.odometry.size(), 3u);
  EXPECT_EQ(recording.odometry[0].t, 0);
  EXPECT_EQ(recording.odometry[2].t, 0.3);
  EXPECT_EQ(recording.odometry[1].t, 0.1);
  ASSERT_TRUE(recording.odometry[0].twist);
  const MeasuredTwist& twist = *recording.odometry[0].twist;
  EXPECT_NEAR(twist.period_s, 0.1, 1e-12);
  const auto step = PlanarTwist().step({0, 0, 0}, twist.twist, twist.period_s);
  EXPECT_LT((step.x - Eigen::Vector3d(0.05, -0.01, 0.2)).norm(), 1e-12);
  const Eigen::Matrix3d cov = step.G * twist.cov * step.G.transpose();
  EXPECT_NEAR(cov(0, 0), 4e-4, 1e-12);
  EXPECT_NEAR(cov(0, 1), 1e-5, 1e-12);
  EXPECT_NEAR(cov(2, 2), 1e-6, 1e-12);
  EXPECT_NEAR(recording.odometry[1].twist->twist[0], 0.5, 1e-12);
  EXPECT_HAS(all_notes(recording), "the noise of the odometry is that of odometry.csv");
}

TEST(RangeTables, RefuseInvalidIncrements) {
  EXPECT_HAS(odometry_complaint("t_s,dx_m,dy_m,dheading_rad\n0,0,0,0\n"), "var_x_m2");
  EXPECT_HAS(odometry_complaint(moved + "0,0,0,0,0,0,0,0\n"), "must be followed by two rows at least");
  EXPECT_HAS(odometry_complaint(moved + "0,0,0,0,0,0,0,0\n0,1,0,0,1,1,1,0\n"),
             "odometry.csv:3: t_s must increase");
  EXPECT_HAS(odometry_complaint(moved + "0,0,0,0,0,0,0,0\n1,1,0,0,-1,1,1,0\n"),
             "odometry.csv:3: the covariance of the increment is none");
  EXPECT_HAS(odometry_complaint(moved + "0,0,0,0,0,0,0,0\n1,1,0,0,1,1,1,2\n"),
             "the covariance of the increment is none");
  EXPECT_HAS(odometry_complaint(moved + "0,0,0,0,0,0,0,0\n1,1,0,90,1,1,1,0\n"),
             "the turn since the row before must be within");
  Tables tables;
  tables.odometry = moved + "0,1,0,0,0,0,0,0\n0.3,1,0,0,1,1,1,0\n";
  EXPECT_HAS(all_notes(tables.read()), "odometry.csv:2: the increment of the first row is not used");
  const Scratch scratch;
  EXPECT_HAS(message_of([&] { write_range_tables(tables.read(), scratch / "out"); }),
             "odometry of pose increments is not written as tables");
}

TEST(RangeTables, AcceptAnyOrderOfColumnsAndOtherStyles) {
  Tables tables;
  tables.odometry =
      "\xEF\xBB\xBF# from a car\r\n\"steering_rad\", comment "
      ",\"t_s\",wheel_speed_m_s\r\n-0.25,x,1.5,3e0\r\n\r\n";
  tables.detections = "bearing_rad,t_s,range_m\n4,1.5,2";
  const RangeRecording recording = tables.read();
  EXPECT_EQ(recording.vehicle, "ackermann");
  ASSERT_EQ(recording.odometry.size(), 1u);
  EXPECT_EQ(recording.odometry[0].input, Eigen::Vector2d(3, -0.25));
  ASSERT_EQ(recording.scans.size(), 1u);
  EXPECT_NEAR(recording.scans[0].detections.at(0).bearing_rad, 4 - 2 * pi, 1e-12);
  EXPECT_HAS(all_notes(recording), "odometry.csv: unused columns: comment");
  EXPECT_HAS(all_notes(recording), "there is no truth.csv");
  EXPECT_HAS(all_notes(recording), "there is no landmarks.csv");
}

TEST(RangeTables, SkipInvalidDetectionsAndReportThem) {
  Tables tables;
  tables.detections = seen + "0,2,0,1\n0.1,nan,0,2\n0.1,0,0.1,3\n0.1,-1,0,3\n0.1,inf,0,3\n0.2,2,nan,3\n";
  const RangeRecording recording = tables.read();
  ASSERT_EQ(recording.scans.size(), 3u);
  EXPECT_EQ(recording.scans[0].detections.size(), 1u);
  EXPECT_TRUE(recording.scans[1].detections.empty());
  EXPECT_TRUE(recording.scans[2].detections.empty());
  EXPECT_HAS(all_notes(recording), "5 detections without a positive range and a bearing are skipped");
  EXPECT_HAS(all_notes(recording), "detections.csv:3");
}

TEST(RangeTables, NameAMissingColumn) {
  const std::string turn = odometry_complaint("t_s,speed_m_s,turnrate_rad_s\n0,1,0\n");
  EXPECT_HAS(turn, "odometry.csv:1: there is no column `turn_rate_rad_s`");
  EXPECT_HAS(turn, "the columns are t_s, speed_m_s, turnrate_rad_s; the nearest is `turnrate_rad_s`");
  EXPECT_HAS(turn, "an Ackermann car `wheel_speed_m_s` and `steering_rad`");
  EXPECT_HAS(odometry_complaint("t_s,wheel_speed_m_s,steering_deg\n0,1,0\n"), "no column `steering_rad`");
  EXPECT_HAS(odometry_complaint("time,speed_m_s,turn_rate_rad_s\n0,1,0\n"), "no column `t_s`");
  EXPECT_HAS(odometry_complaint("t_s;speed_m_s;turn_rate_rad_s\n0;1;0\n"),
             "no column `t_s`; the columns are t_s;");
  EXPECT_HAS(odometry_complaint("t_s,speed_m_s,turn_rate_rad_s,wheel_speed_m_s,steering_rad\n0,1,0,1,0\n"),
             "odometry.csv:1: has the columns of a differential drive and of an Ackermann car");
  EXPECT_HAS(detections_complaint("t_s,range,bearing_rad\n0,1,0\n"),
             "detections.csv:1: there is no column `range_m`");
  EXPECT_HAS(truth_complaint("t_s,x_m,z_m\n0,1,0\n"), "truth.csv:1: there is no column `y_m`");
  EXPECT_HAS(landmarks_complaint("id,x_m,y_m\n0,1,0\n"), "landmarks.csv:1: there is no column `identity`");
}

TEST(RangeTables, RefuseInvalidRows) {
  EXPECT_HAS(odometry_complaint(drive + "0,1,0\n1,1,0\n0.5,1,0\n"),
             "odometry.csv:4: the times must not go backwards: 0.5 comes after 1");
  EXPECT_HAS(odometry_complaint(drive + "0,nan,0\n"),
             "odometry.csv:2: `speed_m_s` must be a finite number, and is nan");
  EXPECT_HAS(odometry_complaint(drive + "inf,1,0\n"),
             "odometry.csv:2: `t_s` must be a finite number, and is inf");
  EXPECT_HAS(odometry_complaint(drive + "0,fast,0\n"),
             "odometry.csv:2: `speed_m_s` must be a number, and is `fast`");
  EXPECT_HAS(odometry_complaint(drive + "0,,0\n"), "`speed_m_s` must be a number, and is ``");
  EXPECT_HAS(odometry_complaint(drive + "0,1\n"),
             "odometry.csv:2: has 2 cells, the first line names 3 columns");
  EXPECT_HAS(odometry_complaint("t_s,wheel_speed_m_s,steering_rad\n0,1,12\n"),
             "odometry.csv:2: the steering angle must be within +-1.571 rad, and is 12; is it in degrees?");
  EXPECT_HAS(odometry_complaint("t_s,t_s\n0,1\n"), "odometry.csv:1: there are two columns `t_s`");
  EXPECT_HAS(detections_complaint(seen + "0.2,1,0,1\n0.1,1,0,1\n"),
             "detections.csv:3: the times must not go backwards");
  EXPECT_HAS(detections_complaint(seen + "nan,1,0,1\n"), "detections.csv:2: `t_s` must be a finite number");
  EXPECT_HAS(detections_complaint(seen + "0,1,45,1\n"),
             "detections.csv:2: the bearing must be within +-6.283 rad");
  EXPECT_HAS(detections_complaint(seen + "0,1,,1\n"),
             "detections.csv:2: `range_m`, `bearing_rad` and `identity` must all");
  EXPECT_HAS(detections_complaint(seen + "0,,,1\n"), "must all be empty if the scan has no detection");
  EXPECT_HAS(detections_complaint(seen + "0,1,0,1.5\n"),
             "detections.csv:2: `identity` must be a whole number");
  EXPECT_HAS(detections_complaint(seen + "0,1,0,-2\n"), "and is `-2`");
  EXPECT_HAS(truth_complaint("t_s,x_m,y_m\n1,0,0\n0,0,0\n"), "truth.csv:3: the times must not go backwards");
  EXPECT_HAS(truth_complaint("t_s,x_m,y_m\n1,nan,0\n"), "truth.csv:2: `x_m` must be a finite number");
  EXPECT_HAS(truth_complaint("t_s,x_m,y_m,heading_rad\n1,0,0,nan\n"),
             "truth.csv:2: `heading_rad` must be a finite");
  EXPECT_HAS(landmarks_complaint("identity,x_m,y_m\n3,0,0\n3,1,1\n"),
             "landmarks.csv:3: there is already a landmark 3");
  EXPECT_HAS(landmarks_complaint("identity,x_m,y_m\n3,0,inf\n"),
             "landmarks.csv:2: `y_m` must be a finite number");
}

TEST(RangeTables, RefuseFilesWithoutRowsAndDifferentClocks) {
  EXPECT_HAS(odometry_complaint(""), "odometry.csv: is empty; its first line must name the columns");
  EXPECT_HAS(odometry_complaint("# nothing\n\n"), "odometry.csv: is empty");
  EXPECT_HAS(odometry_complaint(drive), "odometry.csv: there are no rows below the column names");
  EXPECT_HAS(detections_complaint(seen), "detections.csv: there are no rows");
  EXPECT_HAS(truth_complaint("t_s,x_m,y_m\n"), "truth.csv: there are no rows");
  EXPECT_HAS(landmarks_complaint("identity,x_m,y_m\n"), "landmarks.csv: there are no rows");
  EXPECT_HAS(
      detections_complaint(seen + "1305031102.17,1,0,1\n"),
      "the odometry (0 s to 0.2 s) and the scans (1305031102.17 s to 1305031102.17 s) do not overlap in "
      "time");
  Tables tables;
  tables.truth = "t_s,x_m,y_m\n1305031102.17,0,0\n";
  EXPECT_HAS(all_notes(tables.read()), "the truth (1305031102.17 s to");
}

void expect_same(const std::vector<RangeRecording::TimedPosition>& a,
                 const std::vector<RangeRecording::TimedPosition>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].t, b[i].t);
    EXPECT_EQ(a[i].position, b[i].position);
    EXPECT_EQ(a[i].heading_rad, b[i].heading_rad);
  }
}

void expect_same(const RangeRecording& a, const RangeRecording& b) {
  EXPECT_EQ(a.vehicle, b.vehicle);
  ASSERT_EQ(a.odometry.size(), b.odometry.size());
  for (std::size_t i = 0; i < a.odometry.size(); ++i) {
    EXPECT_EQ(a.odometry[i].t, b.odometry[i].t);
    EXPECT_EQ(a.odometry[i].input, b.odometry[i].input);
  }
  ASSERT_EQ(a.scans.size(), b.scans.size());
  for (std::size_t i = 0; i < a.scans.size(); ++i) {
    EXPECT_EQ(a.scans[i].t, b.scans[i].t);
    ASSERT_EQ(a.scans[i].detections.size(), b.scans[i].detections.size());
    for (std::size_t k = 0; k < a.scans[i].detections.size(); ++k) {
      EXPECT_EQ(a.scans[i].detections[k].range_m, b.scans[i].detections[k].range_m);
      EXPECT_EQ(a.scans[i].detections[k].bearing_rad, b.scans[i].detections[k].bearing_rad);
      EXPECT_EQ(a.scans[i].detections[k].identity, b.scans[i].detections[k].identity);
    }
  }
  expect_same(a.truth, b.truth);
  expect_same(a.fixes, b.fixes);
  ASSERT_EQ(a.landmarks.size(), b.landmarks.size());
  for (std::size_t i = 0; i < a.landmarks.size(); ++i) {
    EXPECT_EQ(a.landmarks[i].identity, b.landmarks[i].identity);
    EXPECT_EQ(a.landmarks[i].position, b.landmarks[i].position);
  }
}

TEST(RangeTables, RoundTrip) {
  RangeRecording recording{"simulated", "ackermann", {}, {}, {}, {}, {}, {}};
  for (int k = 0; k < 5; ++k) {
    const double t = 1248446188.323 + k / 3.0;
    recording.odometry.push_back({t, {std::sqrt(k + 0.1), -1e-17 * k}});
    recording.scans.push_back({t, {}});
    for (int i = 0; i < k % 3; ++i)
      recording.scans.back().detections.push_back(
          {0.1 + k / 7.0, std::sin(k + i), i == 0 ? k : Detection::unknown});
    recording.truth.push_back({t, {k / 3.0, 1e300}, {}});
    if (k != 2) recording.truth.back().heading_rad = std::exp(k);
    if (k % 2 == 0) recording.fixes.push_back({t, {k / 7.0, -k}, {}});
    recording.landmarks.push_back({k == 4 ? Detection::unknown : k, {std::cos(k), k}});
  }
  const Scratch scratch;
  write_range_tables(recording, scratch / "new/folder");
  expect_same(recording, read_range_recording(scratch / "new/folder", "auto"));

  recording.vehicle = "differential-drive";
  recording.truth.clear();
  recording.fixes.clear();
  recording.landmarks.clear();
  write_range_tables(recording, scratch / "other");
  expect_same(recording, read_range_recording(scratch / "other", "tables"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "other/truth.csv"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "other/fixes.csv"));
}

TEST(RangeTables, AreNotWrittenOverOtherFiles) {
  const RangeRecording recording = Tables().read();
  const Scratch scratch;
  scratch.write("truth.csv", "mine\n");
  EXPECT_HAS(message_of<RecordError>([&] { write_range_tables(recording, scratch.folder()); }),
             "truth.csv is already there; choose another folder");
  EXPECT_FALSE(std::filesystem::exists(scratch / "odometry.csv"));
  EXPECT_EQ(contents(scratch / "truth.csv"), "mine\n");
  EXPECT_HAS(message_of<RecordError>([&] { write_range_tables(recording, scratch / "truth.csv/folder"); }),
             "cannot create");
  RangeRecording unknown = recording;
  unknown.vehicle = "hovercraft";
  EXPECT_HAS(message_of([&] { write_range_tables(unknown, scratch / "new"); }), "the vehicle `hovercraft`");
}

TEST(RangeRecordingFormat, IsDetectedOrExplained) {
  const Scratch scratch;
  scratch.write("deep/odometry.csv", drive);
  const std::string text = message_of([&] { read_range_recording(scratch.folder(), "auto"); });
  EXPECT_HAS(text, "no range-bearing recording is recognized; it has the folders deep");
  EXPECT_HAS(text, "tables: odometry.csv and detections.csv");
  EXPECT_HAS(text, "acfr: data_set.mat");
  EXPECT_HAS(text, "mrclam: Barcodes.dat");
  EXPECT_HAS(message_of([&] { read_range_recording(scratch.folder(), "bag"); }),
             "recording.format = bag: must be");
  EXPECT_HAS(message_of([&] { read_range_recording(scratch / "none", "auto"); }), "is not a folder");
  EXPECT_HAS(message_of([&] { read_range_recording(scratch / "deep", "auto"); }),
             "odometry.csv: there are no rows");
}

}  // namespace
}  // namespace incognita
