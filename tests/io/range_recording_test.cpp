// Range-bearing recordings in every layout, and every kind of invalid file.
#include "incognita/io/recordings/range_recording.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/recordings/reflectors.hpp"
#include "tests/io/mat_writer.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::contents;
using testing::MatVariables;
using testing::message_of;
using testing::row;
using testing::Scratch;
using testing::small_car_park;
using testing::write_mat;

constexpr double pi = std::numbers::pi;

std::string all_notes(const RangeRecording& recording) {
  std::string all;
  for (const std::string& note : recording.notes) all += note + "\n";
  return all;
}

// Reflectors

struct HandMadeScan {
  std::vector<double> ranges_m = std::vector<double>(361, 81.91);
  std::vector<double> intensities = std::vector<double>(361, 0.0);

  HandMadeScan& post(std::size_t beam, double range_m) {
    ranges_m[beam] = range_m;
    intensities[beam] = 8192;
    return *this;
  }
  std::vector<Detection> find() const { return find_reflectors(ranges_m, intensities); }
};

TEST(Reflectors, AreAtTheMeanOfTheirBeams) {
  EXPECT_TRUE(HandMadeScan().find().empty());
  const auto found = HandMadeScan().post(0, 5).post(180, 10).post(182, 10.5).post(360, 20).find();
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0].bearing_rad, -pi / 2, 1e-12) << "beam 1 is to the right";
  EXPECT_NEAR(found[1].bearing_rad, radians(0.5), 1e-12);
  EXPECT_DOUBLE_EQ(found[1].range_m, 10.25);
  EXPECT_NEAR(found[2].bearing_rad, pi / 2, 1e-12);
  for (const Detection& one : found) EXPECT_EQ(one.identity, Detection::unknown);
}

TEST(Reflectors, AreSeparatedByTheGap) {
  EXPECT_EQ(HandMadeScan().post(10, 5).post(12, 5).post(14, 5).find().size(), 1u);
  EXPECT_EQ(HandMadeScan().post(10, 5).post(13, 5).find().size(), 2u);
}

TEST(Reflectors, ExcludeTheVehicleAndWhatIsBeyondTheYard) {
  EXPECT_TRUE(HandMadeScan().post(10, 0.85).post(100, 1).post(200, 30).post(300, 81.91).find().empty());
  EXPECT_EQ(HandMadeScan().post(10, 1.01).post(200, 29.99).find().size(), 2u);
}

TEST(Reflectors, IgnoreBeamsWithoutARange) {
  const double nan = std::nan("");
  const auto found = HandMadeScan().post(10, nan).post(11, 5).post(12, INFINITY).post(100, nan).find();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_DOUBLE_EQ(found[0].range_m, 5);
  EXPECT_NEAR(found[0].bearing_rad, radians(5.5 - 90), 1e-12);
  EXPECT_THROW(find_reflectors(std::vector<double>(3), std::vector<double>(2)), std::invalid_argument);
}

// Tables

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

// The format

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

// The car park

RangeRecording read_park(const MatVariables& park, matio_compression compression = MAT_COMPRESSION_NONE) {
  const Scratch scratch;
  write_mat(scratch / "data_set.mat", park, compression);
  return read_range_recording(scratch.folder(), "acfr");
}

/// The error message for the small car park with one variable changed.
std::string park_complaint(const std::string& name, const Eigen::MatrixXd& values) {
  MatVariables park = small_car_park();
  park[name] = values;
  return message_of([&] { read_park(park); });
}

