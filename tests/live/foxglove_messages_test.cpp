// Messages of the Foxglove WebSocket protocol.
#include "incognita/live/foxglove_messages.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

using Json = nlohmann::json;

TEST(Foxglove, AdvertisesTheTopicsOfTheFile) {
  const Json json = Json::parse(foxglove::advertise(all_topics()));
  EXPECT_EQ(json["op"], "advertise");
  ASSERT_EQ(json["channels"].size(), all_topics().size());
  for (const Json& channel : json["channels"]) {
    EXPECT_EQ(channel["encoding"], "json");
    EXPECT_EQ(channel["schemaEncoding"], "jsonschema");
    EXPECT_EQ(Json::parse(channel["schema"].get<std::string>())["type"], "object");
  }
  EXPECT_EQ(json["channels"][1]["topic"], "/snapshot");
}

TEST(Foxglove, HeadersAreLittleEndian) {
  const std::string header = foxglove::message_header(0x01020304, 0x1122334455667788);
  EXPECT_EQ(header, std::string("\x01\x04\x03\x02\x01\x88\x77\x66\x55\x44\x33\x22\x11"));
}

TEST(Foxglove, ReadsSubscriptions) {
  const auto asked = foxglove::request(
      R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":1},{"id":8,"channelId":2}]})");
  EXPECT_EQ(asked.subscribe, (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{7, 1}, {8, 2}}));
  EXPECT_EQ(foxglove::request(R"({"op":"unsubscribe","subscriptionIds":[7]})").unsubscribe,
            std::vector<std::uint32_t>{7});
}

TEST(Foxglove, RefusesEverythingElse) {
  for (const char* json :
       {"", "[]", "{}", R"({"op":"advertise","channels":[]})", R"({"op":"subscribe"})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[7]})", R"({"op":"unsubscribe","subscriptionIds":["a"]})"})
    EXPECT_THROW(foxglove::request(json), InputError) << json;
  std::string many = R"({"op":"unsubscribe","subscriptionIds":[0)";
  for (int i = 0; i < 100; ++i) many += ",1";
  EXPECT_THROW(foxglove::request(many + "]}"), InputError);
}

}  // namespace
}  // namespace incognita
