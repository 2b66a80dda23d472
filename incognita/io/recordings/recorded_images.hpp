// Recorded images as parts of the loop: their times, the camera, and the truth where it is known.
#pragma once

#include <memory>
#include <vector>

#include "incognita/io/recordings/recording.hpp"
#include "incognita/world/replay/replay.hpp"
#include "incognita/world/sensor_set.hpp"

namespace incognita {

using SharedRecording = std::shared_ptr<const Recording>;

/// Time stamps of the images, s, until the recording ends or `duration_s` after its first.
std::vector<double> frame_times(const Recording& recording, double duration_s);

/// The recorded pose nearest in time within 20 ms, the association rule of the TUM benchmark tools. Velocities are
/// finite differences of the neighboring poses.
RecordedTruth recorded_truth(SharedRecording recording);

/// Image k at tick k.
class RecordedImages final : public BodySensor {
 public:
  /// Reads the first image: throws InputError naming it, and both sizes if it does not have the camera's size.
  RecordedImages(SharedRecording recording, int width_px, int height_px);

  /// Throws RecordError naming file and frame if an image is missing, damaged or of another size.
  void measure(const std::optional<Truth>& truth, std::size_t which, const Tick& tick,
               BodyObservation& observation) override;
  void state(StateArchive&) override {}  // it has none

 private:
  std::shared_ptr<const Image> read(std::int64_t frame) const;

  SharedRecording recording_;
  int width_px_, height_px_;
  std::shared_ptr<const Image> first_;
};

}  // namespace incognita
