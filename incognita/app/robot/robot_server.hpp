// The simulated robot behind a rosbridge server, in real time.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>

#include "incognita/app/robot/robot_log.hpp"
#include "incognita/app/robot/simulated_robot.hpp"
#include "incognita/live/mailbox.hpp"
#include "incognita/live/robot/robot_client.hpp"
#include "incognita/live/robot/rosbridge_channel.hpp"

namespace incognita {

/// What clients ask of a robot, with the connection that asks.
struct VelocityWish {
  std::uint64_t client = 0;
  Eigen::Vector2d velocity{0, 0};
  std::optional<std::int64_t> stamp_ns = {};
};
struct StopWish {
  bool stop = true;
};
struct CommanderLeft {
  std::uint64_t client = 0;
};
/// A message that could not be read at all.
struct UnreadableWish {
  std::uint64_t client = 0;
};
using RobotWish = std::variant<VelocityWish, StopWish, CommanderLeft, UnreadableWish>;

/// The wish in a message on the topics of a robot; none on another topic. Throws InputError for a message that is not valid.
std::optional<RobotWish> wish_of(std::uint64_t client, const rosbridge::Publish& publish,
                                 const RobotTopics& topics);
/// The wish in a message on the command topic that is not valid: the robot stops.
RobotWish invalid_command(std::uint64_t client);
/// Tells the watchdog, at `now_s` on its clock and `now_ns` on that of the stamps.
void carry_out(const RobotWish& wish, double now_s, std::int64_t now_ns, CommandWatchdog& watchdog);
/// Says all that waits, and how much was dropped before.
void say_waiting(Mailbox<std::string>& messages, const std::function<void(const std::string&)>& say);
/// Known topics of a robot, with their types.
std::map<std::string, std::string> types_of(const RobotTopics& topics);
/// A server of rosbridge clients. Throws InputError if it cannot listen.
std::unique_ptr<Server> rosbridge_server(ServerSettings settings,
                                         const std::shared_ptr<RosbridgeChannel>& channel,
                                         std::function<void(const std::string&)> say);

struct RobotServerSettings {
  ServerSettings server;
  RobotTopics topics;
  int ros = 2;
  double speed_factor = 1;  ///< robot time per wall time
  double duration_s = 0;    ///< of robot time; 0: until the end of the program
  int jpeg_quality = 95;
};

class RobotServer {
 public:
  /// `say`: for printing. It may block: run() calls it in the thread that calls run(), and the robot moves in another. Throws
  /// InputError if it cannot listen.
  RobotServer(const LoadedScenario& loaded, std::unique_ptr<SimulatedRobot> robot, RobotLog log,
              const RobotServerSettings& settings, std::function<void(const std::string&)> say);

  std::uint16_t port() const { return server_->port(); }
  std::string address() const;
  /// Until `is_over`, which is asked in another thread, or the duration.
  void run(const std::function<bool()>& is_over);

 private:
  using Clock = std::chrono::steady_clock;
  struct Arrived {
    double t = 0;  ///< of the robot
    RobotWish wish;
  };
  RosbridgeChannelHandlers client_handlers();
  void move(const std::function<bool()>& is_over);
  double robot_time() const;
  void advance(double until_s);
  void obey(const Arrived& arrived);
  void publish_odometry();
  void publish_image();
  std::int64_t stamp_ns() const;

  RobotServerSettings settings_;
  std::unique_ptr<SimulatedRobot> robot_;
  RobotLog log_;
  std::function<void(const std::string&)> say_;
  ros::CameraInfo camera_info_;
  double image_period_s_;
  std::int64_t start_ns_;  ///< since 1970, of the robot's time 0
  Clock::time_point start_;
  Mailbox<Arrived> wishes_{100000};
  Mailbox<std::string> messages_{200};  ///< to say
  CommandWatchdog::Stop said_ = CommandWatchdog::Stop::no_command;
  std::shared_ptr<RosbridgeChannel> channel_;
  std::unique_ptr<Server> server_;  ///< ends first
};

/// The calibration of a scenario's camera as ROS has it.
ros::CameraInfo camera_info_of(const CameraSettings& camera);

}  // namespace incognita
