// The simulated robot: its watchdog in explicit time, its server against clients, its relay, its log.
#include "incognita/app/robot/simulated_robot.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "incognita/app/loop/linked_robot.hpp"
#include "incognita/app/robot/robot_relay.hpp"
#include "incognita/app/robot/robot_server.hpp"
#include "incognita/record/files/image_text.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using namespace std::chrono_literals;
using Stop = CommandWatchdog::Stop;
using testing::message_of;
using testing::Scratch;

const LoadedScenario& terrain() {
  static const LoadedScenario loaded = load_scenario("explore-terrain");
  return loaded;
}

template <class Condition>
bool becomes(const Condition& condition) {
  for (int i = 0; i < 1000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

TEST(SimulatedRobot, StandsWithoutCommandsAndStopsExactlyAtItsWatchdogTime) {
  SimulatedRobot robot(terrain(), {.timeout_s = 0.5, .stale_s = 0.5});
  const Eigen::Vector3d start = robot.state().pose;
  robot.advance(1);
  EXPECT_LT((robot.state().pose - start).head<2>().norm(), 0.01) << "but for the true errors of its wheels";
  EXPECT_TRUE(robot.state().executed.isZero());
  EXPECT_EQ(robot.state().reason, Stop::no_command);
  const Eigen::Vector3d before = robot.state().pose;
  robot.watchdog().command({-0.2, 0}, 1.0123, 1);
  double last_driven_s = 0;
  robot.advance(3, [&](const RobotState& state) {
    if (!state.executed.isZero()) last_driven_s = state.t;
  });
  EXPECT_NEAR(last_driven_s, 1.5123, 0.001);
  EXPECT_EQ(robot.state().reason, Stop::silence);
  const double way = (robot.state().pose - before).head<2>().norm();
  EXPECT_NEAR(way, 0.2 * 0.5, 0.02);
}

/// Times that are no round numbers: the step that ends at the watchdog time is followed by none that moves.
TEST(SimulatedRobot, NeverMovesPastItsWatchdogTime) {
  SimulatedRobot robot(terrain(), {.timeout_s = 0.05, .stale_s = 0.5});
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    robot.advance(robot.state().t + std::uniform_real_distribution<>(0, 0.02)(random));
    robot.watchdog().command({i % 2 == 0 ? 0.1 : -0.1, 0}, robot.state().t, 1);
    robot.advance(robot.state().t + std::uniform_real_distribution<>(0.04, 0.1)(random),
                  [](const RobotState& state) {
                    if (!state.executed.isZero()) {
                      EXPECT_LE(state.t, *state.command_t + 0.05);
                    }
                  });
  }
}

TEST(SimulatedRobot, AvoidsTheWallByItself) {
  SimulatedRobot robot(terrain(), {.timeout_s = 100, .stale_s = 0.5});
  robot.watchdog().command({0.3, 0}, 0, 1);  // it faces the wall at +x
  for (int i = 1; i <= 100; ++i) {
    robot.measure();
    robot.advance(0.1 * i);
    ASSERT_LT(robot.state().pose.x(), 3 - terrain().scenario.room.clearance_m + 1e-6);
  }
  EXPECT_LT(robot.state().pose.x(), 2.8);
}

TEST(SimulatedRobot, RefusesAScenarioWithoutAVehicle) {
  EXPECT_HAS(message_of([] { SimulatedRobot(load_scenario("explore-room"), {}); }), "vehicle.model");
}

TEST(RobotLog, ItsLastPoseIsWhereTheRobotGoesOn) {
  const Scratch scratch;
  RobotState state;
  {
    RobotLog log(scratch.folder(), false);
    state.t = 0.5, state.pose = {1, -2, 0.25};
    log.add_step(state, 1000);
    log.add_image(state, 1000.5);
    log.flush();
  }
  EXPECT_EQ(last_pose(scratch.folder()), Eigen::Vector3d(1, -2, 0.25));
  std::ofstream(scratch / "robot.csv", std::ios::app) << "1001.0,driving,,0.1,0";  // killed while writing
  EXPECT_EQ(last_pose(scratch.folder()), Eigen::Vector3d(1, -2, 0.25));
  {
    RobotLog log(scratch.folder(), true);
    state.t = 0.1, state.pose = {3, 0, 0};
    log.add_step(state, 2000);
  }
  EXPECT_EQ(testing::lines(scratch / "truth.tum").size(), 1u);
  EXPECT_EQ(testing::lines(scratch / "robot.csv").size(), 3u) << testing::contents(scratch / "robot.csv");
  EXPECT_EQ(last_pose(scratch.folder()), Eigen::Vector3d(3, 0, 0));
  testing::write(scratch / "robot.csv", "t\nx,y\n");
  EXPECT_HAS(message_of([&] { last_pose(scratch.folder()); }), "robot.csv, line 2");
  EXPECT_HAS(message_of([&] { RobotLog(scratch.folder(), true); }), "robot.csv, line 1");
  EXPECT_EQ(testing::contents(scratch / "robot.csv"), "t\nx,y\n") << "left as it is";
  testing::write(scratch / "robot.csv", "notes");
  EXPECT_HAS(message_of([&] { RobotLog(scratch.folder(), true); }), "robot.csv, line 1");
  EXPECT_EQ(testing::contents(scratch / "robot.csv"), "notes");
  testing::write(scratch / "robot.csv", "t,sta");  // killed while writing the first line
  RobotLog(scratch.folder(), true);
  EXPECT_EQ(testing::contents(scratch / "robot.csv"), std::string(RobotLog::columns) + "\n");
  EXPECT_FALSE(last_pose(scratch / "nowhere"));
}

/// The simulated robot at a free port, in a thread.
struct Running {
  explicit Running(const std::filesystem::path& folder,
                   CommandWatchdog::Settings watchdog = {.timeout_s = 0.3, .stale_s = 0.3}) {
    server = std::make_unique<RobotServer>(terrain(), std::make_unique<SimulatedRobot>(terrain(), watchdog),
                                           RobotLog(folder, false), RobotServerSettings{},
                                           [](const std::string&) {});
    thread = std::thread([this] { server->run([this] { return over.load(); }); });
  }
  ~Running() {
    over = true;
    thread.join();
  }
  std::unique_ptr<RobotServer> server;
  std::atomic<bool> over = false;
  std::thread thread;
};

RobotClientSettings at(std::uint16_t port) {
  RobotClientSettings settings;
  settings.address = "ws://127.0.0.1:" + std::to_string(port);
  settings.command_period_s = 0.05;
  return settings;
}

/// Rows of robot.csv: t, command_t and speed of those with a command.
std::vector<Eigen::Vector3d> commanded_rows(const std::filesystem::path& folder) {
  std::vector<Eigen::Vector3d> rows;
  for (const std::string& line : testing::lines(folder / "robot.csv")) {
    double t = 0, command_t = 0, speed = 0;
    char state[40];
    if (std::sscanf(line.c_str(), "%lf,%39[^,],%lf,%lf", &t, state, &command_t, &speed) == 4)
      rows.push_back({t, command_t, speed});
  }
  return rows;
}

TEST(RobotServer, AClientGetsImagesOdometryAndCalibrationAndDrives) {
  const Scratch scratch;
  const Running robot(scratch.folder());
  RobotClient client(at(robot.server->port()));
  int images = 0;
  bool moved = false;
  for (int i = 0; i < 100 && !(images > 3 && moved && client.camera_info()); ++i) {
    const auto received = client.receive(1);
    client.drive({-0.2, 0});
    if (!received) continue;
    ++images;
    for (const auto& odometry : received->odometry) moved |= odometry.velocity[0] < -0.1;
  }
  EXPECT_GT(images, 3);
  EXPECT_TRUE(moved);
  ASSERT_TRUE(client.camera_info());
  EXPECT_TRUE(differences(*client.camera_info(), terrain().scenario.camera).empty());
  CameraSettings other = terrain().scenario.camera;
  other.fu_px *= 1.02;
  EXPECT_EQ(differences(*client.camera_info(), other).size(), 1u);
}

TEST(RobotServer, StopsWithinItsWatchdogTimeWhenTheClientIsGone) {
  const Scratch scratch;
  {
    const Running robot(scratch.folder());
    for (int i = 0; i < 3; ++i) {
      RosbridgeClient client({parse_websocket_address(at(robot.server->port()).address)}, {});
      client.start();
      ASSERT_TRUE(becomes([&] { return client.is_connected(); }));
      for (int k = 0; k < 10; ++k) {
        client.send(to_json(rosbridge::Publish{"/cmd_vel", R"({"linear": {"x": -0.1}})"}));
        std::this_thread::sleep_for(20ms);
      }
    }
    std::this_thread::sleep_for(600ms);
  }
  const auto rows = commanded_rows(scratch.folder());
  ASSERT_FALSE(rows.empty());
  bool drove = false;
  for (const auto& row : rows)
    if (row[2] != 0) {
      drove = true;
      EXPECT_LE(row[0] - row[1], 0.3 + 1e-5);
    }
  EXPECT_TRUE(drove);
  EXPECT_EQ(rows.back()[2], 0);
}

TEST(RobotRelay, PassesImagesAndCommandsOnAndStopsTheRobotWhenNavigationIsSilent) {
  const Scratch scratch;
  const Running robot(scratch.folder(),
                      {.timeout_s = 10, .stale_s = 10});  // as a robot without a watchdog of its own
  RobotRelaySettings settings;
  settings.robot = at(robot.server->port()).address;
  settings.watchdog = {.timeout_s = 0.3, .stale_s = 0.3};
  std::string said;
  std::mutex mutex;
  const RobotRelay relay(settings, [&](const std::string& line) {
    const std::lock_guard lock(mutex);
    said += line + "\n";
  });
  {
    RobotClient client(at(relay.port()));
    ASSERT_TRUE(becomes([&] { return client.receive(0.1).has_value(); }));
    const auto drives = [&] {
      client.drive({-0.1, 0});
      const auto received = client.receive(0.1);
      return received && !received->odometry.empty() && received->odometry.back().velocity[0] == -0.1;
    };
    EXPECT_TRUE(becomes(drives));
    EXPECT_EQ(relay.reason(), Stop::none);
    client.set_stopped(true);
    EXPECT_TRUE(becomes([&] { return relay.reason() == Stop::by_hand; }));
    client.set_stopped(false);
    EXPECT_TRUE(becomes(drives));
  }
  EXPECT_TRUE(becomes([&] { return relay.reason() == Stop::disconnected; }));
  EXPECT_TRUE(becomes([&] {
    const auto rows = commanded_rows(scratch.folder());
    return !rows.empty() && rows.back()[2] == 0;
  }));
}

/// A robot's rosbridge that notes commands and publishes what the test wants.
struct StubRobot {
  StubRobot() {
    RosbridgeChannelHandlers handlers;
    handlers.published = [this](std::uint64_t, const rosbridge::Publish& publish) {
      if (publish.topic == topics.command) speed = ros::twist(publish.msg).twist.linear.x();
    };
    channel = std::make_shared<RosbridgeChannel>(types_of(topics), std::move(handlers));
    server = rosbridge_server({}, channel, [](const std::string&) {});
  }
  RobotTopics topics;
  std::atomic<double> speed = NAN;  ///< of the last command
  std::shared_ptr<RosbridgeChannel> channel;
  std::unique_ptr<Server> server;  ///< ends first
};

/// One who sends what no client of this program would.
struct RawCommander {
  explicit RawCommander(std::uint16_t port) : client({parse_websocket_address(at(port).address)}, {}) {
    client.start();
  }
  void command(const std::string& msg) { client.send(to_json(rosbridge::Publish{"/cmd_vel", msg})); }
  void drive() { command(R"({"linear": {"x": 0.2}})"); }
  RosbridgeClient client;
};

RobotRelaySettings before(const StubRobot& robot, double timeout_s) {
  RobotRelaySettings settings;
  settings.robot = at(robot.server->port()).address;
  settings.watchdog = {.timeout_s = timeout_s, .stale_s = timeout_s};
  return settings;
}

TEST(RobotRelay, StopsTheRobotInTimeWhileATerminalBlocksItsMessages) {
  StubRobot robot;
  std::promise<void> unblocked;
  const std::shared_future<void> blocked = unblocked.get_future().share();
  std::atomic<int> said = 0;
  std::atomic<bool> over = false;
  RobotRelay relay(before(robot, 0.3), [&](const std::string&) {
    ++said;
    blocked.wait();
  });
  std::thread thread([&] { relay.run([&] { return over.load(); }); });
  RawCommander commander(relay.port());
  EXPECT_TRUE(becomes([&] {
    commander.drive();
    return robot.speed == 0.2;
  }));
  EXPECT_TRUE(becomes([&] { return said == 1; }));
  const auto silent_since = std::chrono::steady_clock::now();
  EXPECT_TRUE(becomes([&] { return robot.speed == 0; }));
  EXPECT_LT(std::chrono::steady_clock::now() - silent_since, 1s);
  EXPECT_EQ(relay.reason(), Stop::silence);
  EXPECT_EQ(said, 1) << "still blocked";
  over = true;
  unblocked.set_value();
  thread.join();
}

TEST(RobotRelay, ObeysAStopThatIsPublishedOnTheRobot) {
  StubRobot robot;
  const RobotRelay relay(before(robot, 10), [](const std::string&) {});
  RawCommander commander(relay.port());
  const auto drives = [&] {
    commander.drive();
    return relay.reason() == Stop::none && robot.speed == 0.2;
  };
  EXPECT_TRUE(becomes(drives));
  robot.channel->publish(robot.topics.stop, ros::to_json(true));
  EXPECT_TRUE(becomes([&] { return relay.reason() == Stop::by_hand && robot.speed == 0; }));
  commander.drive();
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(robot.speed, 0);
  robot.channel->publish(robot.topics.stop, R"({"data": "garbage"})");
  robot.channel->publish(robot.topics.stop, ros::to_json(false));
  EXPECT_TRUE(becomes(drives));
}

TEST(RobotRelay, StopsOnACommandThatIsNotValid) {
  StubRobot robot;
  const RobotRelay relay(before(robot, 10), [](const std::string&) {});
  RawCommander commander(relay.port());
  const auto drives = [&] {
    commander.drive();
    return relay.reason() == Stop::none && robot.speed == 0.2;
  };
  const auto stands = [&] { return relay.reason() == Stop::invalid && robot.speed == 0; };
  EXPECT_TRUE(becomes(drives));
  std::this_thread::sleep_for(100ms);  // commands that wait
  commander.command(R"({"linear": 1})");
  EXPECT_TRUE(becomes(stands));
  EXPECT_TRUE(becomes(drives));
  std::this_thread::sleep_for(100ms);
  commander.command(R"({"linear": {"x": NaN}})");  // as Python writes it, which is no JSON
  EXPECT_TRUE(becomes(stands));
}

TEST(RobotServer, StopsOnACommandThatIsNotValid) {
  const Scratch scratch;
  const Running robot(scratch.folder(), {.timeout_s = 10, .stale_s = 10});
  RawCommander commander(robot.server->port());
  const auto log_has = [&](const char* state) {
    return testing::contents(scratch / "robot.csv").find(state) != std::string::npos;
  };
  EXPECT_TRUE(becomes([&] {
    commander.command(R"({"linear": {"x": -0.1}})");
    return log_has(",driving,");
  }));
  commander.command(R"({"linear": {"x": 1e999}})");
  EXPECT_TRUE(becomes([&] { return log_has(",invalid command,"); }));
}

TEST(LinkedRobot, KeepsTheOdometryOfAnImageThatCannotBeDecoded) {
  StubRobot robot;
  const std::vector<std::string> sets{"robot.address=" + at(robot.server->port()).address};
  const LoadedScenario loaded = load_scenario("robot", sets);
  const CameraSettings& camera = loaded.scenario.camera;
  const std::string good = jpeg(Image(camera.width_px, camera.height_px), 90);
  std::int64_t stamp_ns = 0;
  const auto publish = [&](const std::string& data) {
    ros::Odometry odometry;
    odometry.header.stamp_ns = (stamp_ns += 1'000'000);
    robot.channel->publish(robot.topics.odometry, to_json(odometry, 2));
    robot.channel->publish(robot.topics.image,
                           to_json(ros::CompressedImage{{stamp_ns, "camera"}, "jpeg", data}, 2));
  };
  LinkedRobot link(loaded.scenario);
  const auto undecoded = [&] {
    for (const auto& [name, count] : link.counts())
      if (name == "robot_undecoded_images") return count;
    return std::int64_t{-1};
  };
  ASSERT_TRUE(becomes([&] {
    publish(good);
    return link.read(0.05).has_value();
  }));
  while (link.read(0.1)) continue;
  publish("garbage");
  ASSERT_TRUE(becomes([&] { return link.read(0.1) || undecoded() == 1; }));
  publish(good);
  std::optional<LiveReading> reading;
  ASSERT_TRUE(becomes([&] { return (reading = link.read(0.1)).has_value(); }));
  EXPECT_EQ(reading->odometry.size(), 2u);
}

TEST(RobotRelay, GoesOnWhenTheRobotComesLater) {
  const Scratch scratch;
  std::uint16_t port = 0;
  {
    const Running first(scratch.folder());
    port = first.server->port();
  }
  RobotRelaySettings settings;
  settings.robot = at(port).address;
  const RobotRelay relay(settings, [](const std::string&) {});
  RobotClient client(at(relay.port()));
  EXPECT_FALSE(client.receive(0.3));
  RobotServerSettings again;
  again.server.port = port;
  RobotServer server(terrain(), std::make_unique<SimulatedRobot>(terrain(), CommandWatchdog::Settings{}),
                     RobotLog(scratch.folder(), false), again, [](const std::string&) {});
  std::atomic<bool> over = false;
  std::thread thread([&] { server.run([&] { return over.load(); }); });
  EXPECT_TRUE(becomes([&] { return client.receive(0.1).has_value(); }));
  over = true;
  thread.join();
}

}  // namespace
}  // namespace incognita
