// The camera of a laptop or phone that has the page open: docs/live-page.md.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incognita/live/server.hpp"
#include "incognita/messages/newest.hpp"
#include "incognita/messages/stream_times.hpp"

namespace incognita {

/// One camera at a time. It says {"type": "camera", "label", "width", "height"} first, then sends images as binary messages: the time
/// when the image was taken, s on any clock of its own (8 bytes, IEEE 754, little-endian), and the JPEG. Each image is
/// answered with {"type": "got", "t", "run_t": its time for the run, s}, so that a sender can bound how many are under way.
class BrowserCamera final : public ViewerProtocol {
 public:
  static constexpr const char* subprotocol = "incognita.camera.v1";
  static constexpr std::size_t largest_message = 4u << 20;
  static constexpr const char* of_calibrated_camera =
      "hold a phone so that the image lies as it was calibrated, or set camera.width_px and camera.height_px with the calibration for this "
      "size";

  struct Received {
    double t = 0;  ///< s, from 0 at the first image, increasing, in whole microseconds
    std::string jpeg;
  };

  /// A run begins, and needs images of that size (0: of any); a camera of another size is refused, with the remedy. Images of before
  /// are forgotten.
  void expect(int width_px, int height_px, const std::string& remedy = of_calibrated_camera);

  // From the server's thread:
  void joined(std::uint64_t id, Viewer& viewer) override;
  void left(std::uint64_t id) override;
  void received(std::uint64_t id, std::string_view message, bool binary) override;
  std::size_t largest_message_bytes() const override { return largest_message; }

  // From the thread of the loop:
  /// The newest image that has not been returned; waits for it. Nothing if none comes in time.
  std::optional<Received> receive(double wait_s) { return images_.take(wait_s); }
  /// Why nothing comes, and the remedy; empty if a camera sends.
  std::string problem() const;
  /// What happened since the last call, for printing.
  std::vector<std::string> take_events();
  /// Images that a newer one replaced.
  std::int64_t dropped() const { return images_.dropped(); }

 private:
  void greet(std::uint64_t id, std::string_view message);
  void take_image(std::uint64_t id, std::string_view message);
  void answer(std::uint64_t id, const std::string& json);
  void note(std::string event);
  std::string refusal_of(std::uint64_t id, std::string_view message);

  Newest<Received> images_;

  // Of the server's thread
  std::map<std::uint64_t, Viewer*> viewers_;
  std::optional<std::uint64_t> sender_;
  StreamTimes times_;

  mutable std::mutex mutex_;  ///< of what follows
  int width_px_ = 0, height_px_ = 0;
  std::string remedy_;  ///< for a camera of another size
  bool sends_ = false;
  std::vector<std::string> events_;
};

}  // namespace incognita
