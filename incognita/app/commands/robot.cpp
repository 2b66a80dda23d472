#include "incognita/app/commands/robot.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "incognita/app/console/folder_lock.hpp"
#include "incognita/app/console/interrupt.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/app/robot/robot_relay.hpp"
#include "incognita/app/robot/robot_server.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

struct RobotOptions {
  std::string scenario = "explore-terrain";
  std::vector<std::string> sets;
  std::optional<std::string> seed;
  std::optional<std::string> relay;
  std::optional<int> port;
  std::string address = "127.0.0.1";
  std::string token;
  std::optional<std::string> out;
  bool resume = false, stamped = false;
  double watchdog_s = 0.5, stale_s = 0.5, speed_factor = 1, duration_s = 0;
  int ros = 2;
  RobotTopics topics;
};

constexpr int robot_port = 9090, relay_port = 9091;  // a robot with a relay has rosbridge at 9090

ServerSettings robot_server_settings(const RobotOptions& o) {
  ServerSettings settings;
  settings.address = o.address == "localhost" ? "127.0.0.1" : o.address;
  settings.port = static_cast<std::uint16_t>(o.port.value_or(o.relay ? relay_port : robot_port));
  settings.access.token = o.token;
  if (o.token.empty() && !is_loopback(settings.address)) settings.access.token = random_token();
  settings.idle_s = 10;
  return settings;
}

void say_robot(const std::string& line) { print_message("{}\n", line); }

int relay(const RobotOptions& o) {
  RobotRelay relay(
      {robot_server_settings(o), *o.relay, o.topics, o.ros, o.stamped, {o.watchdog_s, o.stale_s}}, say_robot);
  print_message("navigation connects to {}\n", relay.address());
  const auto start = std::chrono::steady_clock::now();
  relay.run([&] {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    return interrupted() || (o.duration_s > 0 && passed.count() >= o.duration_s);
  });
  return 0;
}

Eigen::Vector3d pose_to_resume(const std::filesystem::path& folder) {
  if (const auto pose = last_pose(folder)) return *pose;
  throw InputError(
      folder.string() +
      ": --resume needs the robot.csv of an earlier robot there, with one row at least; name its folder "
      "with --out, or leave out --resume");
}

int simulate(const RobotOptions& o) {
  std::vector<Flag> flags;
  if (o.seed) flags.push_back({"run.seed", *o.seed, "--seed"});
  const LoadedScenario loaded = load_scenario(o.scenario, o.sets, flags);
  const std::filesystem::path out = o.out.value_or("out/" + loaded.name + "-robot");
  if (o.resume) pose_to_resume(out);  // refused before anything is made
  auto robot = std::make_unique<SimulatedRobot>(loaded, CommandWatchdog::Settings{o.watchdog_s, o.stale_s});
  const FolderLock lock(out);
  if (o.resume) robot->put(pose_to_resume(out));
  RobotServerSettings settings{robot_server_settings(o), o.topics, o.ros, o.speed_factor, o.duration_s};
  RobotServer server(loaded, std::move(robot), RobotLog(out, o.resume), settings, say_robot);
  print_message("the robot is at {}, its log in {}\n", server.address(), out.string());
  server.run([] { return interrupted(); });
  print_message("the true path is in {}\n", (out / "truth.tum").string());
  return 0;
}

int run_robot(const RobotOptions& o) {
  catch_interrupts();
  std::signal(SIGPIPE, SIG_IGN);
  return o.relay ? relay(o) : simulate(o);
}

void add_topics(CLI::App& command, RobotTopics& t) {
  command.add_option("--image-topic", t.image, "sensor_msgs/CompressedImage")->capture_default_str();
  command.add_option("--camera-info-topic", t.camera_info, "sensor_msgs/CameraInfo")->capture_default_str();
  command.add_option("--odometry-topic", t.odometry, "nav_msgs/Odometry")->capture_default_str();
  command.add_option("--command-topic", t.command, "geometry_msgs/Twist or TwistStamped")
      ->capture_default_str();
  command.add_option("--stop-topic", t.stop, "std_msgs/Bool: true stops the robot until false")
      ->capture_default_str();
}

}  // namespace

CLI::App* add_robot(CLI::App& app, std::function<int()>& job) {
  CLI::App* command = app.add_subcommand(
      "robot",
      "Be the robot for `run` with world.type = robot: a simulated one, or a relay with a watchdog before a real one");
  auto o = std::make_shared<RobotOptions>();
  command->add_option("scenario", o->scenario, "Scenario with a vehicle in the rendered room")
      ->capture_default_str();
  CLI::Option* relay =
      command
          ->add_option("--relay", o->relay,
                       "No simulation: pass everything on to and from the rosbridge server there")
          ->type_name("ADDRESS");
  command->add_option("--port", o->port, "Port to listen at; 0: any free one [9090, with --relay 9091]")
      ->check(CLI::Range(0, 65535))
      ->type_name("PORT");
  command->add_option("--address", o->address, "Address to listen at; 0.0.0.0: all of this machine")
      ->capture_default_str();
  command
      ->add_option("--token", o->token,
                   "Token that clients need, ws://...:9090/?token=TEXT [random, none on this machine]")
      ->type_name("TEXT");
  command->add_option("--watchdog", o->watchdog_s, "The robot stops without a command for so many seconds")
      ->check(CLI::Range(0.05, 10.0))
      ->capture_default_str();
  command->add_option("--stale", o->stale_s, "A command that was stamped so many seconds ago does not count")
      ->check(CLI::Range(0.05, 10.0))
      ->capture_default_str();
  command->add_option("--duration", o->duration_s, "End after so many seconds; 0: by Ctrl-C")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--ros", o->ros, "Generation of ROS, 1 or 2, whose messages are written")
      ->check(CLI::Range(1, 2))
      ->capture_default_str();
  command->add_flag("--stamped", o->stamped, "With --relay: the robot reads TwistStamped instead of Twist")
      ->needs(relay);
  add_topics(*command, o->topics);
  const auto simulated = "Simulated robot";
  command->add_option("--out", o->out, "Folder of robot.csv and truth.tum [out/<scenario>-robot]")
      ->type_name("DIR")
      ->group(simulated);
  command->add_flag("--resume", o->resume, "Start where the robot of that folder ended, and add to its files")
      ->group(simulated);
  command->add_option("--seed", o->seed, "Seed of all random streams")->type_name("N")->group(simulated);
  command->add_option("--set", o->sets, "Override a setting of the scenario")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->group(simulated);
  command->add_option("--speed-factor", o->speed_factor, "Robot time per wall time")
      ->check(CLI::Range(0.1, 10.0))
      ->capture_default_str()
      ->group(simulated);
  for (const char* option : {"scenario", "--out", "--resume", "--seed", "--set", "--speed-factor"})
    command->get_option(option)->excludes(relay);
  command->footer(
      "Example: a simulated robot, and navigation in another terminal\n"
      "  incognita robot explore-terrain\n"
      "  incognita run robot\n"
      "On a robot with rosbridge at port 9090, so that it stops when navigation does:\n"
      "  incognita robot --relay ws://localhost:9090 --address 0.0.0.0\n");
  command->callback([o, &job] { job = [o] { return run_robot(*o); }; });
  return command;
}

}  // namespace incognita
