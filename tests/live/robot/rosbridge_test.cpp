// The rosbridge protocol: what is read and written, against its specification, and garbage.
#include "incognita/live/robot/rosbridge.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "incognita/live/robot/fragments.hpp"
#include "incognita/live/robot/websocket_address.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using namespace rosbridge;
using testing::message_of;
using Json = nlohmann::json;

TEST(Rosbridge, ReadsASubscriptionWithAllItsFields) {
  const auto operation =
      parse(R"({"op": "subscribe", "id": "s:1", "topic": "/odom", "type": "nav_msgs/Odometry",
    "throttle_rate": 50, "queue_length": 2, "fragment_size": 1000, "compression": "png"})");
  const auto& wish = std::get<Subscribe>(operation);
  EXPECT_EQ(wish.topic, "/odom");
  EXPECT_EQ(wish.type, "nav_msgs/Odometry");
  EXPECT_EQ(wish.id, "s:1");
  EXPECT_EQ(wish.throttle_ms, 50);
  EXPECT_EQ(wish.queue_length, 2);
  EXPECT_EQ(wish.fragment_bytes, 1000);
  EXPECT_EQ(wish.compression, "png");
}

TEST(Rosbridge, ASubscriptionNeedsOnlyItsTopic) {
  const auto wish = std::get<Subscribe>(parse(R"({"op": "subscribe", "topic": "/odom"})"));
  EXPECT_EQ(wish.throttle_ms, 0);
  EXPECT_EQ(wish.queue_length, 0);
  EXPECT_EQ(wish.compression, "none");
}

TEST(Rosbridge, AnIdMayBeAnInteger) {
  EXPECT_EQ(std::get<Unsubscribe>(parse(R"({"op": "unsubscribe", "topic": "/a", "id": 7})")).id, "7");
}

TEST(Rosbridge, ReadsWhatItWrites) {
  const auto publish = std::get<Publish>(parse(to_json(Publish{"/\"a\"", R"({"data": [1, {"x": "é\n"}]})"})));
  EXPECT_EQ(publish.topic, "/\"a\"");
  EXPECT_EQ(Json::parse(publish.msg), Json::parse(R"({"data": [1, {"x": "é\n"}]})"));
  const auto advertise =
      std::get<Advertise>(parse(to_json(Advertise{"/cmd_vel", "geometry_msgs/Twist", "a"})));
  EXPECT_EQ(advertise.topic + advertise.type + advertise.id, "/cmd_velgeometry_msgs/Twista");
  EXPECT_EQ(std::get<Unadvertise>(parse(to_json(Unadvertise{"/t"}))).topic, "/t");
  EXPECT_EQ(std::get<Unsubscribe>(parse(to_json(Unsubscribe{"/t", "5"}))).id, "5");
  const auto status = std::get<Status>(parse(to_json(Status{"error", "no", "9"})));
  EXPECT_EQ(status.level + status.msg + status.id, "errorno9");
  Subscribe wish{"/t", "a/B", "i", 10, 3, 100, "none"};
  const auto read = std::get<Subscribe>(parse(to_json(wish)));
  EXPECT_EQ(read.throttle_ms, 10);
  EXPECT_EQ(read.queue_length, 3);
  EXPECT_EQ(read.fragment_bytes, 100);
}

TEST(Rosbridge, NamesTheOperationAndTheFieldThatAreWrong) {
  const auto why = [](const char* text) { return message_of([&] { parse(text); }); };
  EXPECT_HAS(why("[1]"), "must be a JSON object");
  EXPECT_HAS(why("{\"op\": 3}"), "\"op\" must be a text");
  EXPECT_HAS(why(R"({"op": "publish", "topic": "/a"})"), "publish: field \"msg\" must be an object");
  EXPECT_HAS(why(R"({"op": "publish", "topic": "", "msg": {}})"), "\"topic\" must have 1 to 256");
  EXPECT_HAS(why(R"({"op": "subscribe", "topic": "/a", "throttle_rate": -1})"),
             "\"throttle_rate\" must be a number from 0");
  EXPECT_HAS(why(R"({"op": "subscribe", "topic": "/a", "queue_length": 1e300})"), "\"queue_length\"");
  EXPECT_HAS(why(R"({"op": "fragment", "id": "1", "data": "x", "num": 2, "total": 2})"),
             "must be less than total");
  EXPECT_HAS(why(R"({"op": "advertise", "topic": "/a"})"), "\"type\"");
}

