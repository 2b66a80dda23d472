// The map at the end of a run, as a table and as a point cloud.
#pragma once

#include <filesystem>
#include <vector>

#include "incognita/record/snapshot/snapshot.hpp"
#include "incognita/record/summary/map_survey.hpp"

namespace incognita {

/// `id,kind,x,y,z,pxx,pxy,pxz,pyy,pyz,pzz,sightings`. Throws RecordError, leaving no half file; so does the
/// next.
void write_map_csv(const std::filesystem::path& path, const std::vector<SnapshotLandmark>& landmarks);

/// `id,x,y,z` of surveyed landmarks; throws likewise.
void write_survey_csv(const std::filesystem::path& path, const std::vector<SurveyedLandmark>& landmarks);

/// ASCII PLY: landmarks grey, the lighter the better known; anchors orange.
void write_map_ply(const std::filesystem::path& path, const std::vector<SnapshotLandmark>& landmarks);

}  // namespace incognita
