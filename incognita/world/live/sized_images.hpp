// Refuses images of another size than that of the camera model.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "incognita/world/live/live_source.hpp"

namespace incognita {

class SizedImages final : public LiveSource {
 public:
  SizedImages(std::shared_ptr<LiveSource> source, int width_px, int height_px)
      : source_(std::move(source)), width_px_(width_px), height_px_(height_px) {}

  /// Throws std::runtime_error with both sizes.
  std::optional<LiveReading> read(double wait_s) override;
  bool has_ended() const override { return source_->has_ended(); }
  std::string problem() const override { return source_->problem(); }
  std::vector<std::string> take_events() override { return source_->take_events(); }
  std::vector<std::pair<std::string, std::int64_t>> counts() const override { return source_->counts(); }

 private:
  std::shared_ptr<LiveSource> source_;
  int width_px_, height_px_;
};

}  // namespace incognita