void check_small_park(const RangeRecording& recording) {
  EXPECT_EQ(recording.format, "acfr");
  EXPECT_EQ(recording.vehicle, "ackermann");
  ASSERT_EQ(recording.odometry.size(), 3u);
  EXPECT_EQ(recording.odometry[1].t, 10.3);
  EXPECT_EQ(recording.odometry[1].input, Eigen::Vector2d(-0.25, -0.5));
  ASSERT_EQ(recording.truth.size(), 2u);
  EXPECT_EQ(recording.truth[1].position, Eigen::Vector2d(5.25, 4.125));
  EXPECT_FALSE(recording.truth[1].heading_rad);
  ASSERT_EQ(recording.fixes.size(), 2u) << "a GPS is both";
  EXPECT_EQ(recording.fixes[0].position, Eigen::Vector2d(5.5, 4.5));
  ASSERT_EQ(recording.scans.size(), 3u);
  ASSERT_EQ(recording.scans[0].detections.size(), 2u);
  EXPECT_EQ(recording.scans[0].detections[1].range_m, 10.25);
  EXPECT_NEAR(recording.scans[0].detections[1].bearing_rad, radians(0.5), 1e-12);
  EXPECT_EQ(recording.scans[0].detections[1].identity, Detection::unknown);
  EXPECT_TRUE(recording.scans[1].detections.empty());
  EXPECT_EQ(recording.scans[2].t, 10.7);
  EXPECT_NEAR(recording.scans[2].detections.at(0).bearing_rad, pi / 2, 1e-12);
}

TEST(CarPark, IsReadUncompressedAndCompressed) {
  const RangeRecording plain = read_park(small_car_park());
  check_small_park(plain);
  check_small_park(read_park(small_car_park(), MAT_COMPRESSION_ZLIB));
  EXPECT_TRUE(plain.landmarks.empty());
  EXPECT_HAS(all_notes(plain), "there is no beac_juan3.mat");
}

TEST(CarPark, HasItsSurveyedBeacons) {
  const Scratch scratch;
  write_mat(scratch / "data_set.mat", small_car_park());
  const auto read = [&](const Eigen::MatrixXd& beacons) {
    write_mat(scratch / "beac_juan3.mat", {{"estbeac", beacons}});
    return read_range_recording(scratch.folder(), "auto");
  };
  const RangeRecording recording = read(Eigen::Matrix<double, 3, 2>{{1, 2}, {-3.5, 4}, {5, 6}});
  ASSERT_EQ(recording.landmarks.size(), 3u);
  EXPECT_EQ(recording.landmarks[1].identity, 2);
  EXPECT_EQ(recording.landmarks[1].position, Eigen::Vector2d(-3.5, 4));
  EXPECT_HAS(recording.notes.front(), "detected format `acfr`");
  EXPECT_HAS(message_of([&] {
               read(row({1, 2, 3}));
             }),
             "beac_juan3.mat: `estbeac`: is 1x3, and must have two columns");
  EXPECT_HAS(message_of([&] { read(row({1, std::nan("")})); }), "`estbeac` 1: must be two finite numbers");
}

TEST(CarPark, IgnoresBeamsWithoutARange) {
  MatVariables park = small_car_park();
  park["Laser"](0, 0) = std::nan("");
  park["Laser"](0, 50) = std::nan("");  // no reflection
  const RangeRecording recording = read_park(park);
  EXPECT_EQ(recording.scans[0].detections.size(), 1u);
  EXPECT_HAS(all_notes(recording), "1 reflective beams without a range are skipped, the first at ");
  EXPECT_HAS(all_notes(recording), "data_set.mat: `Laser` 1");
}

TEST(CarPark, NamesAVariableThatIsMissingOrOfTheWrongSize) {
  MatVariables park = small_car_park();
  park["Lazer"] = park["Laser"];
  park.erase("Laser");
  const std::string text = message_of([&] { read_park(park); });
  EXPECT_HAS(text, "data_set.mat: there is no variable `Laser`; it has GPSLat, GPSLon, Index");
  EXPECT_HAS(text, "the nearest is `Lazer`");
  EXPECT_HAS(park_complaint("Laser", Eigen::MatrixXd::Zero(3, 181)), "`Laser`: is 3x181, and must be 3x361");
  EXPECT_HAS(park_complaint("Intensity", Eigen::MatrixXd::Zero(2, 361)),
             "`Intensity`: is 2x361, and must be 3x361");
  EXPECT_HAS(park_complaint("Steering", row({0, 0})), "`Steering`: has 2 numbers, `Time_VS` has 3");
  EXPECT_HAS(park_complaint("Index", row({1, 1})), "`Index`: has 2 numbers, `Time` has 8");
  EXPECT_HAS(park_complaint("Time", Eigen::MatrixXd::Zero(2, 4)), "`Time`: is 2x4, and must be one row");
}

