#include "incognita/app/robot/robot_relay.hpp"

#include <fmt/format.h>

#include <utility>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr double stopping_s =
    1;  // for so long zero is sent after a stop; then other nodes may drive the robot

std::int64_t relay_now_ns() {
  return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
}

RosbridgeClientSettings robot_connection(const RobotRelaySettings& settings) {
  RosbridgeClientSettings connection{parse_websocket_address(settings.robot)};
  connection.heartbeat_s = settings.period_s;
  return connection;
}

}  // namespace

RobotRelay::RobotRelay(const RobotRelaySettings& settings, std::function<void(const std::string&)> say)
    : settings_(settings),
      say_(std::move(say)),
      watchdog_(settings.watchdog),
      robot_(robot_connection(settings), robot_handlers()),
      channel_(std::make_shared<RosbridgeChannel>(types_of(settings.topics), navigation_handlers())),
      server_(rosbridge_server(settings.server, channel_, say_)) {
  robot_.start();
}

RobotRelay::~RobotRelay() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    watchdog_.stop();
  }
  server_.reset();
  send_velocity();
}

std::string RobotRelay::address() const { return "ws" + server_->address().substr(4); }

CommandWatchdog::Stop RobotRelay::reason() const {
  const std::lock_guard lock(mutex_);
  return watchdog_.reason(now_s());
}

RosbridgeClientHandlers RobotRelay::robot_handlers() {
  RosbridgeClientHandlers handlers;
  handlers.connected = [this] { connected(); };
  handlers.received = [this](const rosbridge::Operation& operation) {
    if (const auto* publish = std::get_if<rosbridge::Publish>(&operation)) {
      const std::lock_guard lock(mutex_);
      if (!ended_) channel_->publish(publish->topic, publish->msg);
    }
    if (const auto* status = std::get_if<rosbridge::Status>(&operation))
      say_(fmt::format("the robot says: {}: {}", status->level, status->msg.substr(0, 300)));
  };
  handlers.heartbeat = [this] { send_velocity(); };
  handlers.say = say_;
  return handlers;
}

RosbridgeChannelHandlers RobotRelay::navigation_handlers() {
  RosbridgeChannelHandlers handlers;
  handlers.published = [this](std::uint64_t client, const rosbridge::Publish& publish) {
    obey(client, publish);
  };
  handlers.left = [this](std::uint64_t client) {
    {
      const std::lock_guard lock(mutex_);
      watchdog_.disconnected(client);
    }
    send_velocity();
  };
  handlers.wanted = [this](const std::string& topic, const std::string& type) { want(topic, type, true); };
  handlers.unwanted = [this](const std::string& topic, const std::string& type) { want(topic, type, false); };
  return handlers;
}

/// The robot may have been driven by what was sent before its connection was lost.
void RobotRelay::connected() {
  using namespace rosbridge;
  const std::lock_guard lock(mutex_);
  const char* command = settings_.stamps_commands ? ros::stamped_twist_type : ros::twist_type;
  robot_.send(to_json(Advertise{settings_.topics.command, type_for(command, settings_.ros)}));
  for (const auto& [topic, type] : wanted_)
    robot_.send(to_json(Subscribe{.topic = topic, .type = type, .queue_length = 1}));
  stopped_s_ = now_s();
}

void RobotRelay::want(const std::string& topic, const std::string& type, bool wanted) {
  using namespace rosbridge;
  const std::lock_guard lock(mutex_);
  if (wanted) {
    wanted_[topic] = type;
    robot_.send(to_json(Subscribe{.topic = topic, .type = type, .queue_length = 1}));
  } else {
    wanted_.erase(topic);
    robot_.send(to_json(Unsubscribe{topic}));
  }
}

void RobotRelay::obey(std::uint64_t client, const rosbridge::Publish& publish) {
  const std::optional<RobotWish> wish = wish_of(client, publish, settings_.topics);
  if (!wish) throw InputError("topic " + publish.topic.substr(0, 100) + " is not passed on to the robot");
  {
    const std::lock_guard lock(mutex_);
    if (const auto* velocity = std::get_if<VelocityWish>(&*wish)) {
      std::optional<double> age_s;
      if (velocity->stamp_ns) age_s = 1e-9 * static_cast<double>(relay_now_ns() - *velocity->stamp_ns);
      watchdog_.command(velocity->velocity, now_s(), client, age_s);
    } else if (const auto* stop = std::get_if<StopWish>(&*wish)) {
      stop->stop ? watchdog_.stop() : watchdog_.release();
    }
  }
  send_velocity();
}

void RobotRelay::send_velocity() {
  const std::lock_guard lock(mutex_);
  const double now = now_s();
  const CommandWatchdog::Stop reason = watchdog_.reason(now);
  if (reason != said_) {
    say_(fmt::format("{}", name(reason)));
    if (said_ == CommandWatchdog::Stop::none || reason == CommandWatchdog::Stop::by_hand) stopped_s_ = now;
    said_ = reason;
  }
  const bool is_quiet = reason != CommandWatchdog::Stop::none && reason != CommandWatchdog::Stop::by_hand &&
                        now - stopped_s_ > stopping_s;
  if (is_quiet) return;
  const Eigen::Vector2d velocity = watchdog_.velocity(now);
  ros::StampedTwist command;
  command.twist.linear.x() = velocity[0];
  command.twist.angular.z() = velocity[1];
  if (settings_.stamps_commands) command.stamp_ns = relay_now_ns();
  robot_.send(to_json(rosbridge::Publish{settings_.topics.command, ros::to_json(command, settings_.ros)}),
              "command");
}

}  // namespace incognita
