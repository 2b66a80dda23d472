// A camera as its calibration file describes it.
#pragma once

#include <filesystem>
#include <string>

#include "incognita/io/scenario/scenario.hpp"

namespace incognita {

struct CalibratedCamera {
  std::filesystem::path file;
  CameraSettings camera;  ///< valid if `unfit` is empty
  std::string unfit;      ///< why no camera model of this program fits
};

}  // namespace incognita
