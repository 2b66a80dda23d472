// The final map of a run as a table and as a point cloud.
#pragma once

#include <filesystem>
#include <vector>

#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/record/summary/map_survey.hpp"

namespace incognita {

/// Columns `id,kind,x,y,z,pxx,pxy,pxz,pyy,pyz,pzz,detections` (m, m^2). All writers here throw RecordError and
/// leave no partial file.
void write_map_csv(const std::filesystem::path& path, const std::vector<SnapshotLandmark>& landmarks);

/// Columns `id,x,y,z` (m) of the surveyed landmarks.
void write_survey_csv(const std::filesystem::path& path, const std::vector<SurveyedLandmark>& landmarks);

/// ASCII PLY: landmarks gray, lighter for a smaller covariance; anchors orange.
void write_map_ply(const std::filesystem::path& path, const std::vector<SnapshotLandmark>& landmarks);

}  // namespace incognita
