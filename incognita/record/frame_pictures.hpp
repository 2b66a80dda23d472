// Draws the measurements and the decision of each frame onto its image, for visual inspection.
#pragma once

#include <filesystem>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Writes `frames/frame-000123.png` in a run directory: the image with the 3-sigma search ellipse of each
/// feature match in the color of its outcome (see outcome_color(); thin while the depth is not converged),
/// the matched patch as a square, its id, and below the image the tracking state and the current action.
/// Frames without an image are skipped.
class FramePictures {
 public:
  /// Throws RecordError if the folder cannot be created.
  FramePictures(const std::filesystem::path& run_directory, int patch_size_px);

  /// Throws RecordError if the picture cannot be written; no partial file is left.
  void publish(const Snapshot& snapshot);

 private:
  std::filesystem::path folder_;
  int patch_size_px_;
};

}  // namespace incognita
