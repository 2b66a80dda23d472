#include "incognita/app/robot/robot_server.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <future>
#include <thread>
#include <utility>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/image_text.hpp"

namespace incognita {
namespace {

constexpr int odometry_per_image = 4;
constexpr std::int64_t ns_per_us = 1000;

std::int64_t now_ns() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count() * ns_per_us;
}

}  // namespace

ros::CameraInfo camera_info_of(const CameraSettings& c) {
  ros::CameraInfo info;
  info.width = c.width_px;
  info.height = c.height_px;
  info.K = {c.fu_px, 0, c.u0_px, 0, c.fv_px, c.v0_px, 0, 0, 1};
  struct Lens {
    ros::CameraInfo& info;
    void operator()(const PinholeLens& l) const {
      info.distortion_model = "plumb_bob";
      info.distortion = {l.k1, l.k2, l.p1, l.p2, l.k3};
    }
    void operator()(const FisheyeLens& l) const {
      info.distortion_model = "equidistant";
      info.distortion = {l.k1, l.k2, l.k3, l.k4};
    }
    void operator()(const WideAngleLens& l) const {  // without distortion it is a pinhole camera
      info.distortion_model = l.kd1_per_px2 == 0 ? "plumb_bob" : "wide_angle";
      if (l.kd1_per_px2 == 0)
        info.distortion.assign(5, 0.0);
      else
        info.distortion = {l.kd1_per_px2};
    }
  };
  std::visit(Lens{info}, c.model);
  return info;
}

std::map<std::string, std::string> types_of(const RobotTopics& t) {
  std::map<std::string, std::string> types{{t.image, ros::compressed_image_type},
                                           {t.command, ros::twist_type}};
  if (!t.camera_info.empty()) types[t.camera_info] = ros::camera_info_type;
  if (!t.odometry.empty()) types[t.odometry] = ros::odometry_type;
  if (!t.stop.empty()) types[t.stop] = ros::bool_type;
  return types;
}

std::optional<RobotWish> wish_of(std::uint64_t client, const rosbridge::Publish& publish,
                                 const RobotTopics& topics) {
  if (publish.topic == topics.stop) return StopWish{ros::boolean(publish.msg)};
  if (publish.topic != topics.command) return std::nullopt;
  const ros::StampedTwist command = ros::twist(publish.msg);
  return VelocityWish{client, {command.twist.linear.x(), command.twist.angular.z()}, command.stamp_ns};
}

RobotWish invalid_command(std::uint64_t client) { return VelocityWish{client, {NAN, NAN}}; }

void carry_out(const RobotWish& wish, double now_s, std::int64_t now_ns, CommandWatchdog& watchdog) {
  if (const auto* velocity = std::get_if<VelocityWish>(&wish)) {
    std::optional<double> age_s;
    if (velocity->stamp_ns) age_s = 1e-9 * static_cast<double>(now_ns - *velocity->stamp_ns);
    watchdog.command(velocity->velocity, now_s, velocity->client, age_s);
  } else if (const auto* stop = std::get_if<StopWish>(&wish)) {
    stop->stop ? watchdog.stop() : watchdog.release();
  } else if (const auto* unreadable = std::get_if<UnreadableWish>(&wish)) {
    watchdog.unreadable(unreadable->client);
  } else {
    watchdog.disconnected(std::get<CommanderLeft>(wish).client);
  }
}

void say_waiting(Mailbox<std::string>& messages, const std::function<void(const std::string&)>& say) {
  const auto taken = messages.take();
  if (taken.dropped > 0) say(fmt::format("{} older messages were dropped", taken.dropped));
  for (const std::string& line : taken.values) say(line);
}

std::unique_ptr<Server> rosbridge_server(ServerSettings settings,
                                         const std::shared_ptr<RosbridgeChannel>& channel,
                                         std::function<void(const std::string&)> say) {
  settings.websocket_path = "/";
  ServerHandlers handlers;
  handlers.answer = [](const HttpRequest&) {
    HttpAnswer answer;
    answer.status = 404;
    answer.body = std::make_shared<const std::string>(
        "{\"error\": \"this is a rosbridge server: connect by WebSocket\"}");
    return answer;
  };
  handlers.protocols = {{RosbridgeChannel::subprotocol, channel}};
  handlers.log = std::move(say);
  return std::make_unique<Server>(std::move(settings), std::move(handlers),
                                  [&](Server& server) { channel->attach(server); });
}

RobotServer::RobotServer(const LoadedScenario& loaded, std::unique_ptr<SimulatedRobot> robot, RobotLog log,
                         const RobotServerSettings& settings, std::function<void(const std::string&)> say)
    : settings_(settings),
      robot_(std::move(robot)),
      log_(std::move(log)),
      say_(std::move(say)),
      camera_info_(camera_info_of(loaded.scenario.camera)),
      image_period_s_(1 / loaded.scenario.run.rate_hz),
      start_ns_(now_ns()),
      start_(Clock::now()) {
  channel_ = std::make_shared<RosbridgeChannel>(types_of(settings_.topics), client_handlers());
  server_ =
      rosbridge_server(settings_.server, channel_, [this](const std::string& line) { messages_.put(line); });
}

