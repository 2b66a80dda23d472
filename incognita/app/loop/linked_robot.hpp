// A robot that is reached by rosbridge, as the loop sees it: images are decoded and compared with the camera of the scenario.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "incognita/io/scenario/scenario.hpp"
#include "incognita/live/robot/robot_client.hpp"
#include "incognita/world/live/robot_link.hpp"

namespace incognita {

/// The link that [robot] of a scenario describes.
RobotClientSettings robot_client_settings(const Scenario& scenario);

class LinkedRobot final : public RobotLink {
 public:
  /// Connects at the first read(): before, nothing is sent. Throws InputError for an address that is not valid.
  explicit LinkedRobot(const Scenario& scenario);

  /// Throws std::runtime_error if the images do not have the size of the camera. One that cannot be decoded is skipped and said.
  std::optional<LiveReading> read(double wait_s) override;
  void drive(const Eigen::Vector2d& velocity) override;
  void set_stopped(bool stopped) override;
  bool is_stopped() const override;
  std::string problem() const override;
  std::vector<std::string> take_events() override;
  std::vector<std::pair<std::string, std::int64_t>> counts() const override;

 private:
  void keep(const std::vector<RobotClient::ReceivedOdometry>& readings);
  std::shared_ptr<const Image> decoded(const ros::CompressedImage& image);
  void compare_camera();

  RobotClientSettings settings_;
  CameraSettings camera_;
  std::vector<std::string> events_;
  std::int64_t undecoded_ = 0;
  std::vector<Odometry> odometry_;  ///< of images that could not be decoded, for the next
  bool compared_ = false;

  mutable std::mutex mutex_;  ///< of what follows
  bool stopped_ = false;
  std::unique_ptr<RobotClient> client_;
};

/// What of a camera info differs from the camera of a scenario by more than 1 %, one line each.
std::vector<std::string> differences(const ros::CameraInfo& info, const CameraSettings& camera);

}  // namespace incognita
