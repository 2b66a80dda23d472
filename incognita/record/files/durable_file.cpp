#include "incognita/record/files/durable_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/row_file.hpp"
#include "incognita/record/files/write_at.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view mark = ".part-";
constexpr std::chrono::minutes age_of_the_dead{1};  // writing such a file takes milliseconds

/// A rename is durable only after the folder is synced; errors are ignored, as some file systems do not support it.
void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void write_durably(const fs::path& path, std::string_view text) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::string part = (folder / ("." + path.filename().string() + std::string(mark) + "XXXXXX")).string();
  const int descriptor = ::mkostemp(part.data(), O_CLOEXEC);
  if (descriptor < 0) throw RecordError(write_failure(path, errno));
  int error = write_at(descriptor, text, 0);
  // mkostemp() creates the file with mode 0600; use the mode of a file created by open().
  if (!error && ::fchmod(descriptor, 0644) != 0) error = errno;
  if (!error && ::fsync(descriptor) != 0) error = errno;
  if (::close(descriptor) != 0 && !error) error = errno;
  if (!error && ::rename(part.c_str(), path.c_str()) != 0) error = errno;
  if (error) {
    ::unlink(part.c_str());
    throw RecordError(write_failure(path, error));
  }
  sync_folder(folder);
}

void remove_partial_files(const fs::path& folder) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (fs::directory_iterator it(folder, ignored), end; !ignored && it != end; it.increment(ignored)) {
    const std::string name = it->path().filename().string();
    const bool ours = name.size() > mark.size() + 6 && name.front() == '.' &&
                      name.compare(name.size() - mark.size() - 6, mark.size(), mark) == 0;
    if (ours && fs::file_time_type::clock::now() - it->last_write_time(ignored) > age_of_the_dead)
      found.push_back(it->path());
  }
  for (const fs::path& file : found) fs::remove(file, ignored);
}

}  // namespace incognita
