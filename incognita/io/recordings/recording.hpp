// Recordings: where their images are, when each was taken and, if that is known, where the camera then was.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "incognita/io/recordings/euroc_camera.hpp"
#include "incognita/io/scenario/load_scenario.hpp"

namespace incognita {

struct RecordedPose {
  double t = 0;                       ///< s, on the images' clock
  Eigen::Vector3d position{0, 0, 0};  ///< m, in the recording's own world
  Eigen::Vector4d world_from_camera{1, 0, 0,
                                    0};  ///< w, x, y, z; of the optical axes unless a note says otherwise
};

struct Recording {
  struct RecordedFrame {
    double t = 0;  ///< s, increasing
    std::filesystem::path image;
  };
  std::string format;  ///< `images`, `tum` or `euroc`
  std::filesystem::path folder;
  std::vector<RecordedFrame> frames;       ///< one at least
  std::vector<RecordedPose> truth;         ///< in time order; empty where the truth is unknown
  std::vector<std::string> notes;          ///< what was guessed or left out, for printing
  std::optional<CalibratedCamera> camera;  ///< where the recording has its calibration
};

/// `format` is `auto`, `images`, `tum` or `euroc`; `rate_hz` gives images without stamps their times.
/// `pattern` chooses among images by their names, as a shell does; empty: all. Throws InputError naming file
/// and line.
Recording read_recording(const std::filesystem::path& folder, const std::string& format, double rate_hz,
                         const std::string& pattern = "");

/// The recording that a scenario names, found under the data folder.
Recording read_recording(const LoadedScenario& loaded);

}  // namespace incognita