TEST(CarPark, RefusesEventsOutOfRange) {
  const auto index = [](double value) { return row({1, 1, 1, 2, 2, 2, value, 3}); };
  EXPECT_HAS(park_complaint("Index", index(4)),
             "`Index` 7: must be a whole number from 1 to 3, the length of `Time_VS`");
  EXPECT_HAS(park_complaint("Index", index(0)), "and is 0");
  EXPECT_HAS(park_complaint("Index", index(2.5)), "and is 2.5");
  EXPECT_HAS(park_complaint("Index", index(1e300)), "and is 1e+300");
  EXPECT_HAS(park_complaint("Index", index(2)), "`Index` 7: names entry 2 of `Time_VS` after entry 2");
  EXPECT_HAS(
      park_complaint("TimeLaser", row({10.2, 10.45, 10.7})),
      "`Index` 5: `Time` of this event is 10.4 s, entry 2 of `TimeLaser` is of 10.45 s; they must agree");
  EXPECT_HAS(park_complaint("Sensor", row({2, 1, 3, 2, 4, 1, 2, 3})),
             "`Sensor` 5: must be 1 (GPS), 2 (wheels) or 3 (laser), and is 4");
}

TEST(CarPark, RefusesInvalidNumbers) {
  const double nan = std::nan("");
  EXPECT_HAS(park_complaint("Velocity", row({1, nan, 1})),
             "`Velocity` 2: must be a finite number, and is nan");
  EXPECT_HAS(park_complaint("GPSLat", row({1, INFINITY})), "`GPSLat` 2: must be a finite number, and is inf");
  EXPECT_HAS(park_complaint("Steering", row({1, 1, -20})), "`Time_VS` 3: the steering angle must be within");
  Eigen::MatrixXd intensity = small_car_park()["Intensity"];
  intensity(1, 6) = nan;
  EXPECT_HAS(park_complaint("Intensity", intensity), "`Intensity` 2: beam 7 must be a number, and is nan");
  MatVariables park = small_car_park();
  park["Time"](6) = park["Time_VS"](2) = 10.25;
  EXPECT_HAS(message_of([&] { read_park(park); }),
             "`Time_VS` 3: the times must not go backwards: 10.25 comes after 10.3");
}

/// The error message for a data_set.mat of these bytes.
std::string bytes_complaint(const std::string& bytes) {
  const Scratch scratch;
  scratch.write("data_set.mat", bytes);
  return message_of([&] { read_range_recording(scratch.folder(), "acfr"); });
}

TEST(CarPark, RefusesFilesThatAreNotMatFiles) {
  EXPECT_HAS(bytes_complaint(""),
             "data_set.mat: is not a MAT file of level 5; MATLAB and Octave write one with");
  EXPECT_HAS(bytes_complaint(std::string(1000, 'x')), "is not a MAT file of level 5");
  EXPECT_HAS(bytes_complaint("\x89HDF\r\n\x1a\n" + std::string(600, '\0')), "is not a MAT file of level 5");
  const Scratch scratch;
  EXPECT_HAS(message_of([&] { read_range_recording(scratch.folder(), "acfr"); }),
             "data_set.mat: cannot be read: No such");
}