RosbridgeChannelHandlers RobotServer::client_handlers() {
  RosbridgeChannelHandlers handlers;
  handlers.published = [this](std::uint64_t client, const rosbridge::Publish& publish) {
    std::optional<RobotWish> wish;
    try {
      wish = wish_of(client, publish, settings_.topics);
    } catch (const InputError&) {
      if (publish.topic == settings_.topics.command) wishes_.put({robot_time(), invalid_command(client)});
      throw;
    }
    if (!wish)
      throw InputError("topic " + publish.topic.substr(0, 100) + " is not one that this robot reads");
    wishes_.put({robot_time(), *wish});
  };
  handlers.unreadable = [this](std::uint64_t client) { wishes_.put({robot_time(), UnreadableWish{client}}); };
  handlers.left = [this](std::uint64_t client) { wishes_.put({robot_time(), CommanderLeft{client}}); };
  return handlers;
}

std::string RobotServer::address() const { return "ws" + server_->address().substr(4); }

double RobotServer::robot_time() const {
  return std::chrono::duration<double>(Clock::now() - start_).count() * settings_.speed_factor;
}

std::int64_t RobotServer::stamp_ns() const {
  return start_ns_ + ns_per_us * static_cast<std::int64_t>(std::llround(1e6 * robot_->state().t));
}

void RobotServer::run(const std::function<bool()>& is_over) {
  std::future<void> moving = std::async(std::launch::async, [&] { move(is_over); });
  while (moving.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready)
    say_waiting(messages_, say_);
  say_waiting(messages_, say_);
  moving.get();
}

void RobotServer::move(const std::function<bool()>& is_over) {
  const double period_s = image_period_s_ / odometry_per_image;
  const auto has_time = [&] { return settings_.duration_s == 0 || robot_->state().t < settings_.duration_s; };
  for (std::int64_t tick = 0; !is_over() && has_time(); ++tick) {
    const double due_s = static_cast<double>(tick) * period_s;
    std::this_thread::sleep_until(start_ +
                                  std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(due_s / settings_.speed_factor)));
    for (const Arrived& arrived : wishes_.take().values) obey(arrived);
    advance(robot_time());
    publish_odometry();
    if (tick % odometry_per_image == 0) publish_image();
    log_.flush();
    // A machine that is too slow skips what it cannot do in time
    const auto late = static_cast<std::int64_t>((robot_time() - due_s) / period_s) / odometry_per_image;
    tick += late * odometry_per_image;
  }
}

/// What happened before a wish came happened without it.
void RobotServer::obey(const Arrived& arrived) {
  advance(arrived.t);
  carry_out(arrived.wish, arrived.t, start_ns_ + static_cast<std::int64_t>(1e9 * arrived.t),
            robot_->watchdog());
}

void RobotServer::advance(double until_s) {
  robot_->advance(until_s, [this](const RobotState& state) {
    log_.add_step(state, 1e-9 * static_cast<double>(start_ns_));
    if (state.reason != said_) messages_.put(fmt::format("t = {:.2f} s: {}", state.t, name(state.reason)));
    said_ = state.reason;
  });
}

void RobotServer::publish_odometry() {
  if (settings_.topics.odometry.empty()) return;
  const RobotState& state = robot_->state();
  ros::Odometry odometry;
  odometry.header = {stamp_ns(), "odom"};
  odometry.position = {state.odometry[0], state.odometry[1], 0};
  odometry.orientation = {std::cos(state.odometry[2] / 2), 0, 0, std::sin(state.odometry[2] / 2)};
  odometry.twist.linear.x() = state.executed[0];
  odometry.twist.angular.z() = state.executed[1];
  channel_->publish(settings_.topics.odometry, to_json(odometry, settings_.ros));
}

void RobotServer::publish_image() {
  const BodyObservation observed = robot_->measure();
  const ros::Header header{stamp_ns(), "camera"};
  log_.add_image(robot_->state(), 1e-9 * static_cast<double>(header.stamp_ns));
  const std::shared_ptr<const Image> image = image_of(observed);
  channel_->publish(
      settings_.topics.image,
      to_json(ros::CompressedImage{header, "jpeg", jpeg(*image, settings_.jpeg_quality)}, settings_.ros));
  if (settings_.topics.camera_info.empty()) return;
  camera_info_.header = header;
  channel_->publish(settings_.topics.camera_info, to_json(camera_info_, settings_.ros));
}

}  // namespace incognita
