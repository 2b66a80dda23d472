// What the program saw and thought, drawn on each frame, for people.
#pragma once

#include <filesystem>

#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Writes `frames/frame-000123.png` in a run directory: the image, and on it each look's 3-sigma search
/// ellipse in the colour of its outcome (green matched, red not found, magenta inconsistent, grey not tried;
/// thin when its depth is not known yet), the matched patch as a square, its id, and below the tracking state
/// and the action in force. Frames without an image give no picture.
class FramePictures {
 public:
  /// Throws RecordError when the folder cannot be made.
  FramePictures(const std::filesystem::path& run_directory, int patch_size_px);

  /// Throws RecordError when the picture cannot be written; no half file is left.
  void publish(const Snapshot& snapshot);

 private:
  std::filesystem::path folder_;
  int patch_size_px_;
};

}  // namespace incognita
