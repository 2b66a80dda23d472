#include "incognita/io/recordings/video_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "incognita/io/recordings/video.hpp"

namespace incognita {
namespace {

class SpreadImages final : public ImageSource {
 public:
  SpreadImages(Recording video, std::size_t most)
      : video_(std::move(video)), count_(std::min(most, video_.frames.size())) {}

  std::optional<SourceImage> next() override {
    if (done_ >= count_) return std::nullopt;
    const std::size_t frame = done_++ * video_.frames.size() / count_;
    SourceImage found{fmt::format("{} at {:.2f} s", video_.folder.string(), video_.frames[frame].t), {}, ""};
    try {
      found.image = *video_.images->read(frame);
    } catch (const std::runtime_error& error) {
      found.failure = error.what();
    }
    return found;
  }
  void skip() override { ++done_; }
  std::size_t count() const override { return count_; }

 private:
  Recording video_;
  std::size_t count_, done_ = 0;
};

}  // namespace

std::unique_ptr<ImageSource> open_video_images(const std::filesystem::path& video, std::size_t most) {
  return std::make_unique<SpreadImages>(read_video(video), most);
}

}  // namespace incognita
