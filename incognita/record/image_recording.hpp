// Writes the images of a run, with the true poses, as a recording in TUM layout.
#pragma once

#include <filesystem>

#include "incognita/record/files/row_file.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// Writes `recording/` in a run directory: `rgb/frame-000123.png`, 8-bit gray as the estimator got it, `rgb.txt` with the
/// time of each, and `groundtruth.txt` with the true poses of the first body where they are known. Frames without an image
/// are skipped.
class ImageRecording {
 public:
  /// Throws RecordError if a folder or file cannot be created.
  explicit ImageRecording(const std::filesystem::path& run_directory);

  /// Throws RecordError if the image or its time cannot be written; no partial image is left, nor one without a time.
  void publish(const Snapshot& snapshot);

 private:
  std::filesystem::path folder_;
  RowFile times_, truth_;
};

}  // namespace incognita
