// The server against clients that are wrong, hostile, slow or many: refused, named in the log, the rest undisturbed.
#include "incognita/live/server.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "incognita/live/page_channel.hpp"
#include "incognita/messages/errors.hpp"
#include "tests/live/client.hpp"

namespace incognita {
namespace {

using testing::get;
using testing::RawConnection;
using testing::WebSocketClient;
using Json = nlohmann::json;

/// A server whose only datum is /api/secret.
struct Served {
  explicit Served(ServerSettings settings = {}) {
    channel = std::make_shared<PageChannel>([this](const ViewerCommand& command) {
      if (refuses) throw InputError("not now");
      const std::lock_guard lock(mutex);
      commands.push_back(command);
    });
    ServerHandlers handlers;
    handlers.public_answer = [](const HttpRequest& request) -> std::optional<HttpAnswer> {
      if (request.path != "/") return std::nullopt;
      return HttpAnswer{200, "text/html", std::make_shared<const std::string>("page")};
    };
    handlers.answer = [this](const HttpRequest& request) {
      ++answers;
      HttpAnswer answer;
      if (request.path == "/api/failure") throw std::runtime_error("it failed");
      answer.body = std::make_shared<const std::string>("secret");
      if (request.path != "/api/secret") answer.status = 404;
      return answer;
    };
    handlers.protocols = {{PageChannel::subprotocol, channel}};
    handlers.log = [this](const std::string& line) {
      const std::lock_guard lock(mutex);
      log += line + "\n";
    };
    server = std::make_unique<Server>(std::move(settings), std::move(handlers),
                                      [this](Server& made) { channel->attach(made); });
    port = server->port();
  }
  /// Whether a line with that text is logged, at the latest two seconds from now.
  bool logs(const std::string& part) {
    for (int i = 0; i < 200; ++i) {
      {
        const std::lock_guard lock(mutex);
        if (log.find(part) != std::string::npos) return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  /// Waits until there are so many commands, at the latest five seconds from now.
  bool gets_commands(std::size_t count) {
    for (int i = 0; i < 1000; ++i) {
      {
        const std::lock_guard lock(mutex);
        if (commands.size() >= count) return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
  /// The speed ahead that the last command asks for; -1 if it is no drive command.
  double last_forward() {
    const std::lock_guard lock(mutex);
    const auto* intervention = commands.empty() ? nullptr : std::get_if<Intervention>(&commands.back());
    const auto* drive = intervention ? std::get_if<DriveBody>(intervention) : nullptr;
    return drive ? drive->direction.x() : -1;
  }
  /// Waits until the server's thread has done what was asked of it so far.
  void drain() const {
    std::atomic<bool> done = false;
    server->post([&] { done = true; });
    while (!done) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  WebSocketClient viewer(const std::string& target = "/ws", const testing::Headers& headers = {}) const {
    return {port, target, PageChannel::subprotocol, headers};
  }

  std::mutex mutex;
  std::string log;
  std::vector<ViewerCommand> commands;
  std::shared_ptr<PageChannel> channel;
  std::unique_ptr<Server> server;
  std::uint16_t port = 0;
  std::atomic<int> answers = 0;
  std::atomic<bool> refuses = false;  ///< all commands
};

Snapshot snapshot(int frame) {
  Snapshot s;
  s.tick = {frame, frame / 30.0, 1 / 30.0};
  s.bodies.resize(1);
  return s;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Server, AnswersRequests) {
  Served served;
  EXPECT_EQ(get(served.port, "/").body, "page");
  EXPECT_EQ(get(served.port, "/api/secret").body, "secret");
  EXPECT_EQ(get(served.port, "/nowhere").status, 404);
  EXPECT_EQ(get(served.port, "/", {}, "HEAD").status, 200);
}

TEST(Server, RefusesOtherMethodsAndLargeRequests) {
  Served served;
  EXPECT_EQ(get(served.port, "/", {}, "POST").status, 405);
  EXPECT_EQ(get(served.port, "/" + std::string(20000, 'x')).status, 413);
  EXPECT_EQ(get(served.port, "/%zz").status, 400);
  EXPECT_TRUE(served.logs("too large"));
}

TEST(Server, DoesNothingForARequestThatIsRefused) {
  Served served;
  EXPECT_EQ(get(served.port, "/api/secret", {{"Sec-Fetch-Site", "cross-site"}}).status, 403);
  EXPECT_EQ(get(served.port, "/", {{"Sec-Fetch-Site", "cross-site"}}).body, "page");
  EXPECT_EQ(served.answers, 0);
}

TEST(Server, GoesOnAfterAFailure) {
  Served served;
  const auto failed = get(served.port, "/api/failure");
  EXPECT_EQ(failed.status, 500);
  EXPECT_TRUE(contains(failed.body, "it failed"));
  served.server->post([] { throw std::runtime_error("a task failed"); });
  EXPECT_EQ(get(served.port, "/").body, "page");
  EXPECT_TRUE(served.logs("a task failed"));
}

TEST(Server, BoundsChunksAndTrailers) {
  Served served;
  const std::string head = "GET / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n";
  for (const std::string& endless : {std::string("1;"), std::string("0\r\nA: ")}) {
    RawConnection connection(served.port);
    connection.send(head + endless + std::string(100000, 'a'));
    EXPECT_TRUE(connection.is_closed_within(5));
  }
  EXPECT_TRUE(served.logs("too large"));
}

TEST(Server, RefusesFramesBeforeTheAnswerToTheUpgrade) {
  Served served;
  RawConnection hasty(served.port);
  hasty.send(
      "GET /ws HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(served.port) +
      "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
      "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: incognita.v1\r\n\r\n"
      "\x81\x80"
      "mask");
  EXPECT_TRUE(hasty.is_closed_within(5));
  EXPECT_TRUE(served.logs("wait for its answer"));
}

TEST(Server, RefusesAnotherOrigin) {
  Served served;
  const testing::Headers evil{{"Origin", "http://evil.example"}};
  EXPECT_EQ(served.viewer("/ws", evil).status(), 403);
  EXPECT_EQ(get(served.port, "/api/secret", evil).status, 403);
  EXPECT_TRUE(served.logs("evil.example"));
  EXPECT_EQ(served.viewer("/ws", {{"Origin", "http://127.0.0.1:" + std::to_string(served.port)}}).status(),
            101);
}

TEST(Server, RefusesAnotherHost) {
  Served served;
  EXPECT_EQ(get(served.port, "/api/secret", {{"Host", "rebound.example"}}).status, 403);
  EXPECT_EQ(served.viewer("/ws", {{"Host", "rebound.example"}}).status(), 403);
}

TEST(Server, RefusesAWrongToken) {
  ServerSettings settings;
  settings.access.token = random_token();
  Served served(settings);
  EXPECT_EQ(served.viewer().status(), 403);
  EXPECT_EQ(served.viewer("/ws?token=wrong").status(), 403);
  EXPECT_EQ(get(served.port, "/api/secret?token=wrong").status, 403);
  EXPECT_EQ(get(served.port, "/api/secret?token=" + settings.access.token).status, 200);
  EXPECT_EQ(served.viewer("/ws?token=" + settings.access.token).status(), 101);
  EXPECT_TRUE(served.logs("token"));
  EXPECT_TRUE(contains(served.server->address(), settings.access.token));
}

TEST(Server, RefusesUnknownSubprotocolsAndPaths) {
  Served served;
  EXPECT_EQ(WebSocketClient(served.port, "/ws", "chat").status(), 400);
  EXPECT_EQ(WebSocketClient(served.port, "/ws", "").status(), 400);
  EXPECT_EQ(served.viewer("/other").status(), 404);
}

TEST(Server, PassesCommandsAndRefusesWrongOnes) {
  Served served;
  WebSocketClient viewer = served.viewer();
  ASSERT_EQ(viewer.status(), 101);
  EXPECT_EQ(Json::parse(*viewer.receive())["type"], "state");
  viewer.send(R"({"type":"pause"})");
  viewer.send(R"({"type":"dance"})");
  const Json refused = Json::parse(*viewer.receive());
  EXPECT_EQ(refused["type"], "refused");
  EXPECT_EQ(refused["of"], "dance");
  const std::lock_guard lock(served.mutex);
  ASSERT_EQ(served.commands.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<PauseRun>(served.commands[0]));
}

TEST(Server, DisconnectsAfterAnOversizedMessage) {
  Served served;
  WebSocketClient viewer = served.viewer(), other = served.viewer();
  viewer.send(std::string(100000, ' '));
  while (viewer.receive()) continue;
  EXPECT_TRUE(served.logs("65536"));
  EXPECT_TRUE(other.send(R"({"type":"dance"})"));
  while (const auto message = other.receive())
    if (contains(*message, "refused")) return;
  ADD_FAILURE() << "the other viewer was disturbed";
}

/// Whether the viewer still gets answers.
bool is_served(WebSocketClient& viewer) {
  viewer.send(R"({"type":"dance"})");
  while (const auto message = viewer.receive())
    if (contains(*message, "refused")) return true;
  return false;
}

TEST(Server, BoundsTheConnections) {
  ServerSettings settings;
  settings.max_connections = 10;
  Served served(settings);
  WebSocketClient viewer = served.viewer();
  std::vector<RawConnection> many;
  for (int i = 0; i < 1000; ++i) many.emplace_back(served.port);
  int closed = 0;
  for (int i = 0; i < 1000; i += 50)
    closed += many[static_cast<std::size_t>(i)].is_closed_within(i < 10 ? 0.01 : 2);
  EXPECT_GE(closed, 19);
  EXPECT_TRUE(served.logs("the most that may be"));
  EXPECT_TRUE(is_served(viewer));
  many.clear();
  for (int i = 0; i < 50 && get(served.port, "/").status != 200; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(get(served.port, "/").body, "page");
}

TEST(Server, LetsAViewerInWhateverOthersHoldOpen) {
  ServerSettings settings;
  settings.access.token = random_token();
  Served served(settings);
  const std::string token = "?token=" + settings.access.token;
  std::vector<RawConnection> held;
  while (held.size() < settings.max_connections) held.emplace_back(served.port);
  WebSocketClient viewer = served.viewer("/ws" + token);
  EXPECT_EQ(viewer.status(), 101);
  for (int i = 0; i < 200; ++i) held.emplace_back(served.port, "127.0.0." + std::to_string(2 + i % 100));
  EXPECT_EQ(served.viewer("/ws" + token).status(), 101);
  EXPECT_EQ(get(served.port, "/api/secret" + token).body, "secret");
  EXPECT_TRUE(is_served(viewer));
  EXPECT_TRUE(served.logs("was closed for another: it has no access, and there are 64"));
}

TEST(Server, ClosesStrangersOfTheAddressThatOpensMore) {
  ServerSettings settings;
  settings.access.token = random_token();
  Served served(settings);
  const std::string host = " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(served.port) + "\r\n\r\n";
  RawConnection elsewhere(served.port, "127.0.0.2"), with_access(served.port);
  with_access.send("GET /api/secret?token=" + settings.access.token + host);
  while (served.answers == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::vector<RawConnection> many;
  for (std::size_t i = 0; i < settings.max_strangers + 1; ++i) many.emplace_back(served.port);
  EXPECT_TRUE(many.front().is_closed_within(5));
  EXPECT_FALSE(many[1].is_closed_within(0.2));
  for (int i = 0; i < 200; ++i) many.emplace_back(served.port);
  EXPECT_TRUE(many[1].is_closed_within(5));
  EXPECT_FALSE(elsewhere.is_closed_within(0.2));
  EXPECT_FALSE(with_access.is_closed_within(0.2));
  EXPECT_FALSE(many.back().is_closed_within(0.2));
  EXPECT_TRUE(served.logs("a connection of 127.0.0.1 was closed for its next: it has 16 without access"));
}

TEST(Server, ClosesAHalfOpenWebSocket) {
  ServerSettings settings;
  settings.idle_s = 1;
  Served served(settings);
  RawConnection half(served.port);
  half.send("GET /ws HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(served.port) +
            "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
            "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: incognita.v1\r\n\r\n");
  EXPECT_TRUE(half.is_closed_within(5));  // it never answers a ping
  EXPECT_TRUE(served.logs("silent"));
}

TEST(Server, AnswersGarbageWithARefusal) {
  Served served;
  RawConnection garbage(served.port);
  garbage.send("\x16\x03\x01 this is not HTTP\r\n\r\n");
  EXPECT_TRUE(garbage.is_closed_within(5));
  EXPECT_TRUE(served.logs("not valid HTTP"));
}

TEST(Server, RefusesATakenPort) {
  Served served;
  ServerSettings settings;
  settings.port = served.port;
  EXPECT_THROW(Served{settings}, InputError);
  settings.address = "not an address";
  EXPECT_THROW(Served{settings}, InputError);
}

TEST(PageChannel, DeliversAllSnapshotsInOrder) {
  constexpr int all = 200, at_once = 8;  // fewer than the server may keep
  Served served;
  WebSocketClient viewer = served.viewer();
  ASSERT_EQ(Json::parse(*viewer.receive())["type"], "state");  // it has joined
  served.channel->begin(0, "test", false);
  for (int next = 0, published = 0; next < all;) {
    if (next == published)
      for (; published < next + at_once; ++published)
        served.channel->publish(std::make_shared<const Snapshot>(snapshot(published)));
    const auto message = viewer.receive();
    ASSERT_TRUE(message);
    const Json json = Json::parse(*message);
    if (json["type"] != "snapshot") continue;
    EXPECT_EQ(json["seq"], next);
    EXPECT_EQ(json["dropped"], 0);
    EXPECT_EQ(json["snapshot"]["frame"], next);
    ++next;
  }
}

/// The viewer reads nothing while 300 MB are published.
TEST(PageChannel, ASlowViewerMissesTheOldestAndCostsBoundedMemory) {
  Served served;
  WebSocketClient slow = served.viewer();
  served.channel->begin(0, "test", false);
  Snapshot large = snapshot(0);
  large.landmarks.resize(500);
  for (int k = 0; k < 1500; ++k) {
    large.tick.frame = k;
    served.channel->publish(std::make_shared<const Snapshot>(large));
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  served.drain();
  int received = 0, last = -1, gaps = 0, dropped = 0;
  while (last != 1499) {
    const auto message = slow.receive();
    ASSERT_TRUE(message);
    const Json json = Json::parse(*message);
    if (json["type"] != "snapshot") continue;
    const int seq = json["seq"];
    EXPECT_GT(seq, last);
    gaps += seq - last - 1;
    dropped = json["dropped"];
    EXPECT_LE(gaps, dropped);
    last = seq;
    ++received;
  }
  EXPECT_EQ(gaps, dropped);
  EXPECT_EQ(received + dropped, 1500);
  EXPECT_GT(dropped, 0);
  EXPECT_LT(received, 500);
}

TEST(PageChannel, SaysHowASaveWent) {
  Served served;
  WebSocketClient viewer = served.viewer();
  ASSERT_EQ(Json::parse(*viewer.receive())["type"], "state");  // it has joined
  served.channel->saved({1.5, "run.state", 1234, ""});
  EXPECT_EQ(Json::parse(*viewer.receive()),
            Json::parse(R"({"type":"saved","t":1.5,"file":"run.state","bytes":1234,"failure":null})"));
  served.channel->saved({2.5, "run.state", 0, "the disk is full"});
  EXPECT_EQ(Json::parse(*viewer.receive())["failure"], "the disk is full");
}

constexpr const char* drive_ahead =
    R"({"type":"intervene","intervention":{"type":"drive","body":1,"forward":1,"left":0,"up":0,"turn":0}})";

TEST(PageChannel, StopsTheBodyOfADriverWhoFallsSilent) {
  Served served;
  WebSocketClient driver = served.viewer();
  const auto start = std::chrono::steady_clock::now();
  driver.send(drive_ahead);
  ASSERT_TRUE(served.gets_commands(1));
  EXPECT_EQ(served.last_forward(), 1);
  ASSERT_TRUE(served.gets_commands(2)) << "the connection is open, and nothing comes";
  EXPECT_GE(std::chrono::steady_clock::now() - start, PageChannel::drive_holds);
  EXPECT_EQ(served.last_forward(), 0);
}

TEST(PageChannel, RenewalsKeepABodyMovingAndAreNoCommands) {
  Served served;
  WebSocketClient driver = served.viewer();
  for (int k = 0; k < 10; ++k) {
    driver.send(drive_ahead);
    const auto sent = std::chrono::steady_clock::now();
    std::this_thread::sleep_for(PageChannel::drive_holds / 5);
    if (std::chrono::steady_clock::now() - sent > PageChannel::drive_holds / 2)
      GTEST_SKIP() << "this machine is too busy to renew in time";
  }
  served.drain();
  {
    const std::lock_guard lock(served.mutex);
    EXPECT_EQ(served.commands.size(), 1u);
  }
  EXPECT_TRUE(served.gets_commands(2));
  EXPECT_EQ(served.last_forward(), 0);
}

TEST(PageChannel, ABodyWhoseStopIsRefusedIsStoppedLater) {
  Served served;
  WebSocketClient driver = served.viewer();
  driver.send(drive_ahead);
  ASSERT_TRUE(served.gets_commands(1));
  served.refuses = true;
  std::this_thread::sleep_for(PageChannel::drive_holds * 3 / 2);
  served.refuses = false;
  EXPECT_TRUE(served.gets_commands(2));
  EXPECT_EQ(served.last_forward(), 0);
}

TEST(PageChannel, StopsTheBodyOfADriverWhoLeaves) {
  Served served;
  std::optional<WebSocketClient> driver(served.viewer());
  driver->send(drive_ahead);
  ASSERT_TRUE(served.gets_commands(1));
  const auto gone = std::chrono::steady_clock::now();
  driver.reset();
  ASSERT_TRUE(served.gets_commands(2));
  EXPECT_LT(std::chrono::steady_clock::now() - gone, PageChannel::drive_holds) << "at once";
  EXPECT_EQ(served.last_forward(), 0);
}

/// A viewer that joins during a pause sees the last frame at once.
TEST(PageChannel, AJoiningViewerGetsTheLastSnapshot) {
  Served served;
  served.channel->begin(3, "test", false);
  served.channel->publish(std::make_shared<const Snapshot>(snapshot(41)));
  WebSocketClient viewer = served.viewer();
  bool run = false;
  while (const auto message = viewer.receive()) {
    const Json json = Json::parse(*message);
    run |= json["type"] == "run" && json["index"] == 3;
    if (json["type"] != "snapshot") continue;
    EXPECT_EQ(json["snapshot"]["frame"], 41);
    EXPECT_TRUE(run);
    return;
  }
  ADD_FAILURE() << "no snapshot came";
}

}  // namespace
}  // namespace incognita
