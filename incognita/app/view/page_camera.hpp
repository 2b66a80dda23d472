// The camera of the page as the loop sees it: its images are decoded.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "incognita/live/browser_camera.hpp"
#include "incognita/world/live/live_source.hpp"

namespace incognita {

class PageCamera final : public LiveSource {
 public:
  explicit PageCamera(std::shared_ptr<BrowserCamera> camera) : camera_(std::move(camera)) {}

  /// An image that cannot be decoded is skipped, and the first such is said.
  std::optional<LiveReading> read(double wait_s) override;
  std::string problem() const override { return camera_->problem(); }
  std::vector<std::string> take_events() override;
  std::vector<std::pair<std::string, std::int64_t>> counts() const override;

 private:
  std::shared_ptr<BrowserCamera> camera_;
  std::vector<std::string> events_;
  std::int64_t damaged_ = 0;
};

}  // namespace incognita