TEST(Rosbridge, SurvivesATruncationAtEveryByteAndDeepNesting) {
  const std::string whole = R"({"op": "publish", "topic": "/cmd_vel", "msg": {"linear": {"x": 0.1}}})";
  for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_THROW(parse(whole.substr(0, n)), InputError) << n;
  EXPECT_NO_THROW(parse(whole));
  EXPECT_THROW(parse(std::string(100000, '[')), InputError);
  EXPECT_THROW(parse(R"({"op": "publish", "topic": "/a", "msg": )" + std::string(1000, '{')), InputError);
  EXPECT_THROW(parse(std::string(max_message_bytes + 1, ' ')), InputError);
}

TEST(Rosbridge, SurvivesAnyByteInTheMiddle) {
  const std::string whole = R"({"op":"subscribe","topic":"/a","throttle_rate":5,"id":"x"})";
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const int byte : {0, 34, 92, 123, 128, 255}) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(byte);
      try {
        parse(damaged);
      } catch (const InputError&) {
      }
    }
}

TEST(Rosbridge, TypesOfBothGenerationsAreTheSame) {
  EXPECT_TRUE(same_type("geometry_msgs/Twist", "geometry_msgs/msg/Twist"));
  EXPECT_TRUE(same_type("geometry_msgs/Twist", ""));
  EXPECT_FALSE(same_type("geometry_msgs/Twist", "geometry_msgs/msg/TwistStamped"));
  EXPECT_FALSE(same_type("a/Twist", "b/Twist"));
  EXPECT_EQ(type_for("geometry_msgs/Twist", 2), "geometry_msgs/msg/Twist");
  EXPECT_EQ(type_for("geometry_msgs/msg/Twist", 1), "geometry_msgs/Twist");
}

TEST(Fragments, PutTogetherTheyAreTheMessageInAnyOrder) {
  const std::string message =
      R"({"op":"publish","topic":"/t","msg":{"text":"äöü €𝄞 abcdefghijklmnopqrstuvwxyz"}})";
  for (std::size_t bytes = 1; bytes <= message.size(); ++bytes) {
    std::vector<std::string> parts = in_fragments(message, bytes, "5");
    if (parts.size() == 1) {
      EXPECT_EQ(parts.front(), message);
      continue;
    }
    std::reverse(parts.begin(), parts.end());
    FragmentAssembler assembler;
    std::optional<std::string> whole;
    for (const std::string& part : parts) {
      EXPECT_FALSE(whole);
      whole = assembler.add(
          std::get<Fragment>(parse(part)));  // each part is valid UTF-8, or this would change it
    }
    ASSERT_TRUE(whole) << bytes;
    EXPECT_EQ(*whole, message);
  }
}

TEST(Fragments, AreBounded) {
  FragmentAssembler assembler;
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(assembler.add({std::to_string(i), "x", 0, 2}));
  EXPECT_FALSE(assembler.add({"0", "y", 1, 2})) << "the oldest are forgotten";
  EXPECT_TRUE(assembler.add({"999", "y", 1, 2}));
  const std::string large(max_message_bytes / 2, 'x');
  assembler.add({"big", large, 0, 4});
  assembler.add({"big", large, 1, 4});
  EXPECT_THROW(assembler.add({"big", "x", 2, 4}), InputError);
  assembler.add({"odd", "x", 0, 4});
  EXPECT_THROW(assembler.add({"odd", "x", 1, 5}), InputError);
}

TEST(WebSocketAddress, IsTakenApart) {
  const auto full = parse_websocket_address("ws://robot.local:8080/bridge?token=a%20b");
  EXPECT_EQ(full.host, "robot.local");
  EXPECT_EQ(full.port, "8080");
  EXPECT_EQ(full.target, "/bridge?token=a%20b");
  EXPECT_EQ(full.authority(), "robot.local:8080");
  const auto brief = parse_websocket_address("ws://10.0.0.7?token=x");
  EXPECT_EQ(brief.port, "9090");
  EXPECT_EQ(brief.target, "/?token=x");
  const auto v6 = parse_websocket_address("ws://[::1]:9091");
  EXPECT_EQ(v6.host, "::1");
  EXPECT_EQ(v6.authority(), "[::1]:9091");
}

TEST(WebSocketAddress, RefusesWhatIsNone) {
  for (const char* text :
       {"", "localhost:9090", "http://a", "ws://", "ws://:9090", "ws://a:0", "ws://a:65536", "ws://a:9x",
        "ws://[::1", "ws://u@h", "ws://a b", "ws://a\r\nHost: b", "ws://a:"})
    EXPECT_THROW(parse_websocket_address(text), InputError) << text;
  EXPECT_HAS(message_of([] { parse_websocket_address("wss://a"); }), "ssh -L");
}

}  // namespace
}  // namespace incognita
