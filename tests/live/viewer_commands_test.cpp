// Messages of viewers: what is understood, and how everything else is refused.
#include "incognita/live/viewer_commands.hpp"

#include <gtest/gtest.h>

#include "incognita/messages/errors.hpp"
#include "incognita/record/snapshot/interventions.hpp"

namespace incognita {
namespace {

std::string refusal(const std::string& json) {
  try {
    viewer_command(json);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ViewerCommands, AreRead) {
  EXPECT_TRUE(std::holds_alternative<PauseRun>(viewer_command(R"({"type":"pause"})")));
  EXPECT_TRUE(std::holds_alternative<SaveRun>(viewer_command(R"({"type":"save"})")));
  EXPECT_EQ(std::get<SetSpeed>(viewer_command(R"({"type":"speed","factor":2.5})")).factor, 2.5);
  const auto start =
      std::get<StartRun>(viewer_command(R"({"type":"start","scenario":"room","set":["run.seed=7"]})"));
  EXPECT_EQ(start.scenario, "room");
  EXPECT_EQ(start.settings, std::vector<std::string>{"run.seed=7"});
  const auto push = std::get<PushBody>(std::get<Intervention>(viewer_command(
      R"({"type":"intervene","intervention":{"type":"push","body":2,"velocity_m_s":[1,0,-0.5],"duration_s":0.25}})")));
  EXPECT_EQ(push.body, 1u);
  EXPECT_EQ(push.velocity_m_s, Eigen::Vector3d(1, 0, -0.5));
  EXPECT_EQ(push.duration_s, 0.25);
}

TEST(ViewerCommands, StopARobot) {
  EXPECT_TRUE(std::get<StopRobot>(viewer_command(R"({"type":"stop-robot","stopped":true})")).stopped);
  EXPECT_FALSE(std::get<StopRobot>(viewer_command(R"({"type":"stop-robot","stopped":false})")).stopped);
  EXPECT_NE(refusal(R"({"type":"stop-robot"})").find("true or false"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"stop-robot","stopped":1})").find("true or false"), std::string::npos);
}

TEST(ViewerCommands, NameWhatIsWrong) {
  EXPECT_NE(refusal("").find("JSON"), std::string::npos);
  EXPECT_NE(refusal("[1]").find("JSON object"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":7})").find("\"type\""), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"dance"})").find("dance"), std::string::npos);
  for (const char* factor : {"-1", "1e-300", "0.09", "101", "\"1\""})
    EXPECT_NE(refusal(std::string(R"({"type":"speed","factor":)") + factor + "}").find("0.1 to 100"),
              std::string::npos);
  EXPECT_NE(refusal(R"({"type":"speed","factor":"fast"})").find("factor"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"start"})").find("scenario"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"start","scenario":"room","set":[1]})").find("set"), std::string::npos);
}

TEST(Interventions, AreTheSameAfterWritingAndReading) {
  const std::vector<Intervention> all{CoverLens{false},
                                      AddImageNoise{12.5},
                                      ChangeLight{0.3},
                                      DisplaceBody{1, {0.1, -0.2, 0.3}, -1},
                                      PushBody{0, {1, 2, 3}, 0.7},
                                      TakeOverBody{2},
                                      GiveBackBody{2},
                                      DriveBody{0, {1, -0.5, 0.25}, -1},
                                      ChangeDecision{{"decision.strategy=random", "decision.gaze=\"hold\""}}};
  ASSERT_EQ(all.size(), std::variant_size_v<Intervention>);
  for (const Intervention& intervention : all) {
    const std::string written = intervention_json(intervention);
    EXPECT_EQ(intervention_json(intervention_from_json(written)), written);
    const LoggedIntervention logged = from_log_row(log_row(41, 1.5, intervention));
    EXPECT_EQ(logged.frame, 41);
    EXPECT_EQ(intervention_json(logged.intervention), written);
  }
}

TEST(Interventions, AreRefusedWithTheField) {
  const auto refused = [](const std::string& json, const std::string& with) {
    try {
      intervention_from_json(json);
      ADD_FAILURE() << json << " was taken";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(with), std::string::npos) << error.what();
    }
  };
  refused(R"({"type":"light","factor":11})", "factor");
  refused(R"({"type":"light","factor":1,"extra":1})", "extra");
  refused(R"({"type":"light"})", "missing");
  refused(R"({"type":"cover-lens","covered":1})", "true or false");
  refused(R"({"type":"displace","body":0,"by_m":[0,0,0],"turn_rad":0})", "body");
  refused(R"({"type":"displace","body":1,"by_m":[0,0],"turn_rad":0})", "three numbers");
  refused(R"({"type":"displace","body":1,"by_m":[0,0,1e9],"turn_rad":0})", "by_m");
  refused(R"({"type":"drive","body":1,"forward":2,"left":0,"up":0,"turn":0})", "forward");
  refused(R"({"type":"set","settings":"x"})", "settings");
  refused(R"({"type":"explode"})", "cover-lens");
  refused("null", "object");
}

TEST(ViewerCommands, SayTheirTypeForAnAnswer) {
  EXPECT_EQ(type_of_message(R"({"type":"dance"})"), "dance");
  EXPECT_EQ(type_of_message(R"({"type":"intervene","intervention":{"type":"push","body":0}})"), "push");
  EXPECT_EQ(type_of_message(R"({"type":"intervene","intervention":5})"), "intervene");
  EXPECT_EQ(type_of_message("[]"), "");
  EXPECT_EQ(type_of_message("{"), "");
}

}  // namespace
}  // namespace incognita
