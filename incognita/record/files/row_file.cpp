#include "incognita/record/files/row_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::size_t max_pending_bytes = 64 * 1024;
constexpr double max_wait_s = 1.0;

/// Writes until done or an error; returns the number of bytes written, with errno set if not all were.
std::size_t write_all(int descriptor, std::string_view text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(descriptor, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

int open_new(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) throw RecordError(write_failure(path, errno));
  return descriptor;
}

const char* remedy(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "free some space or choose another folder with --out";
    case EFBIG:
      return "raise the file size limit (ulimit -f) or choose a shorter run";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder you may write to with --out";
    case ENOTDIR:
    case EEXIST:
      return "a file with this name exists; choose another folder with --out";
    default:
      return "choose another folder with --out";
  }
}

}  // namespace

std::string write_failure(const std::filesystem::path& path, int error) {
  return fmt::format("cannot write {}: {}; {}", path.string(), std::generic_category().message(error),
                     remedy(error));
}

RowFile::RowFile(std::filesystem::path path, std::string_view header) : path_(std::move(path)) {
  descriptor_ = open_new(path_);
  if (header.empty()) return;
  pending_.assign(header).push_back('\n');
  flush();
}

RowFile::~RowFile() {
  try {
    close();
  } catch (const RecordError&) {  // the file is valid as it is, and a destructor must not throw
  }
}

RowFile::RowFile(RowFile&& other) noexcept { *this = std::move(other); }

RowFile& RowFile::operator=(RowFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(pending_, other.pending_);
  std::swap(complete_, other.complete_);
  std::swap(flushed_t_s_, other.flushed_t_s_);
  std::swap(has_flushed_, other.has_flushed_);
  return *this;
}

void RowFile::append(std::string_view row, double t_s) {
  if (!is_open()) return;
  pending_.append(row).push_back('\n');
  if (!has_flushed_) flushed_t_s_ = t_s;
  has_flushed_ = true;
  // A clock that jumps back triggers a flush, too.
  if (pending_.size() < max_pending_bytes && t_s - flushed_t_s_ < max_wait_s && t_s >= flushed_t_s_) return;
  flushed_t_s_ = t_s;
  flush();
}

void RowFile::flush() {
  if (!is_open() || pending_.empty()) return;
  const std::size_t done = write_all(descriptor_, pending_);
  if (done < pending_.size()) {
    const int error = errno == 0 ? ENOSPC : errno;
    const std::size_t last_break = pending_.rfind('\n', done == 0 ? 0 : done - 1);
    if (done > 0 && last_break != std::string::npos) complete_ += static_cast<std::int64_t>(last_break) + 1;
    fail(error);
  }
  complete_ += static_cast<std::int64_t>(done);
  pending_.clear();
}

void RowFile::fail(int error) {
  // Truncating needs no disk space; if it fails nevertheless, there is no better fallback.
  [[maybe_unused]] const int cut = ::ftruncate(descriptor_, complete_);
  ::close(std::exchange(descriptor_, -1));
  pending_.clear();
  throw RecordError(write_failure(path_, error));
}

void RowFile::close() {
  if (!is_open()) return;
  flush();
  if (::close(std::exchange(descriptor_, -1)) != 0) throw RecordError(write_failure(path_, errno));
}

void write_whole_file(const std::filesystem::path& path, std::string_view text) {
  const int descriptor = open_new(path);
  const bool complete = write_all(descriptor, text) == text.size();
  const int write_error = errno;
  const bool closed = ::close(descriptor) == 0;
  if (complete && closed) return;
  const int error = complete ? errno : write_error;
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  throw RecordError(write_failure(path, error));
}

}  // namespace incognita
