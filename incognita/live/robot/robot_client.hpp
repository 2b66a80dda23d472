// Navigation's end of the link to a robot: images and odometry come in, velocity commands go out. In a thread of its own; nothing
// here waits for the robot but receive().
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/live/mailbox.hpp"
#include "incognita/live/robot/ros_messages.hpp"
#include "incognita/live/robot/rosbridge_client.hpp"

namespace incognita {

struct RobotTopics {
  std::string image = "/camera/image_raw/compressed";
  std::string camera_info = "/camera/camera_info";  ///< empty: not compared
  std::string odometry = "/odom";                   ///< empty: none
  std::string command = "/cmd_vel";
  std::string stop = "/stop";  ///< std_msgs/Bool, true while stopped by hand; empty: none
};

struct RobotClientSettings {
  std::string address = "ws://localhost:9090";
  RobotTopics topics;
  int ros = 2;                    ///< generation, 1 or 2
  bool stamps_commands = false;   ///< TwistStamped instead of Twist
  double command_period_s = 0.1;  ///< of the heartbeat: a command goes out at least so often
  double late_s = 0.3;            ///< after which a velocity that is not renewed becomes zero
};

class RobotClient {
 public:
  struct ReceivedOdometry {
    std::int64_t stamp_ns = 0;
    Eigen::Vector2d velocity{0, 0};  ///< speed, m/s, and turn rate, rad/s, to the left
  };
  struct Received {
    ros::CompressedImage image;                   ///< the newest
    std::vector<ReceivedOdometry> odometry = {};  ///< all since the last call, in the order of arrival
  };
  struct Counts {
    std::uint64_t images = 0, dropped_images = 0, connections = 0;
  };

  /// Throws InputError for an address that is not valid.
  explicit RobotClient(const RobotClientSettings& settings);
  /// Stops the robot, if it can still be reached.
  ~RobotClient();

  /// The newest image that has not been returned, which is waited for; older ones are dropped and counted. Nothing if none
  /// comes in time.
  std::optional<Received> receive(double wait_s);
  /// Sends the velocity at once and as the heartbeat, until the next one or until late_s have passed. Zero while stopped.
  void drive(const Eigen::Vector2d& velocity);
  /// Sends zero at once, and nothing else until it is false again. From any thread.
  void set_stopped(bool stopped);
  bool is_stopped() const;

  /// What happened since the last call, for printing.
  std::vector<std::string> take_events();
  /// The last camera info that came.
  std::optional<ros::CameraInfo> camera_info() const;
  Counts counts() const;
  /// Why nothing comes; empty if there is a connection.
  std::string problem() const { return client_.problem(); }

 private:
  using Clock = std::chrono::steady_clock;
  RosbridgeClientHandlers handlers();
  void subscribe();
  void publish_stop(bool stopped);  ///< with `mutex_` held
  void take(const rosbridge::Publish& publish);
  void take_image(const rosbridge::Publish& publish);
  void take_odometry(const rosbridge::Publish& publish);
  void note(const std::string& event);
  void send_velocity();  ///< with `mutex_` held, so that commands leave in the order of their causes
  std::optional<std::int64_t> robot_time_ns() const;

  RobotClientSettings settings_;
  Mailbox<ros::CompressedImage> images_{1};
  Mailbox<ReceivedOdometry> odometry_{1000};
  Mailbox<std::string> events_{100};

  mutable std::mutex mutex_;  ///< of what follows
  std::condition_variable came_;
  std::uint64_t arrived_ = 0, dropped_ = 0;
  std::uint64_t taken_ = 0;  ///< of those that arrived
  Eigen::Vector2d velocity_{0, 0};
  std::optional<Clock::time_point> driven_;
  bool stopped_ = false;
  bool told_to_stop_ = false;  ///< the last that was published on the stop topic was true
  std::optional<std::pair<std::int64_t, Clock::time_point>>
      robot_clock_;  ///< stamp of the last image, and its arrival
  std::optional<ros::CameraInfo> camera_info_;

  RosbridgeClient client_;  ///< ends first
};

}  // namespace incognita
