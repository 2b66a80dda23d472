// The true poses of the camera of a bag.
#pragma once

#include <string>
#include <vector>

#include "incognita/io/recordings/bags/bag_contents.hpp"
#include "incognita/io/recordings/recording.hpp"

namespace incognita {

struct BagTruth {
  std::vector<RecordedPose> poses;  ///< in time order; empty if unknown
  std::vector<std::string> notes;   ///< whose poses they are, in which frame, and what was not used
};

/// Poses of the topic that was chosen, re-expressed for the camera by TF where it states how; without such a topic the pose of
/// the camera at the times of its images in the root of its frames, if that root is a world and no odometry is between, or
/// if the user named TF. `by_recorder`: times are those of the recorder. `frames`: times of the images, ns.
BagTruth truth_of_bag(BagContents contents, const ChosenTopics& topics,
                      const std::vector<std::int64_t>& frames, bool by_recorder);

}  // namespace incognita
