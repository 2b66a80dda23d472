// One reader per format of range-bearing recordings; range_recording.hpp selects one.
#pragma once

#include <filesystem>
#include <vector>

#include "incognita/world/replay/range_recording.hpp"

namespace incognita {

/// The ACFR car park: data_set.mat and, if present, the surveyed beacons of beac_juan3.mat.
RangeRecording read_acfr(const std::filesystem::path& folder);
bool looks_like_acfr(const std::filesystem::path& folder);

/// UTIAS MRCLAM: Barcodes.dat, RobotN_Odometry.dat, RobotN_Measurement.dat and, if present,
/// RobotN_Groundtruth.dat and Landmark_Groundtruth.dat.
RangeRecording read_mrclam(const std::filesystem::path& folder, int robot);
/// All robots with an odometry file, in the order of their numbers, including their measurements of each other.
std::vector<RangeRecording> read_mrclam_team(const std::filesystem::path& folder);
bool looks_like_mrclam(const std::filesystem::path& folder);

/// odometry.csv, detections.csv and, if present, truth.csv, fixes.csv and landmarks.csv.
RangeRecording read_range_tables(const std::filesystem::path& folder);
bool looks_like_range_tables(const std::filesystem::path& folder);

}  // namespace incognita
