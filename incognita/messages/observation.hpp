// All that the robot can know at one tick: what its sensors gave.
#pragma once

#include <memory>

#include "incognita/vision/image.hpp"

namespace incognita {

struct Observation {
  std::shared_ptr<const Image>
      image;  ///< immutable, shared with the record; null when the camera gave nothing
};

}  // namespace incognita
