#include "incognita/app/robot/robot_relay.hpp"

#include <fmt/format.h>

#include <thread>
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
      server_(rosbridge_server(settings.server, channel_,
                               [this](const std::string& line) { messages_.put(line); })) {
  robot_.start();
}

RobotRelay::~RobotRelay() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    watchdog_.end();
  }
  send_velocity();
  server_.reset();
  say_waiting(messages_, say_);  // meanwhile the heartbeat goes on with zeros
}

void RobotRelay::run(const std::function<bool()>& is_over) {
  while (!is_over()) {
    say_waiting(messages_, say_);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

std::string RobotRelay::address() const { return "ws" + server_->address().substr(4); }

CommandWatchdog::Stop RobotRelay::reason() const {
  const std::lock_guard lock(mutex_);
  return watchdog_.reason(now_s());
}

RosbridgeClientHandlers RobotRelay::robot_handlers() {
  RosbridgeClientHandlers handlers;
  handlers.connected = [this] { connected(); };
  handlers.received = [this](const rosbridge::Operation& operation) { received(operation); };
  handlers.heartbeat = [this] { send_velocity(); };
  handlers.say = [this](const std::string& line) { messages_.put(line); };
  return handlers;
}

/// From the robot's side, where anybody may use the stop topic.
void RobotRelay::received(const rosbridge::Operation& operation) {
  if (const auto* status = std::get_if<rosbridge::Status>(&operation))
    messages_.put(fmt::format("the robot says: {}: {}", status->level, status->msg.substr(0, 300)));
  const auto* publish = std::get_if<rosbridge::Publish>(&operation);
  if (!publish) return;
  {
    const std::lock_guard lock(mutex_);
    if (!ended_) channel_->publish(publish->topic, publish->msg);
  }
  if (publish->topic == settings_.topics.stop) obey(StopWish{ros::boolean(publish->msg)});
}

RosbridgeChannelHandlers RobotRelay::navigation_handlers() {
  RosbridgeChannelHandlers handlers;
  handlers.published = [this](std::uint64_t client, const rosbridge::Publish& publish) {
    published(client, publish);
  };
  handlers.unreadable = [this](std::uint64_t client) { obey(UnreadableWish{client}); };
  handlers.left = [this](std::uint64_t client) { obey(CommanderLeft{client}); };
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
  if (!settings_.topics.stop.empty())
    robot_.send(to_json(Subscribe{settings_.topics.stop, type_for(ros::bool_type, settings_.ros)}));
  for (const auto& [topic, type] : wanted_)
    robot_.send(to_json(Subscribe{.topic = topic, .type = type, .queue_length = 1}));
  stopped_s_ = now_s();
}

void RobotRelay::want(const std::string& topic, const std::string& type, bool wanted) {
  using namespace rosbridge;
  if (topic == settings_.topics.stop) return;  // subscribed always
  const std::lock_guard lock(mutex_);
  if (wanted) {
    wanted_[topic] = type;
    robot_.send(to_json(Subscribe{.topic = topic, .type = type, .queue_length = 1}));
  } else {
    wanted_.erase(topic);
    robot_.send(to_json(Unsubscribe{topic}));
  }
}

void RobotRelay::published(std::uint64_t client, const rosbridge::Publish& publish) {
  std::optional<RobotWish> wish;
  try {
    wish = wish_of(client, publish, settings_.topics);
  } catch (const InputError&) {
    if (publish.topic == settings_.topics.command) obey(invalid_command(client));
    throw;
  }
  if (!wish) throw InputError("topic " + publish.topic.substr(0, 100) + " is not passed on to the robot");
  obey(*wish);
}

void RobotRelay::obey(const RobotWish& wish) {
  {
    const std::lock_guard lock(mutex_);
    carry_out(wish, now_s(), relay_now_ns(), watchdog_);
  }
  send_velocity();
}

/// What is said comes last: nothing may delay a stop.
void RobotRelay::send_velocity() {
  std::optional<CommandWatchdog::Stop> changed;
  {
    const std::lock_guard lock(mutex_);
    const double now = now_s();
    const CommandWatchdog::Stop reason = watchdog_.reason(now);
    const bool is_held = reason == CommandWatchdog::Stop::by_hand || reason == CommandWatchdog::Stop::ended;
    if (reason != said_) {
      if (said_ == CommandWatchdog::Stop::none || is_held) stopped_s_ = now;
      changed = said_ = reason;
    }
    const bool is_quiet = reason != CommandWatchdog::Stop::none && !is_held && now - stopped_s_ > stopping_s;
    if (!is_quiet) send(watchdog_.velocity(now));
  }
  if (changed) messages_.put(name(*changed));
}

void RobotRelay::send(const Eigen::Vector2d& velocity) {
  ros::StampedTwist command;
  command.twist.linear.x() = velocity[0];
  command.twist.angular.z() = velocity[1];
  if (settings_.stamps_commands) command.stamp_ns = relay_now_ns();
  robot_.send(to_json(rosbridge::Publish{settings_.topics.command, ros::to_json(command, settings_.ros)}),
              "command");
}

}  // namespace incognita
