// Viewers that speak the Foxglove WebSocket protocol: they get the topics of run.mcap, live.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "incognita/live/mailbox.hpp"
#include "incognita/live/server.hpp"
#include "incognita/record/mcap/snapshot_topics.hpp"

namespace incognita {

class FoxgloveChannel final : public ViewerProtocol, private TopicSink {
 public:
  /// To be called once, before the first message.
  void attach(Server& server) { server_ = &server; }

  // From the thread of the loop:

  void begin(const RunInfo& info);
  /// Never waits for a viewer; does nothing without one.
  void publish(std::shared_ptr<const Snapshot> snapshot);

  void joined(std::uint64_t id, Viewer& viewer) override;
  void left(std::uint64_t id) override;
  void received(std::uint64_t id, std::string_view message, bool binary) override;

 private:
  using Waiting = Mailbox<std::shared_ptr<const Snapshot>>;
  struct Client {
    Viewer* viewer = nullptr;
    std::map<std::uint32_t, std::size_t> topics = {};  ///< by subscription, an index of all_topics()
  };
  void deliver(Waiting& mailbox);
  static void send(Viewer& viewer, std::string json);
  void repeat_last_to(const Client& newly_subscribed);
  void change_subscriptions(Client& client, std::string_view message);
  bool wants(const Topic& topic) const override;
  void put(const Topic& topic, std::uint64_t time_ns, std::string message) override;

  Server* server_ = nullptr;
  static constexpr std::size_t most_waiting = 16;
  /// One per run: what waits of a run is delivered before the next begins.
  std::shared_ptr<Waiting> mailbox_ = std::make_shared<Waiting>(most_waiting);

  // Of the server's thread:
  std::map<std::uint64_t, Client> clients_;
  std::optional<SnapshotTopics> topics_;
  std::shared_ptr<const Snapshot> last_;
  int session_ = 0;
};

}  // namespace incognita
