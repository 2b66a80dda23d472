// The rosbridge protocol as a server speaks it: topics that clients subscribe to and publish on. Services, actions, PNG and CBOR are
// refused, with a status that says so.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/live/robot/fragments.hpp"
#include "incognita/live/robot/rosbridge.hpp"
#include "incognita/live/server.hpp"

namespace incognita {

/// All are called in the server's thread, and may be empty.
struct RosbridgeChannelHandlers {
  /// A client publishes. InputError is answered with a status.
  std::function<void(std::uint64_t client, const rosbridge::Publish& publish)> published = {};
  /// A message of a client is no operation, such as one with NaN, which is not JSON; it is answered with a status.
  std::function<void(std::uint64_t client)> unreadable = {};
  std::function<void(std::uint64_t client)> left = {};
  /// The first client subscribes to a topic, or the last one ends that. `type` may be empty.
  std::function<void(const std::string&topic, const std::string&type)> wanted = {}, unwanted = {};
};

class RosbridgeChannel final : public ViewerProtocol {
 public:
  /// Of clients that offer no subprotocol, as those of rosbridge do.
  static constexpr const char* subprotocol = "";

  /// `topics`: known topics with their types; a client that advertises or subscribes another type is told so. Others may
  /// be subscribed too.
  RosbridgeChannel(std::map<std::string, std::string> topics, RosbridgeChannelHandlers handlers);

  /// To be called once, before the first message.
  void attach(Server& server) { server_ = &server; }

  /// From any thread: to all who subscribe. `msg` is a JSON object. Never waits; a client that reads too slowly gets the newest.
  void publish(const std::string& topic, std::string msg);

  void joined(std::uint64_t id, Viewer& viewer) override;
  void left(std::uint64_t id) override;
  void received(std::uint64_t id, std::string_view message, bool binary) override;

 private:
  using Clock = std::chrono::steady_clock;
  struct Subscription {
    rosbridge::Subscribe wish;
    Clock::time_point sent{};
  };
  struct Client {
    Viewer* viewer = nullptr;
    std::vector<Subscription> subscriptions = {};
    rosbridge::FragmentAssembler fragments = {};
  };
  std::optional<rosbridge::Operation> read(std::uint64_t id, Client& client, std::string_view message);
  void carry_out(std::uint64_t id, Client& client, const rosbridge::Operation& operation);
  void subscribe(Client& client, const rosbridge::Subscribe& wish);
  void unsubscribe(Client& client, const rosbridge::Unsubscribe& wish);
  void note_wanted(const std::string& topic, const std::string& type);
  void check_type(Client& client, const std::string& topic, const std::string& type,
                  const std::string& id) const;
  void deliver(const std::string& topic, const std::string& msg);
  void deliver_to(Client& client, const std::string& topic,
                  const std::shared_ptr<const std::string>& message);
  static void send(Client& client, std::string json);
  static void send_status(Client& client, const char* level, const std::string& msg,
                          const std::string& id = "");

  const std::map<std::string, std::string> topics_;
  RosbridgeChannelHandlers handlers_;
  Server* server_ = nullptr;
  std::map<std::uint64_t, Client> clients_;
  std::map<std::string, std::string> wanted_;  ///< topics that some client subscribes, with their types
  std::uint64_t next_fragment_ = 0;
};

}  // namespace incognita
