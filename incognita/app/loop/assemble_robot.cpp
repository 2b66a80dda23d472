#include <algorithm>

#include "incognita/app/loop/assemblers.hpp"
#include "incognita/app/loop/body_models.hpp"
#include "incognita/app/loop/linked_robot.hpp"
#include "incognita/app/loop/robot_controller.hpp"
#include "incognita/control/steering_controller.hpp"
#include "incognita/decision/decision.hpp"
#include "incognita/decision/no_decision.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/enum_words.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/stream_times.hpp"

namespace incognita {
namespace {

std::shared_ptr<LinkedRobot> linked_robot(const LoadedScenario& loaded) {
  try {
    return std::make_shared<LinkedRobot>(loaded.scenario);
  } catch (const InputError& error) {
    throw InputError(loaded.source_of("robot.address") + ": robot.address: " + error.what());
  }
}

std::unique_ptr<Controller> robot_controller(const LoadedScenario& loaded,
                                             const std::shared_ptr<RobotLink>& link) {
  const Scenario& s = loaded.scenario;
  const ControllerSettings& c = s.controller;
  const VelocityLimits limits{{c.max_speed_m_s, c.max_turn_rate_rad_s},
                              s.robot.max_acceleration_m_s2,
                              s.robot.max_angular_acceleration_rad_s2};
  return attributed_to(loaded, "controller.law", word_of(c.law), [&] {
    BodyControl control = body_control_of(loaded, 0, Terrain{});
    control.carried_at = s.mount;
    auto steering = std::make_unique<SteeringController>(std::vector{std::move(control)}, 1 / s.run.rate_hz);
    return std::make_unique<RobotController>(
        std::move(steering), link, limits, CommandPace{1 / s.run.rate_hz, s.robot.late_s},
        RecoveryTurnSettings{std::min(s.robot.recovery_turn_rate_rad_s, c.max_turn_rate_rad_s),
                             s.robot.recovery_after_s});
  });
}

}  // namespace

Assembly assemble_robot(const LoadedScenario& loaded) {
  const Scenario& s = loaded.scenario;
  const Camera camera = make_camera(s.camera);
  const std::optional<Target> target = start_target(loaded);
  const auto link = linked_robot(loaded);
  Assembly out;
  put_scenario(loaded, out.info);
  out.info.ate_alignment = target ? "se3" : "sim3";
  out.info.inputs = input_names(motion_traits<TerrainVehicle>);
  out.notes.emplace_back("the robot at " + s.robot.address + " is expected to avoid obstacles by itself");
  if (!target) out.notes.emplace_back("no target: the scale is unobservable, lengths are in arbitrary units");
  out.robot = link;
  out.live = std::make_shared<LiveFeed>(
      LiveFeedSettings{s.run.duration_s, 1 / s.run.rate_hz, s.robot.late_s, s.robot.give_up_s}, link,
      steady_s);
  std::optional<WheelOdometry> odometry;
  if (s.slam.filter.odometry) odometry = wheel_odometry_of(s);
  auto estimator = image_estimator(loaded, camera, target, odometry);
  LoopParts& parts = out.parts;
  parts.clock = std::make_unique<LiveClock>(out.live);
  parts.world = std::make_unique<LiveWorld>();
  parts.sensor = std::make_unique<LiveSensors>(out.live);
  if (s.decides())
    parts.strategy = decide_for(*estimator, active_settings_of(s));
  else
    parts.strategy = std::make_unique<NoDecision>();
  parts.estimator = std::move(estimator);
  parts.controller = robot_controller(loaded, link);
  return out;
}

}  // namespace incognita
