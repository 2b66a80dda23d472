// Recordings: images with time stamps and, if known, true camera poses.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "incognita/io/recordings/euroc_camera.hpp"
#include "incognita/io/recordings/indexed_images.hpp"
#include "incognita/io/scenario/load_scenario.hpp"

namespace incognita {

/// Topics of a bag; empty: guessed, and said in the notes.
struct BagTopics {
  std::string images, truth;
};

struct RecordedPose {
  double t = 0;                                   ///< s, on the clock of the images
  Eigen::Vector3d position{0, 0, 0};              ///< m, in the world frame of the recording
  Eigen::Vector4d world_from_camera{1, 0, 0, 0};  ///< w, x, y, z; optical axes unless noted
};

struct Recording {
  struct RecordedFrame {
    double t = 0;                 ///< s, increasing
    std::filesystem::path image;  ///< its file; empty where one file holds all images
  };
  std::string format;                      ///< `images`, `tum`, `euroc`, `kitti`, `video` or `bag`
  std::filesystem::path folder;            ///< or the file that holds all images
  std::vector<RecordedFrame> frames;       ///< at least one
  std::vector<RecordedPose> truth;         ///< in time order; empty if unknown
  std::vector<std::string> notes;          ///< assumptions and ignored data, for printing
  std::optional<CalibratedCamera> camera;  ///< set if the recording contains its calibration
  bool whole_us = false;                   ///< all times are whole microseconds: with_rounded_stamps()
  std::shared_ptr<IndexedImages> images = nullptr;  ///< set by read_recording(); frame k is image k
};

/// The recording with all stamps rounded to whole microseconds, so that its estimate depends neither on their digits nor on
/// their origin. Times of images without stamps, which follow from a rate, stay as they are.
Recording with_rounded_stamps(Recording recording);

/// `path` is a folder, or the file of a video or of a bag. `format` is `auto` or one of Recording::format; `rate_hz` is used for images
/// without time stamps. `pattern` selects images by name as in a shell; empty: all. Throws InputError naming file and line.
Recording read_recording(const std::filesystem::path& path, const std::string& format, double rate_hz,
                         const std::string& pattern = "", const BagTopics& topics = {});

/// The recording named by a scenario, searched under the data folder, with the true poses that the scenario names.
Recording read_recording(const LoadedScenario& loaded);

}  // namespace incognita
