// The camera of the page: who may send, times, and messages that are damaged.
#include "incognita/live/browser_camera.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/scratch.hpp"

namespace incognita {
namespace {

struct Page final : Viewer {
  std::vector<nlohmann::json> answers;
  void send(LiveMessage message) override { answers.push_back(nlohmann::json::parse(*message.body)); }
  void add_dropped(std::uint64_t) override {}
  std::string last(const char* key) const {
    return answers.empty() ? "" : answers.back().value(key, std::string());
  }
};

std::string image_message(double t, const std::string& jpeg) {
  const auto bits = std::bit_cast<std::uint64_t>(t);
  std::string message;
  for (int i = 0; i < 8; ++i) message += static_cast<char>(bits >> (8 * i));
  return message + jpeg;
}

struct Camera {
  BrowserCamera camera;
  Page page, other;
  Camera() {
    camera.expect(40, 30);
    camera.joined(1, page);
    camera.joined(2, other);
  }
  void say(std::uint64_t id, const std::string& json) { camera.received(id, json, false); }
  void greet(std::uint64_t id = 1) { say(id, R"({"type":"camera","label":"rear","width":40,"height":30})"); }
  void show(std::uint64_t id, const std::string& message) { camera.received(id, message, true); }
};

TEST(BrowserCamera, GivesTheNewestImageWithItsTime) {
  Camera c;
  EXPECT_HAS(c.camera.problem(), "Use this camera");
  c.greet();
  EXPECT_EQ(c.page.last("type"), "ready");
  EXPECT_EQ(c.camera.problem(), "");
  EXPECT_HAS(c.camera.take_events().at(0), "images come from the page's camera: rear");
  c.show(1, image_message(700.5, "40x30"));
  EXPECT_EQ(c.page.last("type"), "got");
  EXPECT_EQ(c.page.answers.back().at("t"), 700.5);
  const auto first = c.camera.receive(0);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->t, 0);
  EXPECT_EQ(first->jpeg, "40x30");
  c.show(1, image_message(700.533, "40x30"));
  c.show(1, image_message(700.566, "40x30"));
  const double run_t = c.page.answers.back().at("run_t");
  const auto newest = c.camera.receive(0);
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->t, run_t) << "the page finds its image again in the snapshots";
  EXPECT_NEAR(newest->t, 0.066, 1e-6);
  EXPECT_EQ(c.camera.dropped(), 1);
}

TEST(BrowserCamera, TakesOneCameraAtATime) {
  Camera c;
  c.greet(1);
  c.greet(2);
  EXPECT_HAS(c.other.last("message"), "another camera sends already");
  c.show(2, image_message(1, "40x30"));
  EXPECT_EQ(c.other.last("type"), "refused");
  EXPECT_FALSE(c.camera.receive(0));
  c.camera.left(1);
  EXPECT_HAS(c.camera.problem(), "no camera sends");
  c.greet(2);
  EXPECT_EQ(c.other.last("type"), "ready");
}

TEST(BrowserCamera, GoesOnInTimeWithAnotherDevice) {
  Camera c;
  c.greet(1);
  c.show(1, image_message(5000, "40x30"));
  c.camera.receive(0);
  c.camera.left(1);
  c.greet(2);
  c.show(2, image_message(3, "40x30"));
  const auto reading = c.camera.receive(0);
  ASSERT_TRUE(reading);
  EXPECT_GT(reading->t, 0);
  EXPECT_LT(reading->t, 30);
}

TEST(BrowserCamera, SaysWhatIsWrongWithAMessage) {
  Camera c;
  for (const char* text : {"", "[]", "7", "{", R"({"type":"pause"})", R"({"type":7})"}) {
    c.say(1, text);
    EXPECT_HAS(c.page.last("message"), "the first message must be") << text;
  }
  c.say(1, R"({"type":"camera","width":1280,"height":720})");
  EXPECT_HAS(c.page.last("message"), "gives images of 1280x720 px, and 40x30 are expected: hold a phone");
  c.say(1, R"({"type":"camera","width":"40","height":1e99})");
  EXPECT_HAS(c.page.last("message"), "gives images of 0x0");
  c.show(1, image_message(1, "40x30"));
  EXPECT_EQ(c.page.last("type"), "refused") << "before it was accepted";
  c.greet();
  for (const std::string& message :
       {std::string(), std::string("1234567"), image_message(1, ""), image_message(std::nan(""), "40x30")}) {
    c.show(1, message);
    EXPECT_EQ(c.page.last("type"), "refused");
  }
}

TEST(BrowserCamera, ShowsNoControlCharactersOfALabel) {
  Camera c;
  c.say(1, "{\"type\":\"camera\",\"label\":\"a\\u001b[31mb\",\"width\":40,\"height\":30}");
  EXPECT_HAS(c.camera.take_events().at(0), "a?[31mb");
}

}  // namespace
}  // namespace incognita
