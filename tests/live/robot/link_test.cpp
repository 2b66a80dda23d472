// The two ends of the link against each other, over a socket of this machine.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "incognita/live/robot/robot_client.hpp"
#include "incognita/live/robot/rosbridge_channel.hpp"
#include "incognita/messages/errors.hpp"
#include "tests/live/client.hpp"

namespace incognita {
namespace {

using namespace std::chrono_literals;
using testing::RawConnection;
using testing::WebSocketClient;
using Json = nlohmann::json;
using SteadyClock = std::chrono::steady_clock;

/// Waits until something is so; at most five seconds.
template <class Condition>
bool becomes(const Condition& condition) {
  for (int i = 0; i < 1000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

/// A robot's rosbridge server that notes what it is commanded.
struct Robot {
  explicit Robot(std::uint16_t port = 0) {
    RosbridgeChannelHandlers handlers;
    handlers.published = [this](std::uint64_t, const rosbridge::Publish& publish) {
      const std::lock_guard lock(mutex);
      if (publish.topic == topics.command) commands.push_back({SteadyClock::now(), ros::twist(publish.msg)});
      if (publish.topic == topics.stop) stops.push_back(ros::boolean(publish.msg));
    };
    handlers.left = [this](std::uint64_t) { ++lefts; };
    channel = std::make_shared<RosbridgeChannel>(
        std::map<std::string, std::string>{{topics.image, ros::compressed_image_type},
                                           {topics.command, ros::twist_type}},
        std::move(handlers));
    ServerHandlers served;
    served.answer = [](const HttpRequest&) { return HttpAnswer{}; };
    served.protocols = {{"", channel}};
    served.log = [](const std::string&) {};
    ServerSettings settings;
    settings.websocket_path = "/";
    settings.port = port;
    server = std::make_unique<Server>(settings, std::move(served),
                                      [this](Server& made) { channel->attach(made); });
  }
  void publish_image(std::int64_t stamp_ns, std::size_t bytes = 100) {
    channel->publish(topics.image,
                     to_json(ros::CompressedImage{{stamp_ns, "c"}, "jpeg", std::string(bytes, 'x')}, 2));
  }
  Eigen::Vector2d last_velocity() {
    const std::lock_guard lock(mutex);
    if (commands.empty()) return {NAN, NAN};
    const ros::Twist& twist = commands.back().second.twist;
    return {twist.linear.x(), twist.angular.z()};
  }
  std::size_t count() {
    const std::lock_guard lock(mutex);
    return commands.size();
  }

  RobotTopics topics;
  std::mutex mutex;
  std::vector<std::pair<SteadyClock::time_point, ros::StampedTwist>> commands;
  std::vector<bool> stops;
  std::atomic<int> lefts = 0;
  std::shared_ptr<RosbridgeChannel> channel;
  std::unique_ptr<Server> server;
};

RobotClientSettings at(const Robot& robot) {
  RobotClientSettings settings;
  settings.address = "ws://127.0.0.1:" + std::to_string(robot.server->port());
  settings.command_period_s = 0.05;
  return settings;
}

/// Publishes until the client has subscribed and received.
std::optional<RobotClient::Received> first_image(Robot& robot, RobotClient& client) {
  for (int i = 0; i < 200; ++i) {
    robot.publish_image(1'000'000'000 + i);
    if (auto received = client.receive(0.02)) return received;
  }
  return std::nullopt;
}

TEST(RobotLink, ImagesArriveWithTheirStampsAndTheNewestWins) {
  Robot robot;
  RobotClient client(at(robot));
  ASSERT_TRUE(first_image(robot, client));
  while (client.receive(0.2)) {
  }
  // Each image is awaited before the next: the server replaces an image that it could not send yet, and how many those are
  // depends on the load of the machine.
  const auto before = client.counts();
  for (int i = 0; i < 20; ++i) {
    robot.publish_image(5'000'000'000 + i);
    ASSERT_TRUE(becomes([&] { return client.counts().images > before.images + i; })) << i;
  }
  const auto received = client.receive(1);
  ASSERT_TRUE(received);
  EXPECT_EQ(received->image.header.stamp_ns, 5'000'000'019);
  EXPECT_EQ(received->image.data, std::string(100, 'x'));
  EXPECT_EQ(client.counts().images, before.images + 20);
  EXPECT_EQ(client.counts().dropped_images, before.dropped_images + 19);
  EXPECT_FALSE(client.receive(0.05)) << "each image is returned once";
}

TEST(RobotLink, OdometryComesWithTheNextImage) {
  Robot robot;
  RobotClient client(at(robot));
  ASSERT_TRUE(first_image(robot, client));
  ros::Odometry odometry;
  for (int i = 0; i < 3; ++i) {
    odometry.header.stamp_ns = i;
    odometry.twist.linear.x() = 0.1 * i;
    robot.channel->publish(robot.topics.odometry, to_json(odometry, 1));
  }
  robot.publish_image(7);
  const auto received = client.receive(2);
  ASSERT_TRUE(received);
  ASSERT_EQ(received->odometry.size(), 3u);
  EXPECT_EQ(received->odometry[2].velocity[0], 0.2);
}

TEST(RobotLink, TheHeartbeatRepeatsTheVelocityAndThenZero) {
  Robot robot;
  RobotClient client(at(robot));
  ASSERT_TRUE(first_image(robot, client));
  const auto begin = SteadyClock::now();
  client.drive({0.2, -0.1});
  ASSERT_TRUE(becomes([&] { return robot.last_velocity() == Eigen::Vector2d(0.2, -0.1); }));
  ASSERT_TRUE(becomes([&] { return robot.last_velocity() == Eigen::Vector2d(0, 0); }));
  const std::chrono::duration<double> driven = SteadyClock::now() - begin;
  EXPECT_GT(driven.count(), 0.29) << "late_s";
  const std::size_t before = robot.count();
  std::this_thread::sleep_for(300ms);
  EXPECT_GE(robot.count(), before + 3) << "the heartbeat goes on with zeros";
}

TEST(RobotLink, AStopIsObeyedAtOnceAndUntilItIsReleased) {
  Robot robot;
  RobotClient client(at(robot));
  ASSERT_TRUE(first_image(robot, client));
  client.drive({0.2, 0});
  ASSERT_TRUE(becomes([&] { return robot.last_velocity()[0] == 0.2; }));
  client.set_stopped(true);
  ASSERT_TRUE(becomes([&] { return robot.last_velocity().isZero(); }));
  client.drive({0.2, 0});
  std::this_thread::sleep_for(150ms);
  EXPECT_TRUE(robot.last_velocity().isZero());
  client.set_stopped(false);
  std::this_thread::sleep_for(150ms);
  EXPECT_TRUE(robot.last_velocity().isZero()) << "the velocity from before does not come back";
  client.drive({0.1, 0});
  ASSERT_TRUE(becomes([&] { return robot.last_velocity()[0] == 0.1; }));
  const std::lock_guard lock(robot.mutex);
  EXPECT_EQ(robot.stops, (std::vector{true, false}));
}

TEST(RobotLink, StampsCommandsWithTheClockOfTheRobot) {
  Robot robot;
  RobotClientSettings settings = at(robot);
  settings.stamps_commands = true;
  RobotClient client(settings);
  ASSERT_TRUE(first_image(robot, client));
  robot.publish_image(77'000'000'000);
  ASSERT_TRUE(client.receive(2));
  std::this_thread::sleep_for(200ms);
  client.drive({0.2, 0});
  ASSERT_TRUE(becomes([&] { return robot.last_velocity()[0] == 0.2; }));
  const std::lock_guard lock(robot.mutex);
  const double stamp_s = 1e-9 * static_cast<double>(robot.commands.back().second.stamp_ns.value_or(0));
  EXPECT_GT(stamp_s, 77.19);
  EXPECT_LT(stamp_s, 78);
}

TEST(RobotLink, ConnectsAgainWhenTheRobotComesBack) {
  auto robot = std::make_unique<Robot>();
  const std::uint16_t port = robot->server->port();
  RobotClient client(at(*robot));
  ASSERT_TRUE(first_image(*robot, client));
  robot.reset();
  ASSERT_TRUE(becomes([&] { return !client.problem().empty(); }));
  client.drive({0.3, 0});  // lost: a command must not wait for the next connection
  std::this_thread::sleep_for(500ms);
  robot = std::make_unique<Robot>(port);
  ASSERT_TRUE(first_image(*robot, client));
  EXPECT_EQ(client.counts().connections, 2u);
  ASSERT_TRUE(becomes([&] { return robot->count() > 0; }));
  const std::lock_guard lock(robot->mutex);
  for (const auto& [when, command] : robot->commands) EXPECT_EQ(command.twist.linear.x(), 0);
  std::string events;
  for (const std::string& event : client.take_events()) events += event + "\n";
  EXPECT_NE(events.find("lost the connection"), std::string::npos) << events;
}

/// A release that is repeated would undo the stops of others.
TEST(RobotLink, AReleaseIsPublishedOnceAndAStopAgain) {
  auto robot = std::make_unique<Robot>();
  const std::uint16_t port = robot->server->port();
  RobotClient client(at(*robot));
  const auto stops = [&] {
    const std::lock_guard lock(robot->mutex);
    return robot->stops;
  };
  const auto end_connection = [&] {
    robot.reset();
    return becomes([&] { return !client.problem().empty(); });
  };
  const auto connects_again = [&] {
    robot = std::make_unique<Robot>(port);
    return first_image(*robot, client) && becomes([&] { return robot->count() > 2; });
  };
  ASSERT_TRUE(first_image(*robot, client));
  client.set_stopped(true);
  client.set_stopped(false);
  ASSERT_TRUE(becomes([&] { return !stops().empty() && !stops().back(); }));
  ASSERT_TRUE(end_connection());
  ASSERT_TRUE(connects_again());
  EXPECT_TRUE(stops().empty()) << "said before";
  client.set_stopped(true);
  ASSERT_TRUE(becomes([&] { return stops() == std::vector{true}; }));
  ASSERT_TRUE(end_connection());
  ASSERT_TRUE(connects_again());
  EXPECT_EQ(stops(), std::vector{true}) << "again";
  ASSERT_TRUE(end_connection());
  client.set_stopped(false);
  ASSERT_TRUE(connects_again());
  EXPECT_EQ(stops(), std::vector{false}) << "released while there was no connection";
  ASSERT_TRUE(end_connection());
  client.set_stopped(true);
  client.set_stopped(false);
  ASSERT_TRUE(connects_again());
  EXPECT_TRUE(stops().empty()) << "the robot never heard of this stop";
}

TEST(RosbridgeClient, AHandlerThatFailsDoesNotEndTheHeartbeat) {
  std::atomic<int> beats = 0;
  RosbridgeClientSettings settings{parse_websocket_address("ws://127.0.0.1:1")};
  settings.heartbeat_s = 0.01;
  RosbridgeClientHandlers handlers;
  handlers.heartbeat = [&] {
    if (++beats == 1) throw std::runtime_error("no memory");
  };
  RosbridgeClient client(settings, handlers);
  client.start();
  EXPECT_TRUE(becomes([&] { return beats > 3; }));
}

TEST(RobotLink, SaysWhyThereIsNoConnection) {
  RobotClientSettings settings;
  settings.address = "ws://127.0.0.1:1";
  RobotClient client(settings);
  ASSERT_TRUE(becomes([&] { return client.problem().find("refused") != std::string::npos; }))
      << client.problem();
  EXPECT_FALSE(client.receive(0.01));
}

TEST(RobotLink, StopsTheRobotWhenItEnds) {
  Robot robot;
  {
    RobotClient client(at(robot));
    ASSERT_TRUE(first_image(robot, client));
    client.drive({0.2, 0});
    ASSERT_TRUE(becomes([&] { return robot.last_velocity()[0] == 0.2; }));
  }
  ASSERT_TRUE(becomes([&] { return robot.lefts == 1; }));
  EXPECT_TRUE(robot.last_velocity().isZero());
}

TEST(RobotLink, SkipsMessagesThatAreNotValid) {
  Robot robot;
  RobotClient client(at(robot));
  ASSERT_TRUE(first_image(robot, client));
  robot.channel->publish(robot.topics.image, R"({"header": 3})");
  robot.channel->publish(robot.topics.image, "garbage");
  ASSERT_TRUE(first_image(robot, client));
  EXPECT_EQ(client.counts().connections, 1u);
}

// ---- the server against clients that are wrong

TEST(RosbridgeServer, AnswersGarbageWithAStatusAndGoesOn) {
  Robot robot;
  WebSocketClient client(robot.server->port(), "/", "");
  ASSERT_EQ(client.status(), 101);
  for (const char* text :
       {"", "{", "[]", R"({"op": 1})", R"({"op": "publish", "topic": "/cmd_vel", "msg": {"linear": 1}})",
        R"({"op": "send_action_goal", "id": "3"})",
        R"({"op": "fragment", "data": "", "num": 0, "total": 0})"}) {
    ASSERT_TRUE(client.send(text));
    const auto answer = client.receive();
    ASSERT_TRUE(answer) << text;
    EXPECT_EQ(Json::parse(*answer)["op"], "status") << *answer;
    EXPECT_EQ(Json::parse(*answer)["level"], "error") << *answer;
  }
  ASSERT_TRUE(client.send(R"({"op": "call_service", "service": "/rosapi/topics", "id": "c1"})"));
  const Json refused = Json::parse(client.receive().value_or("{}"));
  EXPECT_EQ(refused["op"], "service_response");
  EXPECT_EQ(refused["id"], "c1");
  EXPECT_EQ(refused["result"], false);
  EXPECT_EQ(robot.count(), 0u);
}

TEST(RosbridgeServer, SaysWhenATypeIsAnother) {
  Robot robot;
  WebSocketClient client(robot.server->port(), "/", "");
  ASSERT_TRUE(
      client.send(R"({"op": "advertise", "topic": "/cmd_vel", "type": "std_msgs/String", "id": "a"})"));
  const auto answer = client.receive();
  ASSERT_TRUE(answer);
  EXPECT_NE(answer->find("has type geometry_msgs/Twist"), std::string::npos) << *answer;
}

TEST(RosbridgeServer, SendsFragmentsWhereTheyAreAskedForAndHonorsUnsubscriptions) {
  Robot robot;
  WebSocketClient client(robot.server->port(), "/", "");
  ASSERT_TRUE(client.send(
      R"({"op": "subscribe", "topic": "/camera/image_raw/compressed", "fragment_size": 50, "id": "s"})"));
  std::this_thread::sleep_for(100ms);
  robot.publish_image(3);
  rosbridge::FragmentAssembler assembler;
  std::optional<std::string> whole;
  while (!whole) {
    const auto part = client.receive();
    ASSERT_TRUE(part);
    whole = assembler.add(std::get<rosbridge::Fragment>(rosbridge::parse(*part)));
  }
  EXPECT_EQ(ros::compressed_image(std::get<rosbridge::Publish>(rosbridge::parse(*whole)).msg).header.stamp_ns,
            3);
  ASSERT_TRUE(client.send(R"({"op": "unsubscribe", "topic": "/camera/image_raw/compressed", "id": "s"})"));
  std::this_thread::sleep_for(100ms);
  robot.publish_image(4);
  EXPECT_FALSE(client.receive());
}

TEST(RosbridgeServer, ThrottlesASubscription) {
  Robot robot;
  WebSocketClient client(robot.server->port(), "/", "");
  ASSERT_TRUE(
      client.send(R"({"op": "subscribe", "topic": "/camera/image_raw/compressed", "throttle_rate": 60000})"));
  std::this_thread::sleep_for(100ms);
  for (int i = 0; i < 5; ++i) robot.publish_image(i);
  EXPECT_TRUE(client.receive());
  EXPECT_FALSE(client.receive());
}

TEST(RosbridgeServer, AClientThatNeverReadsSlowsNobody) {
  Robot robot;
  WebSocketClient lazy(robot.server->port(), "/", "");
  ASSERT_TRUE(lazy.send(R"({"op": "subscribe", "topic": "/camera/image_raw/compressed"})"));
  RobotClient client(at(robot));
  ASSERT_TRUE(first_image(robot, client));
  for (int i = 0; i < 100; ++i) {
    robot.publish_image(10'000'000'000 + i, 300'000);  // together more than any buffer
    ASSERT_TRUE(client.receive(2)) << i;
  }
}

TEST(RosbridgeServer, NoticesAClientThatDiesInAnyState) {
  Robot robot;
  {
    const RawConnection silent(robot.server->port());
    WebSocketClient subscribed(robot.server->port(), "/", "");
    ASSERT_TRUE(subscribed.send(R"({"op": "subscribe", "topic": "/camera/image_raw/compressed"})"));
    const RawConnection half(robot.server->port());
    half.send("GET / HTTP/1.1\r\nUpgrade: webso");
  }
  EXPECT_TRUE(becomes([&] { return robot.lefts == 1; }));
  robot.publish_image(1);
  RobotClient client(at(robot));
  EXPECT_TRUE(first_image(robot, client));
}

TEST(RosbridgeServer, OffersNoSubprotocolAndRefusesClientsThatWantOne) {
  Robot robot;
  EXPECT_EQ(WebSocketClient(robot.server->port(), "/", "incognita.v1").status(), 400);
  EXPECT_EQ(WebSocketClient(robot.server->port(), "/ws", "").status(), 404);
}

}  // namespace
}  // namespace incognita