TEST(CarPark, RefusesEveryTruncation) {
  for (const matio_compression compression : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
    const Scratch scratch;
    write_mat(scratch / "whole.mat", small_car_park(), compression);
    const std::string whole = contents(scratch / "whole.mat");
    for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 97)
      EXPECT_HAS(bytes_complaint(whole.substr(0, size)), "data_set.mat: ") << size;
    EXPECT_HAS(bytes_complaint(whole.substr(0, whole.size() - 1)),
               "is truncated in variable 12; copy it again");
  }
}

TEST(CarPark, RefusesVariablesOfAnotherType) {
  const Scratch scratch;
  const auto with = [&](matvar_t* variable) {
    mat_t* mat = Mat_CreateVer((scratch / "data_set.mat").c_str(), nullptr, MAT_FT_MAT5);
    EXPECT_EQ(Mat_VarWrite(mat, variable, MAT_COMPRESSION_NONE), 0);
    Mat_VarFree(variable);
    Mat_Close(mat);
    return message_of([&] { read_range_recording(scratch.folder(), "acfr"); });
  };
  std::size_t one[] = {1, 1}, deep[] = {1, 1, 2};
  double numbers[] = {1, 2};
  mat_complex_split_t split{numbers, numbers + 1};
  char text[] = "x";
  EXPECT_HAS(with(Mat_VarCreate("Time", MAT_C_CELL, MAT_T_CELL, 2, one, nullptr, 0)),
             "variable 1 `Time` is not a numeric matrix (class 1); save the file without it");
  EXPECT_HAS(with(Mat_VarCreate("Time", MAT_C_CHAR, MAT_T_UINT8, 2, one, text, 0)),
             "`Time` must be a matrix of real numbers");
  EXPECT_HAS(with(Mat_VarCreate("Time", MAT_C_DOUBLE, MAT_T_DOUBLE, 3, deep, numbers, 0)),
             "`Time` must be a matrix of real numbers");
  EXPECT_HAS(with(Mat_VarCreate("Time", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, one, &split, MAT_F_COMPLEX)),
             "`Time` must be a matrix of real numbers");
}

// MRCLAM

/// A folder of MRCLAM files of robot 2, valid except for what a test changes.
struct Mrclam {
  std::map<std::string, std::string> files = {
      {"Barcodes.dat", "# Subject # Barcode #\n  1 \t 5 \n  2 \t 14\n  6 \t 63\n  7 \t 25\n"},
      {"Landmark_Groundtruth.dat", "# Subject x y\n 6 1.5 -4 0.1 0.2\n 7 2 3 0.1 0.1\n"},
      {"Robot2_Odometry.dat", "# t v w\n100.5 \t 0.086 \t -0.398 \n100.7 0 0\n100.9 0.05 0.1\n"},
      {"Robot2_Measurement.dat",
       "# t c r b\n100.6 63 1.5 0.25\n100.6 25 2 -0.5\n100.65 5 1 0\n100.8 99 1 0\n"},
      {"Robot2_Groundtruth.dat", "# t x y a\n100.4 1 2 -1.75\n100.5 1 2 -1.5\n100.9 1 2 -1.5\n"}};

  Mrclam& with(const std::string& name, const std::string& text) {
    files[name] = text;
    return *this;
  }
  Mrclam& without(const std::string& name) {
    files.erase(name);
    return *this;
  }
  RangeRecording read(int robot = 2, const std::string& format = "auto") const {
    const Scratch scratch;
    for (const auto& [name, text] : files) scratch.write(name, text);
    return read_range_recording(scratch.folder(), format, robot);
  }
  std::string complaint(int robot = 2) const {
    return message_of([&] { read(robot); });
  }
};

