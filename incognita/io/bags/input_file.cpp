#include "incognita/io/bags/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "incognita/messages/errors.hpp"

namespace incognita {

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) throw InputError(path_.string() + ": cannot be read: " + std::strerror(errno));
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor_);
    throw InputError(path_.string() + ": is not a regular file; name a file on a disk");
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() { ::close(descriptor_); }

std::string InputFile::read(std::uint64_t offset, std::uint64_t length) const {
  const auto failed = [&](const std::string& why) {
    return InputError(path_.string() + ": at byte " + std::to_string(offset) + ": " + why);
  };
  if (offset > size_ || length > size_ - offset)
    throw failed(std::to_string(length) + " bytes are expected, the file ends at byte " +
                 std::to_string(size_) + "; it is not complete");
  std::string bytes(length, '\0');
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n =
        ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw failed(std::string("cannot be read: ") + std::strerror(errno));
    if (n == 0) throw failed("the file became shorter while it was read; open it again");
    done += static_cast<std::size_t>(n);
  }
  return bytes;
}

}  // namespace incognita
