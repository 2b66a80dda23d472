#include "incognita/io/formats/image_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "incognita/io/formats/image_file.hpp"
#include "incognita/io/formats/image_names.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

class ImageFiles final : public ImageSource {
 public:
  explicit ImageFiles(std::vector<std::filesystem::path> files) : files_(std::move(files)) {}

  std::optional<SourceImage> next() override {
    if (next_ == files_.size()) return std::nullopt;
    const std::filesystem::path& file = files_[next_++];
    try {
      return SourceImage{file.string(), read_image(file), ""};
    } catch (const std::runtime_error& error) {
      return SourceImage{file.string(), {}, error.what()};
    }
  }
  void skip() override { next_ = std::min(next_ + 1, files_.size()); }
  void rewind() override { next_ = 0; }
  std::size_t count() const override { return files_.size(); }

 private:
  std::vector<std::filesystem::path> files_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<ImageSource> open_images(const std::vector<std::filesystem::path>& files_and_folders) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& path : files_and_folders) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
      const std::vector<std::filesystem::path> inside = images_in(path);
      if (inside.empty())
        throw InputError(fmt::format("{}: there are no images in this folder", path.string()));
      files.insert(files.end(), inside.begin(), inside.end());
    } else if (std::filesystem::exists(path, ignored)) {
      files.push_back(path);
    } else {
      throw InputError(fmt::format("{}: there is no such file or folder", path.string()));
    }
  }
  return std::make_unique<ImageFiles>(std::move(files));
}

}  // namespace incognita
