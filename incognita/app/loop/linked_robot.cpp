#include "incognita/app/loop/linked_robot.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "incognita/io/formats/image_file.hpp"
#include "incognita/messages/tick.hpp"

namespace incognita {
namespace {

constexpr std::size_t most_kept = 1000;  // readings of odometry

double seconds_of(std::int64_t stamp_ns) { return rounded_to_us(1e-9 * static_cast<double>(stamp_ns)); }

}  // namespace

RobotClientSettings robot_client_settings(const Scenario& s) {
  const RobotSettings& r = s.robot;
  return {r.address,
          {r.image_topic, r.camera_info_topic, r.odometry_topic, r.command_topic, r.stop_topic},
          r.ros,
          r.stamps_commands,
          1 / s.run.rate_hz,
          r.late_s};
}

LinkedRobot::LinkedRobot(const Scenario& scenario)
    : settings_(robot_client_settings(scenario)), camera_(scenario.camera) {
  parse_websocket_address(settings_.address);
}

std::optional<LiveReading> LinkedRobot::read(double wait_s) {
  if (!client_) {
    const std::lock_guard lock(mutex_);
    client_ = std::make_unique<RobotClient>(settings_);
    client_->set_stopped(stopped_);
  }
  const std::optional<RobotClient::Received> received = client_->receive(wait_s);
  if (!compared_) compare_camera();
  if (!received) return std::nullopt;
  LiveReading reading{seconds_of(received->image.header.stamp_ns), decoded(received->image)};
  keep(received->odometry);
  if (!reading.image) return std::nullopt;
  reading.odometry = std::exchange(odometry_, {});
  return reading;
}

void LinkedRobot::keep(const std::vector<RobotClient::ReceivedOdometry>& readings) {
  for (const RobotClient::ReceivedOdometry& reading : readings)
    odometry_.push_back({seconds_of(reading.stamp_ns), reading.velocity});
  if (odometry_.size() > most_kept)
    odometry_.erase(odometry_.begin(), odometry_.end() - static_cast<std::ptrdiff_t>(most_kept));
}

std::shared_ptr<const Image> LinkedRobot::decoded(const ros::CompressedImage& compressed) {
  std::shared_ptr<const Image> image;
  try {
    image =
        std::make_shared<const Image>(decode_image(compressed.data, "an image on " + settings_.topics.image));
  } catch (const std::runtime_error& error) {
    if (++undecoded_ == 1) events_.emplace_back(fmt::format("{}; such images are skipped", error.what()));
    return nullptr;
  }
  if (image->width() != camera_.width_px || image->height() != camera_.height_px)
    throw std::runtime_error(
        fmt::format("the robot's images are {}x{}, and the camera is calibrated for {}x{} "
                    "(camera.width_px, camera.height_px)",
                    image->width(), image->height(), camera_.width_px, camera_.height_px));
  return image;
}

void LinkedRobot::compare_camera() {
  const std::optional<ros::CameraInfo> info = client_->camera_info();
  if (!info) return;
  compared_ = true;
  for (std::string& line : differences(*info, camera_)) events_.push_back(std::move(line));
}

void LinkedRobot::drive(const Eigen::Vector2d& velocity) {
  if (client_) client_->drive(velocity);
}

void LinkedRobot::set_stopped(bool stopped) {
  const std::lock_guard lock(mutex_);
  stopped_ = stopped;
  if (client_) client_->set_stopped(stopped);
}

bool LinkedRobot::is_stopped() const {
  const std::lock_guard lock(mutex_);
  return stopped_;
}

std::string LinkedRobot::problem() const {
  const std::string problem = client_ ? client_->problem() : "not connected yet";
  if (problem.empty())
    return fmt::format("it is connected, but publishes none on {} (robot.image_topic)",
                       settings_.topics.image);
  return problem + "; start rosbridge, or `incognita robot`, there, or correct robot.address";
}

std::vector<std::string> LinkedRobot::take_events() {
  std::vector<std::string> events = std::exchange(events_, {});
  if (!client_) return events;
  for (std::string& event : client_->take_events()) events.push_back(std::move(event));
  return events;
}

std::vector<std::pair<std::string, std::int64_t>> LinkedRobot::counts() const {
  if (!client_) return {};
  const RobotClient::Counts counts = client_->counts();
  return {{"robot_images", static_cast<std::int64_t>(counts.images)},
          {"robot_dropped_images", static_cast<std::int64_t>(counts.dropped_images)},
          {"robot_undecoded_images", undecoded_},
          {"robot_connections", static_cast<std::int64_t>(counts.connections)}};
}

std::vector<std::string> differences(const ros::CameraInfo& info, const CameraSettings& camera) {
  constexpr double share = 0.01;
  std::vector<std::string> lines;
  const auto compare = [&](const char* key, double here, const char* field, double there) {
    if (there == 0 || std::abs(there - here) <= share * std::abs(here)) return;
    lines.push_back(
        fmt::format("camera.{} is {:g}, and the robot's camera info has {} = {:g}", key, here, field, there));
  };
  compare("width_px", camera.width_px, "width", info.width);
  compare("height_px", camera.height_px, "height", info.height);
  compare("fu_px", camera.fu_px, "K[0]", info.K[0]);
  compare("fv_px", camera.fv_px, "K[4]", info.K[4]);
  compare("u0_px", camera.u0_px, "K[2]", info.K[2]);
  compare("v0_px", camera.v0_px, "K[5]", info.K[5]);
  return lines;
}

}  // namespace incognita
