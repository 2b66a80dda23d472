// The robot's side of the link to a real robot: stands between navigation and the robot's own rosbridge, and stops the robot when
// the commands of navigation do not come. It passes topics on as they are, and commands through a watchdog.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "incognita/app/robot/robot_server.hpp"
#include "incognita/live/mailbox.hpp"
#include "incognita/live/robot/rosbridge_client.hpp"
#include "incognita/live/robot/watchdog.hpp"

namespace incognita {

struct RobotRelaySettings {
  ServerSettings server;
  std::string robot = "ws://localhost:9090";  ///< the robot's rosbridge
  RobotTopics topics;
  int ros = 2;
  bool stamps_commands = false;  ///< the robot reads TwistStamped instead of Twist
  CommandWatchdog::Settings watchdog;
  double period_s = 0.05;  ///< of the commands to the robot
};

class RobotRelay {
 public:
  /// Throws InputError if it cannot listen, or for an address that is not valid.
  /// `say`: for printing. It may block: it is called by run() and the destructor only, and nothing waits for it that stops the
  /// robot.
  RobotRelay(const RobotRelaySettings& settings, std::function<void(const std::string&)> say);
  /// Stops the robot.
  ~RobotRelay();
  RobotRelay(const RobotRelay&) = delete;
  RobotRelay& operator=(const RobotRelay&) = delete;

  std::uint16_t port() const { return server_->port(); }
  std::string address() const;
  /// Says what happens, until `is_over`. Everything else is done in threads of its own, also before.
  void run(const std::function<bool()>& is_over);
  /// Of the watchdog, now.
  CommandWatchdog::Stop reason() const;

 private:
  using Clock = std::chrono::steady_clock;
  double now_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  RosbridgeClientHandlers robot_handlers();
  RosbridgeChannelHandlers navigation_handlers();
  void connected();
  void received(const rosbridge::Operation& operation);
  void published(std::uint64_t client, const rosbridge::Publish& publish);
  void obey(const RobotWish& wish);
  void want(const std::string& topic, const std::string& type, bool wanted);
  void send_velocity();
  void send(const Eigen::Vector2d& velocity);

  RobotRelaySettings settings_;
  std::function<void(const std::string&)> say_;
  Clock::time_point start_ = Clock::now();
  Mailbox<std::string> messages_{200};  ///< to say

  mutable std::mutex mutex_;  ///< of what follows
  CommandWatchdog watchdog_;
  CommandWatchdog::Stop said_ = CommandWatchdog::Stop::no_command;
  double stopped_s_ = 0;                       ///< when the robot was stopped last
  bool ended_ = false;                         ///< nobody listens any more
  std::map<std::string, std::string> wanted_;  ///< topics with their types

  RosbridgeClient robot_;
  std::shared_ptr<RosbridgeChannel> channel_;
  std::unique_ptr<Server> server_;  ///< ends first
};

}  // namespace incognita
