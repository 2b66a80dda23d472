// A page that shows one state: who joins late sees it, and commands that are refused are answered.
#include "incognita/live/state_channel.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "incognita/messages/errors.hpp"
#include "tests/live/client.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

struct Page {
  std::vector<std::string> commands;
  std::shared_ptr<StateChannel> channel = std::make_shared<StateChannel>([this](std::string_view text) {
    if (text == "bad") throw InputError("bad: must be good");
    commands.emplace_back(text);
  });
  std::unique_ptr<Server> server;

  Page() {
    ServerHandlers handlers;
    handlers.answer = [](const HttpRequest&) { return HttpAnswer{404, "text/plain", {}, {}}; };
    handlers.protocols = {{"state", channel}};
    server = std::make_unique<Server>(ServerSettings{}, std::move(handlers),
                                      [this](Server& one) { channel->attach(one); });
  }
};

std::string field(const std::optional<std::string>& message, const char* key) {
  return message ? nlohmann::json::parse(*message).value(key, std::string()) : "";
}

TEST(StateChannel, ShowsTheNewestStateToAllAndToWhoJoinsLater) {
  Page page;
  testing::WebSocketClient early(page.server->port(), "/ws", "state");
  ASSERT_EQ(early.status(), 101);
  page.channel->put(R"({"type":"state","n":"1"})");
  EXPECT_EQ(field(early.receive(), "n"), "1");
  page.channel->put(R"({"type":"state","n":"2"})");
  EXPECT_EQ(field(early.receive(), "n"), "2");
  testing::WebSocketClient late(page.server->port(), "/ws", "state");
  EXPECT_EQ(field(late.receive(), "n"), "2");
}

TEST(StateChannel, AnswersARefusedCommandToItsSenderAlone) {
  Page page;
  testing::WebSocketClient one(page.server->port(), "/ws", "state"),
      other(page.server->port(), "/ws", "state");
  ASSERT_TRUE(one.send("bad"));
  EXPECT_EQ(field(one.receive(), "message"), "bad: must be good");
  ASSERT_TRUE(one.send("good"));
  page.channel->put(R"({"type":"state","n":"3"})");
  EXPECT_EQ(field(other.receive(), "n"), "3");
  EXPECT_EQ(field(one.receive(), "n"), "3");
  page.server.reset();
  EXPECT_EQ(page.commands, std::vector<std::string>{"good"});
}

}  // namespace
}  // namespace incognita
