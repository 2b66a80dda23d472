// Settings of a camera that is used while it takes its images.
#pragma once

#include <string>

#include "incognita/math/setting.hpp"

namespace incognita {

struct LiveSettings {
  /// `source` of the camera of a device that has the page open.
  static constexpr const char* browser = "browser";

  std::string source = browser;
  double give_up_s = 60;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = LiveSettings;
    setting(
        &S::source, "source", "", any(),
        "Camera: `browser`, that of a device which has the page open, as by `run hand --view`; a device, e.g. "
        "`/dev/video0`; the address of a stream, e.g. `rtsp://...`; or a video, in real time");
    setting(&S::give_up_s, "give_up_s", "s", above_up_to(0, 1e6),
            "Time without an image after which the run fails");
  }
};

}  // namespace incognita
