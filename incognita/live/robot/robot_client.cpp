#include "incognita/live/robot/robot_client.hpp"

#include <fmt/format.h>

#include <chrono>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::string_view command_word = "command", stop_word = "stop";

ros::Twist twist_with(const Eigen::Vector2d& velocity) {
  ros::Twist twist;
  twist.linear.x() = velocity[0];
  twist.angular.z() = velocity[1];
  return twist;
}

RosbridgeClientSettings connection_of(const RobotClientSettings& settings) {
  RosbridgeClientSettings connection{parse_websocket_address(settings.address)};
  connection.heartbeat_s = settings.command_period_s;
  return connection;
}

}  // namespace

RobotClient::RobotClient(const RobotClientSettings& settings)
    : settings_(settings), client_(connection_of(settings), handlers()) {
  client_.start();
}

RosbridgeClientHandlers RobotClient::handlers() {
  RosbridgeClientHandlers handlers;
  handlers.connected = [this] { subscribe(); };
  handlers.received = [this](const rosbridge::Operation& operation) {
    if (const auto* publish = std::get_if<rosbridge::Publish>(&operation)) take(*publish);
    if (const auto* status = std::get_if<rosbridge::Status>(&operation))
      note(fmt::format("the robot says: {}: {}", status->level, status->msg.substr(0, 300)));
  };
  handlers.heartbeat = [this] {
    const std::lock_guard lock(mutex_);
    send_velocity();
  };
  handlers.say = [this](const std::string& line) { note(line); };
  return handlers;
}

RobotClient::~RobotClient() {
  const std::lock_guard lock(mutex_);
  velocity_.setZero();
  send_velocity();
}

void RobotClient::subscribe() {
  using namespace rosbridge;
  const RobotTopics& t = settings_.topics;
  const auto typed = [&](const char* type) { return type_for(type, settings_.ros); };
  Subscribe image{t.image, typed(ros::compressed_image_type)};
  image.queue_length = 1;  // rosbridge then keeps the newest only
  client_.send(to_json(image));
  if (!t.camera_info.empty()) {
    Subscribe info{t.camera_info, typed(ros::camera_info_type)};
    info.throttle_ms = 1000;
    info.queue_length = 1;
    client_.send(to_json(info));
  }
  if (!t.odometry.empty()) client_.send(to_json(Subscribe{t.odometry, typed(ros::odometry_type)}));
  client_.send(to_json(
      Advertise{t.command, typed(settings_.stamps_commands ? ros::stamped_twist_type : ros::twist_type)}));
  if (!t.stop.empty()) {
    client_.send(to_json(Advertise{t.stop, typed(ros::bool_type)}));
    const std::lock_guard lock(mutex_);
    if (stopped_ || told_to_stop_) publish_stop(stopped_);
  }
}

/// `false` is said once after a `true`: repeated, it would release what others have stopped since.
void RobotClient::publish_stop(bool stopped) {
  client_.send(to_json(rosbridge::Publish{settings_.topics.stop, ros::to_json(stopped)}), stop_word);
  told_to_stop_ = stopped;
}

void RobotClient::take(const rosbridge::Publish& publish) {
  const RobotTopics& t = settings_.topics;
  if (publish.topic == t.image) return take_image(publish);
  if (publish.topic == t.odometry) return take_odometry(publish);
  if (publish.topic != t.camera_info) return;
  const std::lock_guard lock(mutex_);
  camera_info_ = ros::camera_info(publish.msg);
}

void RobotClient::take_image(const rosbridge::Publish& publish) {
  ros::CompressedImage image = ros::compressed_image(publish.msg);
  const std::int64_t stamp_ns = image.header.stamp_ns;
  images_.put(std::move(image));
  {
    const std::lock_guard lock(mutex_);
    robot_clock_ = {stamp_ns, Clock::now()};
    ++arrived_;
  }
  came_.notify_all();
}

void RobotClient::take_odometry(const rosbridge::Publish& publish) {
  const ros::Odometry odometry = ros::odometry(publish.msg);
  odometry_.put({odometry.header.stamp_ns, {odometry.twist.linear.x(), odometry.twist.angular.z()}});
}

void RobotClient::note(const std::string& event) { events_.put(event); }

std::optional<RobotClient::Received> RobotClient::receive(double wait_s) {
  std::unique_lock lock(mutex_);
  came_.wait_for(lock, std::chrono::duration<double>(wait_s), [&] { return arrived_ > taken_; });
  taken_ = arrived_;
  auto images = images_.take();
  dropped_ += images.dropped;
  if (images.values.empty()) return std::nullopt;
  Received received{std::move(images.values.back())};
  for (const ReceivedOdometry& reading : odometry_.take().values) received.odometry.push_back(reading);
  return received;
}

void RobotClient::drive(const Eigen::Vector2d& velocity) {
  const std::lock_guard lock(mutex_);
  velocity_ = velocity;
  driven_ = Clock::now();
  send_velocity();
}

void RobotClient::set_stopped(bool stopped) {
  const std::lock_guard lock(mutex_);
  if (stopped_ == stopped) return;
  stopped_ = stopped;
  velocity_.setZero();
  // Without a connection subscribe() says it in the next one
  if (!settings_.topics.stop.empty() && client_.is_connected()) publish_stop(stopped);
  send_velocity();
}

bool RobotClient::is_stopped() const {
  const std::lock_guard lock(mutex_);
  return stopped_;
}

/// Time of the robot's clock, from the stamp of the last image: the clocks of two machines differ, and a watchdog must not stop
/// the robot for that.
std::optional<std::int64_t> RobotClient::robot_time_ns() const {
  if (!robot_clock_) return std::nullopt;
  return robot_clock_->first + std::chrono::nanoseconds(Clock::now() - robot_clock_->second).count();
}

void RobotClient::send_velocity() {
  ros::StampedTwist command;
  const bool late = !driven_ || Clock::now() - *driven_ > std::chrono::duration<double>(settings_.late_s);
  command.twist = twist_with(stopped_ || late ? Eigen::Vector2d(0, 0) : velocity_);
  if (settings_.stamps_commands) command.stamp_ns = robot_time_ns().value_or(0);
  client_.send(to_json(rosbridge::Publish{settings_.topics.command, ros::to_json(command, settings_.ros)}),
               command_word);
}

std::vector<std::string> RobotClient::take_events() {
  auto events = events_.take();
  return {events.values.begin(), events.values.end()};
}

std::optional<ros::CameraInfo> RobotClient::camera_info() const {
  const std::lock_guard lock(mutex_);
  return camera_info_;
}

RobotClient::Counts RobotClient::counts() const {
  const std::lock_guard lock(mutex_);
  return {arrived_, dropped_, client_.connections()};
}

}  // namespace incognita
