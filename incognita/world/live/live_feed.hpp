// A camera or a robot as clock, world and sensors of the loop: a tick is an image.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/world/live/live_source.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

struct LiveFeedSettings {
  double duration_s = 60;  ///< of the run, by the clock of the source
  double period_s = 0.1;   ///< expected, from image to image; of the ticks without images
  /// After which an image is late, more than the period: ticks then go on without, so that the loop notices: the estimator gets
  /// lost, and the controller stops. None: the loop waits, as is right for a camera in a hand, and so that a replay is the same.
  std::optional<double> late_s = {};
  double give_up_s = 60;  ///< without an image for so long, the run fails
};

/// What clock and sensors share.
class LiveFeed {
 public:
  /// `now_s`: a clock that does not jump. Throws std::invalid_argument for times that are not positive.
  LiveFeed(const LiveFeedSettings& settings, std::shared_ptr<LiveSource> source,
           std::function<double()> now_s);

  /// Asked while waiting: whether the run is to end.
  void end_when(std::function<bool()> is_over) { is_over_ = std::move(is_over); }
  /// Receives what happens to the source.
  void report_to(std::function<void(const std::string&)> report) { report_ = std::move(report); }

  /// Waits for the next tick. Empty after the duration, when the source has ended, or when the run is to end. Throws
  /// std::runtime_error if no image came for give_up_s.
  Tick next();
  /// What was measured for the last tick: nothing where images are late.
  BodyObservation observation() const;
  /// What a resumed run goes on from: its images are later than those before, whatever the clock of the source.
  void state(StateArchive& archive);
  /// For the summary of a run: those of the source, and images whose stamps were not later than the last tick.
  std::vector<std::pair<std::string, std::int64_t>> counts() const;

 private:
  void keep_odometry(const std::vector<Odometry>& readings);
  std::vector<Odometry> take_odometry(double t);
  void move_after_saved_run(LiveReading& reading);
  std::optional<Tick> tick_of(LiveReading reading, double now_s);
  std::optional<Tick> tick_without_image(double now_s);
  Tick next_tick(double t);
  double time_to_wait(double now_s) const;
  void report_events();
  void check_patience(double now_s) const;

  LiveFeedSettings settings_;
  std::shared_ptr<LiveSource> source_;
  std::function<double()> now_s_;
  std::function<bool()> is_over_ = [] { return false; };
  std::function<void(const std::string&)> report_ = [](const std::string&) {};

  std::int64_t frame_ = 0, unused_ = 0;
  double began_s_;  ///< on the clock of now_s, like the next two
  std::optional<double> last_image_s_, last_tick_s_;
  std::optional<double> first_t_, last_t_;  ///< of ticks, on the clock of the source
  std::optional<double> last_image_t_;
  std::optional<LiveReading> reading_;  ///< of the last tick
  std::vector<Odometry> odometry_;      ///< later than the last tick
  bool went_back_ = false;              ///< the stamps of the last images
  bool is_complete_ = false;            ///< an image came from after the duration
  bool is_first_again_ = false;         ///< the image is the first of a resumed run
  bool resumed_ = false;                ///< no image has come since
  double shift_s_ = 0;                  ///< added to the times of the source, since it is resumed
};

class LiveClock final : public Clock {
 public:
  explicit LiveClock(std::shared_ptr<LiveFeed> feed) : feed_(std::move(feed)) {}
  Tick next() override { return feed_->next(); }
  std::int64_t expected_frames() const override { return 0; }
  void state(StateArchive& archive) override { feed_->state(archive); }

 private:
  std::shared_ptr<LiveFeed> feed_;
};

/// A person or a controller moves the body; the truth is unknown.
class LiveWorld final : public World {
 public:
  std::optional<Truth> move(const Command&, const Tick&) override { return std::nullopt; }
  void state(StateArchive&) override {}  // it has none
};

class LiveSensors final : public Sensor {
 public:
  explicit LiveSensors(std::shared_ptr<LiveFeed> feed) : feed_(std::move(feed)) {}
  Observation measure(const std::optional<Truth>&, const Tick&) override { return {{feed_->observation()}}; }
  void state(StateArchive&) override {}  // that of the clock

 private:
  std::shared_ptr<LiveFeed> feed_;
};

}  // namespace incognita
