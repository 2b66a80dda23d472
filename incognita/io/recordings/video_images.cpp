#include "incognita/io/recordings/video_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "incognita/io/recordings/video.hpp"

namespace incognita {
namespace {

constexpr std::size_t most_bytes = std::size_t{512} << 20;  // of all images that are kept

struct KeptImage {
  std::size_t number = 0;  ///< in the video
  SourceImage image;       ///< without its name yet
};

/// Chooses images while the video passes. Where more pass than were announced, every second one of the chosen is given up as often as
/// it takes.
class SpreadChoice {
 public:
  /// `expected`: number of images in the video; 0: as it announces.
  SpreadChoice(std::size_t most, std::size_t expected) : most_(most), expected_(expected) {}

  std::vector<KeptImage> kept;

  std::size_t most() const { return most_; }

  void see(const PassingImage& passing) {
    if (expected_ == 0) expected_ = passing.announced;
    if (passing.number < next()) return;
    if (kept.size() >= most_) {
      if (passing.number <= span_ + span_ / 16) return;  // what is announced may be wrong by a few images
      thin_out();
      if (kept.size() >= most_ || passing.number < next()) return;
    }
    kept.push_back({passing.number, decoded(passing)});
    const Image& image = kept.back().image.image;
    if (!size_is_known_ && !image.empty()) begin_with(image);
  }

 private:
  /// The number of the image that is kept next.
  std::size_t next() const { return kept.size() * span_ / most_; }

  void thin_out() {
    for (std::size_t i = 1; 2 * i < kept.size(); ++i) kept[i] = std::move(kept[2 * i]);
    kept.resize((kept.size() + 1) / 2);
    span_ *= 2;
  }

  void begin_with(const Image& first) {
    size_is_known_ = true;
    const auto bytes = static_cast<std::size_t>(first.width()) * static_cast<std::size_t>(first.height());
    if (bytes > 0) most_ = std::clamp<std::size_t>(most_bytes / bytes, 1, most_);
    span_ = std::max(expected_, most_);
  }

  static SourceImage decoded(const PassingImage& passing) {
    try {
      return {"", passing.decode(), ""};
    } catch (const std::runtime_error& error) {
      return {"", {}, error.what()};
    }
  }

  std::size_t most_, expected_;
  std::size_t span_ = 1;        ///< of so many images `most_` are kept
  bool size_is_known_ = false;  ///< of the images: the first may be damaged
};

class KeptImages final : public ImageSource {
 public:
  explicit KeptImages(std::vector<SourceImage> images) : images_(std::move(images)) {}

  std::optional<SourceImage> next() override {
    if (next_ == images_.size()) return std::nullopt;
    return images_[next_++];
  }
  void skip() override { next_ = std::min(next_ + 1, images_.size()); }
  void rewind() override { next_ = 0; }
  std::size_t count() const override { return images_.size(); }

 private:
  std::vector<SourceImage> images_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<ImageSource> open_video_images(const std::filesystem::path& video, std::size_t most) {
  SpreadChoice choice(most, 0);
  const auto see = [&](const PassingImage& passing) { choice.see(passing); };
  const Recording recording = read_video(video, see);
  const std::size_t images_there = recording.frames.size();
  if (2 * choice.kept.size() <
      std::min(choice.most(), images_there)) {  // far more were announced than are there
    choice = SpreadChoice(most, images_there);
    read_video(video, see);
  }
  std::vector<SourceImage> images;
  for (KeptImage& kept : choice.kept) {
    if (kept.number >= images_there) continue;  // beside damage
    kept.image.name = fmt::format("{} at {:.2f} s", video.string(), recording.frames[kept.number].t);
    images.push_back(std::move(kept.image));
  }
  return std::make_unique<KeptImages>(std::move(images));
}

}  // namespace incognita
