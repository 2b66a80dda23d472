// The matches of a run directory, for `incognita adjust`.
#pragma once

#include <filesystem>
#include <vector>

#include "incognita/analysis/evaluation/trajectory.hpp"
#include "incognita/slam/bundle/run_bundle.hpp"

namespace incognita {

struct RecordedMatches {
  Trajectory estimate;            ///< all poses of the run
  std::vector<std::size_t> view;  ///< of each view its pose in `estimate`
  RunMatches matches;
};

/// Of the run of one camera that is its own body: estimate.tum, measurements.csv, map.csv. Poses with at least 4 matches are views, at
/// most `most_views` of them, evenly spaced; map.csv is read if anchors are matched. Throws InputError naming file and reason for other runs, damaged tables and runs
/// with fewer than 2 such poses.
RecordedMatches read_matches(const std::filesystem::path& run, std::size_t most_views);

/// Number of landmarks that two successive views have in common, where they are fewest.
std::size_t least_shared(const RunMatches& matches);

}  // namespace incognita
