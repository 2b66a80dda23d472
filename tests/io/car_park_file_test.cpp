// The MAT file of the car park, valid and invalid.
#include "incognita/io/recordings/range_recording.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/io/mat_writer.hpp"
#include "tests/io/notes.hpp"
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

using std::numbers::pi;

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

}  // namespace
}  // namespace incognita
