// The series for viewers that join late is complete, bounded, and lists the events.
#include "incognita/live/series_history.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace incognita {
namespace {

using Json = nlohmann::json;

Snapshot snapshot(int frame) {
  Snapshot s;
  s.tick = {frame, 0.1 * frame, 0.1};
  s.status.state = TrackingState::tracking;
  s.bodies.resize(1);
  s.bodies[0].state = TrackingState::tracking;
  s.bodies[0].estimate.position = {0.5, 0, 1.0 * frame};
  s.matched = frame;
  s.timing_ms = {{"frame", 2.0}};
  return s;
}

TEST(SeriesHistory, HoldsEveryFrame) {
  SeriesHistory history(false, 1);
  for (int k = 0; k < 5; ++k) history.add(snapshot(k));
  const Json json = Json::parse(history.json());
  EXPECT_EQ(json["frames"], 5);
  EXPECT_EQ(json["frame_step"], 1);
  EXPECT_EQ(json["columns"]["matched"], Json({0, 1, 2, 3, 4}));
  EXPECT_EQ(json["timing_ms"]["frame"].size(), 5u);
  EXPECT_EQ(json["state"][4], "tracking");
  EXPECT_EQ(json["paths"][0]["estimate"].size(), 5u);
  EXPECT_EQ(json["paths"][0]["estimate"][2], Json({0.5, 0, 2}));
  EXPECT_TRUE(json["paths"][0]["truth"][2].is_null());
  EXPECT_TRUE(json["columns"]["coverage"][0].is_null());
}

TEST(SeriesHistory, IsThinnedEvenly) {
  SeriesHistory history(false, 1, 8);
  for (int k = 0; k < 100; ++k) history.add(snapshot(k));
  const Json json = Json::parse(history.json());
  const Json& matched = json["columns"]["matched"];
  ASSERT_LT(matched.size(), 8u);
  ASSERT_GE(matched.size(), 4u);
  const int stride = matched[1].get<int>() - matched[0].get<int>();
  EXPECT_EQ(json["frame_step"], stride);
  for (std::size_t i = 0; i < matched.size(); ++i) EXPECT_EQ(matched[i], static_cast<int>(i) * stride);
}

TEST(SeriesHistory, HasThePathOfABodyThatIsNotThereAtFirst) {
  SeriesHistory history(false, 1);
  Snapshot first = snapshot(0);
  first.bodies.clear();
  history.add(first);
  history.add(snapshot(1));
  const Json path = Json::parse(history.json())["paths"][0]["estimate"];
  EXPECT_TRUE(path[0].is_null());
  EXPECT_EQ(path[1], Json({0.5, 0, 1}));
}

TEST(SeriesHistory, ListsEvents) {
  SeriesHistory history(false, 1);
  Snapshot s = snapshot(0);
  history.add(s);
  s = snapshot(1);
  s.landmarks.push_back({12});
  s.landmarks.push_back({1, true});
  s.bodies[0].decision = {{"stay", "left"}, {0, 1}, 1, true};
  s.interventions.push_back(CoverLens{true});
  history.add(s);
  s = snapshot(2);
  s.status = {TrackingState::lost, "nothing matched"};
  history.add(s);
  const Json events = Json::parse(history.json())["events"];
  std::vector<std::string> found;
  for (const Json& event : events)
    found.push_back(event["kind"].get<std::string>() + ": " + event["text"].get<std::string>());
  EXPECT_EQ(found, (std::vector<std::string>{"initialized: landmark 12", "decision: left",
                                             "disturbance: cover-lens", "lost: nothing matched"}));
}

}  // namespace
}  // namespace incognita
