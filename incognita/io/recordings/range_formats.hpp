// One reader per layout of range-bearing recordings; range_recording.hpp chooses.
#pragma once

#include <filesystem>
#include <vector>

#include "incognita/world/replay/range_recording.hpp"

namespace incognita {

/// The car park of the ACFR: data_set.mat and, if there, the surveyed beacons of beac_juan3.mat.
RangeRecording read_acfr(const std::filesystem::path& folder);
bool looks_like_acfr(const std::filesystem::path& folder);

/// UTIAS MRCLAM: Barcodes.dat, RobotN_Odometry.dat, RobotN_Measurement.dat and, if there,
/// RobotN_Groundtruth.dat and Landmark_Groundtruth.dat.
RangeRecording read_mrclam(const std::filesystem::path& folder, int robot);
/// All the robots whose odometry is there, in the order of their numbers; they see each other.
std::vector<RangeRecording> read_mrclam_team(const std::filesystem::path& folder);
bool looks_like_mrclam(const std::filesystem::path& folder);

/// odometry.csv, detections.csv and, if there, truth.csv, fixes.csv and landmarks.csv.
RangeRecording read_range_tables(const std::filesystem::path& folder);
bool looks_like_range_tables(const std::filesystem::path& folder);

}  // namespace incognita
