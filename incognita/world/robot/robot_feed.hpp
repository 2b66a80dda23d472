// A robot as clock, world and sensors of the loop. A tick is an image; while images are late, ticks go on without, so that the loop
// notices: the estimator gets lost, the controller stops, and everything is recorded.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/world/robot/robot_link.hpp"
#include "incognita/world/world.hpp"

namespace incognita {

struct RobotFeedSettings {
  double duration_s = 60;  ///< of the run, by the robot's clock
  double period_s = 0.1;   ///< expected, from image to image; of the ticks without images
  double late_s = 0.3;     ///< after which an image is late; more than the period
  double give_up_s = 60;   ///< without an image for so long, the run fails
};

/// What clock and sensors of a robot share.
class RobotFeed {
 public:
  /// `now_s`: a clock that does not jump. Throws std::invalid_argument for times that are not positive.
  RobotFeed(const RobotFeedSettings& settings, std::shared_ptr<RobotLink> link,
            std::function<double()> now_s);

  /// Asked while waiting: whether the run is to end.
  void end_when(std::function<bool()> is_over) { is_over_ = std::move(is_over); }
  /// Receives what happens to the link.
  void report_to(std::function<void(const std::string&)> report) { report_ = std::move(report); }

  /// Waits for the next tick. Empty after the duration, or when the run is to end. Throws std::runtime_error if no image came
  /// for give_up_s.
  Tick next();
  /// What was measured for the last tick: nothing where images are late.
  BodyObservation observation() const;
  const std::shared_ptr<RobotLink>& link() const { return link_; }
  /// For the summary of a run: those of the link, and images whose stamps were not later than the last tick.
  std::vector<std::pair<std::string, std::int64_t>> counts() const;

 private:
  void keep_odometry(const std::vector<Odometry>& readings);
  std::vector<Odometry> take_odometry(double t);
  std::optional<Tick> tick_of(RobotReading reading, double now_s);
  std::optional<Tick> tick_without_image(double now_s);
  Tick next_tick(double t);
  double time_to_wait(double now_s) const;
  void report_events();
  void check_patience(double now_s) const;

  RobotFeedSettings settings_;
  std::shared_ptr<RobotLink> link_;
  std::function<double()> now_s_;
  std::function<bool()> is_over_ = [] { return false; };
  std::function<void(const std::string&)> report_ = [](const std::string&) {};

  std::int64_t frame_ = 0, unused_ = 0;
  double began_s_;  ///< on the clock of now_s, like the next two
  std::optional<double> last_image_s_, last_tick_s_;
  std::optional<double> first_t_, last_t_;  ///< of ticks, on the robot's clock
  std::optional<double> last_image_t_;
  std::optional<RobotReading> reading_;  ///< of the last tick
  std::vector<Odometry> odometry_;       ///< later than the last tick
};

class RobotClock final : public Clock {
 public:
  explicit RobotClock(std::shared_ptr<RobotFeed> feed) : feed_(std::move(feed)) {}
  Tick next() override { return feed_->next(); }
  std::int64_t expected_frames() const override { return 0; }

 private:
  std::shared_ptr<RobotFeed> feed_;
};

/// The controller drives the robot as soon as it has decided; the truth is unknown.
class RobotWorld final : public World {
 public:
  std::optional<Truth> move(const Command&, const Tick&) override { return std::nullopt; }
};

class RobotSensors final : public Sensor {
 public:
  explicit RobotSensors(std::shared_ptr<RobotFeed> feed) : feed_(std::move(feed)) {}
  Observation measure(const std::optional<Truth>&, const Tick&) override { return {{feed_->observation()}}; }

 private:
  std::shared_ptr<RobotFeed> feed_;
};

}  // namespace incognita
