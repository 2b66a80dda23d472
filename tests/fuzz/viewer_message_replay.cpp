// The fuzz target of viewers' messages without libFuzzer: on messages of every kind, and on mutations of them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "incognita/math/random.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace incognita {
namespace {

void feed(const std::string& bytes) {
  EXPECT_EQ(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), 0);
}

const std::vector<std::string> messages{
    R"({"type":"pause"})",
    R"({"type":"save"})",
    R"({"type":"speed","factor":2.5})",
    R"({"type":"start","scenario":"room","set":["run.seed=7"]})",
    R"({"type":"intervene","intervention":{"type":"push","body":1,"velocity_m_s":[1,0,-0.5],"duration_s":0.25}})",
    R"({"type":"intervene","intervention":{"type":"displace","body":1,"by_m":[0.1,0,0],"turn_rad":1e-3}})",
    R"({"type":"intervene","intervention":{"type":"drive","body":1,"forward":1,"left":0,"up":-1,"turn":0.5}})",
    R"({"type":"intervene","intervention":{"type":"set","settings":["decision.gaze=\"hold\""]}})",
    R"({"type":"intervene","intervention":{"type":"cover-lens","covered":true}})",
    R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":1}]})",
    R"({"op":"unsubscribe","subscriptionIds":[7]})",
    R"({"frame":41,"t":1.5,"intervention":{"type":"light","factor":0.5}})",
    "/api/config?scenario=room&set=run.seed%3D7"};

TEST(ViewerMessages, AreReadOrRefused) {
  for (const std::string& message : messages) feed(message);
}

TEST(ViewerMessages, CutAnywhereAreReadOrRefused) {
  for (const std::string& message : messages)
    for (std::size_t size = 0; size < message.size(); ++size) feed(message.substr(0, size));
}

TEST(ViewerMessages, MutatedAreReadOrRefused) {
  RandomStream random(1, "viewer messages");
  for (const std::string& message : messages)
    for (int i = 0; i < 2000; ++i) {
      std::string mutant = message;
      for (int changes = 1 + random.below(4); changes > 0; --changes)
        mutant[static_cast<std::size_t>(random.below(static_cast<int>(mutant.size())))] =
            static_cast<char>(random.below(256));
      feed(mutant);
    }
}

TEST(ViewerMessages, NestedDeeplyAreRefused) {
  for (const char* part : {"[", "{\"a\":", R"({"type":"intervene","intervention":)"}) {
    std::string deep;
    while (deep.size() < 65536) deep += part;
    feed(deep);
    std::string closed;
    for (int i = 0; i < 30000; ++i) closed += "[";
    feed(closed + std::string(30000, ']'));
  }
}

TEST(ViewerMessages, NumbersOfAnySizeAreReadOrRefused) {
  for (const char* number :
       {"1e400", "-1e400", "18446744073709551616", "-9223372036854775809", "0.1e-400", "1E+2"})
    feed(std::string(R"({"type":"speed","factor":)") + number + "}");
}

}  // namespace
}  // namespace incognita
