// Where the measurements of a run come from while it goes on: a camera, or a robot.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/messages/observation.hpp"

namespace incognita {

/// An image and the odometry that came with it, as the source stamped them.
struct LiveReading {
  double t = 0;  ///< s, of the image, on the clock of the source, in whole microseconds
  std::shared_ptr<const Image> image;
  std::vector<Odometry> odometry = {};  ///< all that came since the last reading, in any order
};

class LiveSource {
 public:
  virtual ~LiveSource() = default;
  /// The newest image that has not been returned; waits for it. Nothing if none comes in time. Throws std::runtime_error,
  /// with the remedy, once none can come any more.
  virtual std::optional<LiveReading> read(double wait_s) = 0;
  /// Whether the source has ended as it should: a video that is played to its end.
  virtual bool has_ended() const { return false; }
  /// Why nothing comes, and the remedy; empty if nothing is known to be wrong.
  virtual std::string problem() const = 0;
  /// What happened since the last call, for printing.
  virtual std::vector<std::string> take_events() { return {}; }
  /// For the summary of a run: name and number.
  virtual std::vector<std::pair<std::string, std::int64_t>> counts() const { return {}; }
};

}  // namespace incognita
