#include "incognita/io/recordings/indexed_images.hpp"

#include <utility>

#include "incognita/io/formats/image_file.hpp"

namespace incognita {
namespace {

class ImageFiles final : public IndexedImages {
 public:
  explicit ImageFiles(std::vector<std::filesystem::path> files) : files_(std::move(files)) {}

  std::shared_ptr<const Image> read(std::size_t frame) override {
    return std::make_shared<const Image>(read_image(files_.at(frame)));
  }

 private:
  std::vector<std::filesystem::path> files_;
};

}  // namespace

std::shared_ptr<IndexedImages> image_files(std::vector<std::filesystem::path> files) {
  return std::make_shared<ImageFiles>(std::move(files));
}

}  // namespace incognita
