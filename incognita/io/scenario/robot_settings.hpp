// Settings of the link to a robot that speaks rosbridge.
#pragma once

#include <string>

#include "incognita/math/setting.hpp"

namespace incognita {

struct RobotSettings {
  std::string address = "ws://localhost:9090";
  int ros = 2;
  std::string image_topic = "/camera/image_raw/compressed";
  std::string camera_info_topic = "/camera/camera_info";
  std::string odometry_topic = "/odom";
  std::string command_topic = "/cmd_vel";
  std::string stop_topic = "/stop";
  bool stamps_commands = false;
  double max_acceleration_m_s2 = 0.5;
  double max_angular_acceleration_rad_s2 = 1;
  double late_s = 0.3;
  double give_up_s = 60;
  double recovery_turn_rate_rad_s = 0;
  double recovery_after_s = 2;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = RobotSettings;
    setting(&S::address, "address", "", any(),
            "Address of the rosbridge server, or of `incognita robot` before it");
    setting(&S::ros, "ros", "", between(1, 2), "Generation of ROS: 1 or 2");
    setting(&S::image_topic, "image_topic", "", any(), "Images, sensor_msgs/CompressedImage");
    setting(&S::camera_info_topic, "camera_info_topic", "", any(),
            "Calibration that [camera] is compared with, sensor_msgs/CameraInfo; empty: none");
    setting(&S::odometry_topic, "odometry_topic", "", any(),
            "Wheel odometry, nav_msgs/Odometry; empty: none");
    setting(&S::command_topic, "command_topic", "", any(), "Velocity commands, geometry_msgs/Twist");
    setting(&S::stop_topic, "stop_topic", "", any(),
            "Stop by hand, std_msgs/Bool, which `incognita robot` obeys; empty: none");
    setting(&S::stamps_commands, "stamps_commands", "", any(),
            "Whether commands are geometry_msgs/TwistStamped, with the robot's time");
    setting(&S::max_acceleration_m_s2, "max_acceleration_m_s2", "m/s^2", above_up_to(0, 100),
            "Limit of the change of the commanded speed; a stop for safety is immediate");
    setting(&S::max_angular_acceleration_rad_s2, "max_angular_acceleration_rad_s2", "rad/s^2",
            above_up_to(0, 100), "Limit of the change of the commanded turn rate");
    setting(&S::late_s, "late_s", "s", between(0.02, 10),
            "Time after which an image is late and the robot is stopped; more than a frame");
    setting(&S::give_up_s, "give_up_s", "s", between(1, 1e6),
            "Time without an image after which the run fails");
    setting(
        &S::recovery_turn_rate_rad_s, "recovery_turn_rate_rad_s", "rad/s", between(0, 10),
        "Turn rate at which a lost robot turns in place, until it recognizes its map, at most controller.max_turn_rate_rad_s; 0: it stands");
    setting(&S::recovery_after_s, "recovery_after_s", "s", between(0, 1e6),
            "Time for which a lost robot stands before it turns");
  }
};

}  // namespace incognita