TEST(Mrclam, IsReadAsASingleRobot) {
  const RangeRecording recording = Mrclam().read();
  EXPECT_EQ(recording.format, "mrclam");
  EXPECT_EQ(recording.vehicle, "differential-drive");
  ASSERT_EQ(recording.odometry.size(), 3u);
  EXPECT_EQ(recording.odometry[0].t, 100.5);
  EXPECT_EQ(recording.odometry[0].input, Eigen::Vector2d(0.086, -0.398));
  ASSERT_EQ(recording.scans.size(), 3u) << "measurements of one time are one scan";
  ASSERT_EQ(recording.scans[0].detections.size(), 2u);
  EXPECT_EQ(recording.scans[0].detections[0].identity, 6);
  EXPECT_EQ(recording.scans[0].detections[1].identity, 7);
  EXPECT_EQ(recording.scans[0].detections[1].range_m, 2);
  EXPECT_EQ(recording.scans[0].detections[1].bearing_rad, -0.5);
  EXPECT_TRUE(recording.scans[1].detections.empty()) << "it detected only another robot";
  ASSERT_EQ(recording.truth.size(), 3u);
  EXPECT_EQ(recording.truth[0].heading_rad, -1.75);
  ASSERT_EQ(recording.landmarks.size(), 2u);
  EXPECT_EQ(recording.landmarks[0].identity, 6);
  EXPECT_EQ(recording.landmarks[0].position, Eigen::Vector2d(1.5, -4));
  const std::string notes = all_notes(recording);
  EXPECT_HAS(notes, "detected format `mrclam`");
  EXPECT_HAS(notes, "1 measurements of other robots are omitted, the first at ");
  EXPECT_HAS(notes, "1 measurements of barcodes that are not in Barcodes.dat are skipped, the first at ");
  EXPECT_HAS(notes, "Robot2_Measurement.dat:5");
}

TEST(Mrclam, WorksWithoutTruthAndLandmarks) {
  const RangeRecording recording =
      Mrclam().without("Robot2_Groundtruth.dat").without("Landmark_Groundtruth.dat").read();
  EXPECT_TRUE(recording.truth.empty());
  EXPECT_TRUE(recording.landmarks.empty());
  EXPECT_HAS(all_notes(recording), "there is no Robot2_Groundtruth.dat: the truth is unknown");
  EXPECT_HAS(all_notes(recording), "there is no Landmark_Groundtruth.dat");
}

TEST(Mrclam, RefusesInvalidFiles) {
  EXPECT_HAS(Mrclam().complaint(6), "recording.robot = 6: must be 1 to 5");
  EXPECT_HAS(Mrclam().complaint(3), "Robot3_Odometry.dat: does not exist; there is odometry of robot 2");
  EXPECT_HAS(Mrclam().without("Robot2_Odometry.dat").complaint(), "there is no odometry of any robot");
  EXPECT_HAS(Mrclam().without("Robot2_Measurement.dat").complaint(),
             "Robot2_Measurement.dat: cannot be read");
  EXPECT_HAS(Mrclam().with("Barcodes.dat", "# none\n").complaint(), "Barcodes.dat: lists no barcodes");
  EXPECT_HAS(Mrclam().with("Barcodes.dat", "6 5\n7 5\n").complaint(),
             "Barcodes.dat:2: barcode 5 is already that of subject 6");
  EXPECT_HAS(Mrclam().with("Barcodes.dat", "6 5.5\n").complaint(),
             "Barcodes.dat:1: column 2 must be a whole number from 0, and is `5.5`");
  EXPECT_HAS(Mrclam().with("Robot2_Odometry.dat", "# none\n").complaint(), "there is no odometry");
  EXPECT_HAS(Mrclam().with("Robot2_Measurement.dat", "# none\n").complaint(), "there are no scans");
  EXPECT_HAS(Mrclam().with("Robot2_Odometry.dat", "1 0 0\n0 0 0\n").complaint(),
             "Robot2_Odometry.dat:2: the times must not go backwards");
  EXPECT_HAS(Mrclam().with("Robot2_Odometry.dat", "1 nan 0\n").complaint(),
             "Robot2_Odometry.dat:1: column 2 must be a number, and is `nan`");
  EXPECT_HAS(Mrclam().with("Robot2_Measurement.dat", "100.6 63 1\n").complaint(),
             "Robot2_Measurement.dat:1: has 3 columns, column 4 is required");
  EXPECT_HAS(Mrclam().with("Robot2_Groundtruth.dat", "2 0 0 0\n1 0 0 0\n").complaint(),
             "Robot2_Groundtruth.dat:2: the times must not go backwards");
  EXPECT_HAS(Mrclam().with("Landmark_Groundtruth.dat", "6 0 0\n6 1 1\n").complaint(),
             "Landmark_Groundtruth.dat:2: there is already a landmark 6");
  EXPECT_HAS(Mrclam().with("Robot2_Measurement.dat", "1 63 1 0\n").complaint(), "do not overlap in time");
}

