// What the viewers of the page receive and send over their WebSocket: docs/live-page.md.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "incognita/live/drive_watchdog.hpp"
#include "incognita/live/mailbox.hpp"
#include "incognita/live/server.hpp"
#include "incognita/live/viewer_commands.hpp"
#include "incognita/record/snapshot/snapshot.hpp"

namespace incognita {

/// State of the loop as viewers see it.
struct LiveState {
  bool running = false, paused = false;
  double speed = 1;
  std::string ended_status, ended_reason;  ///< after the end of a run
  std::optional<bool> robot_stopped = {};  ///< by hand; none: the run has no robot

  bool operator==(const LiveState&) const = default;
};

/// How saving the state of a run went.
struct SavedState {
  double t = 0;           ///< of the last frame in it, s
  std::string file;       ///< relative to the run directory
  std::size_t bytes = 0;  ///< of the file
  std::string failure;    ///< why it could not be written; empty if it was
};

class PageChannel final : public ViewerProtocol {
 public:
  static constexpr const char* subprotocol = "incognita.v1";

  /// For how long a drive command of a viewer holds unless it is renewed by the same command.
  static constexpr std::chrono::milliseconds drive_holds{500};

  /// `command`: called in the server's thread for each message of a viewer; its InputError refuses the message.
  explicit PageChannel(std::function<void(const ViewerCommand&)> command);

  /// To be called once, before the first message.
  void attach(Server& server) { server_ = &server; }

  // From the thread of the loop:

  /// A run begins; viewers fetch what is known of it. `index`: number of the run.
  void begin(int index, const std::string& name, bool with_errors);
  /// Never waits for a viewer.
  void publish(std::shared_ptr<const Snapshot> snapshot);
  void set_state(const LiveState& state);
  // To all viewers:
  void refuse(const std::string& of, const std::string& why);
  void saved(const SavedState& saved);
  /// A drive command of that body was refused: there is nothing to stop.
  void forget_driver_of(std::size_t body);
  bool has_viewers() const { return viewer_count_ > 0; }

  // From the server's thread:

  /// What the observability monitor says, as JSON fields without braces.
  void put_observability(const std::string& json);
  void joined(std::uint64_t id, Viewer& viewer) override;
  void left(std::uint64_t id) override;
  void received(std::uint64_t id, std::string_view message, bool binary) override;

 private:
  struct Published {
    std::uint64_t seq;
    std::shared_ptr<const Snapshot> snapshot;
  };
  void stop_overdue_bodies();
  void watch_drivers();
  void deliver(Mailbox<Published>& mailbox);
  void send_to_all(const LiveMessage& message);
  void send_state();
  static bool has_image(const Published& published);
  LiveMessage message_of(const Published& published) const;

  std::function<void(const ViewerCommand&)> command_;
  Server* server_ = nullptr;
  std::atomic<int> viewer_count_{0};
  static constexpr std::size_t most_waiting = 16;
  /// One per run: what waits of a run is delivered before the next begins.
  std::shared_ptr<Mailbox<Published>> mailbox_ = std::make_shared<Mailbox<Published>>(most_waiting);
  std::uint64_t next_seq_ = 0;  ///< of the thread of the loop

  // Of the server's thread:
  DriveWatchdog watchdog_{drive_holds};
  bool is_watching_ = false;  ///< a look at the watchdog is planned
  std::map<std::uint64_t, Viewer*> viewers_;
  std::optional<LiveMessage> run_, observability_;
  std::optional<Published> last_published_;
  LiveState state_;
  bool with_errors_ = false;
};

}  // namespace incognita
