// The image front end of the thesis (Appendix C): twelve features in boxes drawn at random, which begin as lines with 100
// hypotheses of the depth from 0.5 to 5 m (C.3), are found at one scale and corrected by the filter alone, with white noise.
// The scenarios have our defaults, so what is compared with the thesis sets these.
#pragma once

#include <string>

#include "experiments/exploring_run.hpp"

namespace incognita::exploring {

/// Features begin as lines with hypotheses of the depth, Appendix C.3.
inline Sets depth_lines() {
  return {"landmark_initialization.method=depth-line", "landmark_initialization.particles=100",
          "landmark_initialization.min_depth_m=0.5", "landmark_initialization.max_depth_m=5",
          "landmark_initialization.depth_ratio=0.3"};
}

/// Ours: features are in the map at once.
inline Sets inverse_depths() {
  return {"landmark_initialization.method=inverse-depth", "landmark_initialization.scale_prior_to_view=never",
          "landmark_initialization.second_order=false"};
}

/// `sigma_pixel_px`: of the measurements.
inline Sets thesis_features(const std::string& sigma_pixel_px, const Sets& initialization = depth_lines()) {
  Sets sets{"sensor.sigma_pixel_px=" + sigma_pixel_px,
            "sensor.adapt_sigma_pixel=false",
            "search.max_measurements=12",
            "search.levels=1",
            "search.align_images=false",
            "landmark_initialization.selection=random-box",
            "landmark_initialization.max_new_per_frame=1",
            "landmark_initialization.min_corner_strength=30",
            "map.wanted_visible=12",
            "map.max_landmarks=200",
            "map.replace_when_full=false",
            "map.memory_attempts=0",
            "bundle.adjust=false"};
  sets.insert(sets.end(), initialization.begin(), initialization.end());
  return sets;
}

/// The same, and the metric as printed: all that would be in view counts. The scenarios have our variant.
inline Sets as_printed_on_images(const std::string& sigma_pixel_px,
                                 const Sets& initialization = depth_lines()) {
  Sets sets = thesis_features(sigma_pixel_px, initialization);
  sets.push_back("exploration.counted=all");
  return sets;
}

}  // namespace incognita::exploring
