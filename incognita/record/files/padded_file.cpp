#include "incognita/record/files/padded_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/row_file.hpp"
#include "incognita/record/files/write_at.hpp"

namespace incognita {

PaddedFile::PaddedFile(const std::filesystem::path& path, std::string_view text) : path_(path) {
  descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) throw RecordError(write_failure(path, errno));
  try {
    overwrite(text);
  } catch (...) {
    ::close(descriptor_);
    ::unlink(path.c_str());
    throw;
  }
}

PaddedFile::~PaddedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void PaddedFile::overwrite(std::string_view text) {
  if (text.size() >= size_bytes)
    throw std::length_error(path_.string() + ": " + std::to_string(text.size()) + " bytes");
  std::string block(size_bytes, ' ');
  block.replace(0, text.size(), text);
  block.back() = '\n';
  if (const int error = write_at(descriptor_, block, 0)) throw RecordError(write_failure(path_, error));
}

void PaddedFile::finish(std::string_view text) {
  overwrite(text);
  const off_t end = static_cast<off_t>(text.size());
  if (::ftruncate(descriptor_, end) != 0) throw RecordError(write_failure(path_, errno));
}

}  // namespace incognita