// The published recordings, if present

/// Scans of the first seconds after the first message of any sensor.
struct Beginning {
  std::size_t scans = 0, seeing = 0, detections = 0, most = 0;
};

Beginning beginning_of(const RangeRecording& recording, double duration_s) {
  const double first =
      std::min({recording.odometry.front().t, recording.scans.front().t, recording.truth.front().t});
  Beginning beginning;
  for (const RangeRecording::Scan& scan : recording.scans) {
    if (scan.t - first > duration_s) continue;
    ++beginning.scans;
    beginning.seeing += scan.detections.empty() ? 0 : 1;
    beginning.detections += scan.detections.size();
    beginning.most = std::max(beginning.most, scan.detections.size());
  }
  return beginning;
}

std::filesystem::path published(const std::string& folder) {
  try {
    return find_data(folder, "", "test");
  } catch (const InputError& error) {
    std::printf("%s\n", error.what());
    return {};
  }
}

TEST(PublishedRecordings, AreNamedWhereTheyAreMissing) {
  const auto complaint = [](const char* path) { return message_of([&] { find_data(path, "", "x"); }); };
  EXPECT_HAS(complaint("acfr_car_park/none"), "github.com/yuzehai1995/hwork_SLAM");
  EXPECT_HAS(complaint("mrclam/none"), "asrl.utias.utoronto.ca/datasets/mrclam");
}

TEST(PublishedCarPark, HasTheNumberOfDetectionsInTheLiterature) {
  const std::filesystem::path folder = published("acfr_car_park");
  if (folder.empty()) GTEST_SKIP() << "the recording is missing";
  const RangeRecording recording = read_range_recording(folder, "auto");
  EXPECT_EQ(recording.odometry.size(), 5001u);
  EXPECT_EQ(recording.truth.size(), 626u);
  EXPECT_EQ(recording.scans.size(), 586u);
  EXPECT_EQ(recording.landmarks.size(), 15u);
  const Beginning beginning = beginning_of(recording, 112);
  EXPECT_EQ(beginning.scans, 524u);
  EXPECT_EQ(beginning.detections, 830u);
  EXPECT_EQ(beginning.seeing, 462u);
  EXPECT_EQ(beginning.most, 4u);
}

TEST(PublishedMrclam, IsReadForEveryRobot) {
  const std::filesystem::path folder = published("mrclam/MRCLAM_Dataset7");
  if (folder.empty()) GTEST_SKIP() << "the recording is missing";
  const std::size_t odometry[] = {58598, 60936, 55085, 62207, 59787};
  const std::size_t detections[] = {2578, 3818, 4425, 1822, 3424};
  for (int robot = 1; robot <= 5; ++robot) {
    const RangeRecording recording = read_range_recording(folder, "auto", robot);
    EXPECT_EQ(recording.odometry.size(), odometry[robot - 1]);
    EXPECT_EQ(beginning_of(recording, 1e9).detections, detections[robot - 1]);
    EXPECT_EQ(recording.landmarks.size(), 15u);
  }
}

}  // namespace
}  // namespace incognita
