// The camera of a laptop or phone that has the page open: docs/live-page.md.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incognita/live/server.hpp"
#include "incognita/world/live/live_source.hpp"
#include "incognita/world/live/newest.hpp"
#include "incognita/world/live/stream_times.hpp"

namespace incognita {

/// One camera at a time. It says {"type": "camera", "label", "width", "height"} first, then sends images as binary messages: the time
/// when the image was taken, s on any clock of its own (8 bytes, IEEE 754, little-endian), and the JPEG. Each image is
/// answered with {"type": "got", "t", "run_t": its time for the run, s}, so that a sender can bound how many are under way.
class BrowserCamera final : public ViewerProtocol, public LiveSource {
 public:
  static constexpr const char* subprotocol = "incognita.camera.v1";
  static constexpr std::size_t largest_message = 4u << 20;

  using Decode = std::function<Image(std::string_view jpeg)>;  ///< throws std::runtime_error
  explicit BrowserCamera(Decode decode) : decode_(std::move(decode)) {}

  /// The size that the next run needs; a camera of another size is refused.
  void expect(int width_px, int height_px);

  // From the server's thread:
  void joined(std::uint64_t id, Viewer& viewer) override;
  void left(std::uint64_t id) override;
  void received(std::uint64_t id, std::string_view message, bool binary) override;
  std::size_t largest_message_bytes() const override { return largest_message; }

  // From the thread of the loop:
  std::optional<LiveReading> read(double wait_s) override;
  std::string problem() const override;
  std::vector<std::string> take_events() override;
  std::vector<std::pair<std::string, std::int64_t>> counts() const override;

 private:
  struct Encoded {
    double t;
    std::string jpeg;
  };
  void greet(std::uint64_t id, std::string_view message);
  void take_image(std::uint64_t id, std::string_view message);
  void answer(std::uint64_t id, const std::string& json);
  std::string refusal_of(std::uint64_t id, std::string_view message);

  Decode decode_;
  Newest<Encoded> images_;

  // Of the server's thread
  std::map<std::uint64_t, Viewer*> viewers_;
  std::optional<std::uint64_t> sender_;
  StreamTimes times_;

  mutable std::mutex mutex_;  ///< of what follows
  int width_px_ = 0, height_px_ = 0;
  bool sends_ = false;
  std::int64_t damaged_ = 0;
  std::vector<std::string> events_;
};

}  // namespace incognita
