// What really happens. It goes to the sensors and to the record, never to the estimator.
#pragma once

#include "incognita/models/free_camera.hpp"

namespace incognita {

struct Truth {
  FreeCameraMotion::State<double> camera = FreeCameraMotion::State<double>::Zero();  ///< (5.24), world z up
  bool orientation_known = true;  ///< GPS tells a position alone
};

}  // namespace incognita
