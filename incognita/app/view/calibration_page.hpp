// The page of a program that calibrates the camera of a device which has the page open.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <string_view>

#include "incognita/live/browser_camera.hpp"
#include "incognita/live/server.hpp"
#include "incognita/live/state_channel.hpp"
#include "incognita/world/live/live_source.hpp"

namespace incognita {

class CalibrationPage {
 public:
  static constexpr const char* subprotocol = "incognita.calibration.v1";

  /// `width_px` and `height_px`: what images must have; 0: any size. Throws InputError if the server cannot listen, or the program
  /// has no page.
  CalibrationPage(ServerSettings settings, int width_px, int height_px);

  std::string address() const { return server_->address(); }
  LiveSource& camera() { return *camera_; }
  /// `json`: what the viewers see; web/connection/calibration-socket.js tells its fields.
  void put(std::string json) { channel_->put(std::move(json)); }
  /// Whether a viewer wants the calibration as it is; once.
  bool take_finish() { return finish_.exchange(false); }
  /// Whether a viewer wants to start again; once.
  bool take_restart() { return restart_.exchange(false); }

 private:
  void command(std::string_view json);

  std::atomic<bool> finish_ = false, restart_ = false;
  std::shared_ptr<BrowserCamera> browser_ = std::make_shared<BrowserCamera>();
  std::shared_ptr<LiveSource> camera_;
  std::shared_ptr<StateChannel> channel_;
  std::unique_ptr<Server> server_;  ///< ends first
};

}  // namespace incognita
