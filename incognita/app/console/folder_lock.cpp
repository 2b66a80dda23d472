#include "incognita/app/console/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "incognita/app/console/print_message.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/folders.hpp"
#include "incognita/record/files/row_file.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

// Byte-range locks; the bytes need not exist. A run or an undivided campaign locks all bytes. A shard locks
// the byte of its number exclusively and shares the byte of its campaign with the other shards; it then
// checks that no other campaign's byte is locked.
constexpr off_t campaigns = off_t{1} << 40, campaigns_end = campaigns << 1;
constexpr off_t everything = 0;  // as a length

struct flock bytes(short kind, off_t from, off_t length) {
  struct flock lock = {};
  lock.l_type = kind;
  lock.l_whence = SEEK_SET;
  lock.l_start = from;
  lock.l_len = length;
  return lock;
}

/// Returns 0 or errno.
int take(int descriptor, short kind, off_t from, off_t length) {
  struct flock lock = bytes(kind, from, length);
  return ::fcntl(descriptor, F_SETLK, &lock) == 0 ? 0 : errno;
}

bool others_have(int descriptor, off_t from, off_t end) {
  struct flock lock = bytes(F_WRLCK, from, end - from);
  return from < end && ::fcntl(descriptor, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

bool is_held_by_another(int error) { return error == EAGAIN || error == EACCES; }

std::string busy(const fs::path& folder, const std::string& who) {
  return fmt::format("--out {}: {} is running in it; wait for its end, or choose another folder with --out",
                     folder.string(), who);
}

off_t byte_of(const SharedCampaign& share) {
  constexpr std::size_t digits = 9;  // 4 bits each: fewer values than there are bytes for campaigns
  return campaigns + std::stoll(share.digest.substr(0, digits), nullptr, 16);
}

/// Returns 0, or errno if locks are not supported. Throws InputError if another process holds the lock.
int lock_for(int descriptor, const fs::path& folder, const std::optional<SharedCampaign>& share) {
  const auto tried = [](int error, const std::string& refusal) {
    if (is_held_by_another(error)) throw InputError(refusal);
    return error;
  };
  const std::string another = busy(folder, "another command");
  if (!share) return tried(take(descriptor, F_WRLCK, 0, everything), another);
  const Shard shard = share->shard;
  const off_t campaign = byte_of(*share);
  if (const int error = tried(take(descriptor, F_RDLCK, campaign, 1), another)) return error;
  if (others_have(descriptor, campaigns, campaign) || others_have(descriptor, campaign + 1, campaigns_end))
    throw InputError(busy(folder, "another campaign, or another number of shards of this one,"));
  return tried(take(descriptor, F_WRLCK, static_cast<off_t>(shard.which), 1),
               busy(folder, fmt::format("another process with --shard {}/{}", shard.which + 1, shard.of)));
}

/// Whether the open file is still the one of that name, not one that its last owner has removed.
bool is_current(int descriptor, const fs::path& file) {
  struct stat here = {}, there = {};
  return ::fstat(descriptor, &here) == 0 && ::stat(file.c_str(), &there) == 0 && here.st_ino == there.st_ino;
}

int opened(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) throw RecordError(write_failure(file, errno));
  return descriptor;
}

void make(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
  if (error) throw RecordError(write_failure(folder, error.value()));
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, const std::optional<SharedCampaign>& share)
    : file_(folder / ".lock"), made_(missing_folders(folder)) {
  try {
    do {
      make(folder);
      if (descriptor_ >= 0) ::close(descriptor_);
      descriptor_ = opened(file_);
      if (const int error = lock_for(descriptor_, folder, share))
        print_message("{} cannot be locked ({}): make sure that no other run or campaign writes to it\n",
                      folder.string(), std::generic_category().message(error));
    } while (!is_current(descriptor_, file_));
  } catch (...) {
    if (descriptor_ >= 0) ::close(descriptor_);
    remove_empty(made_);
    throw;
  }
}

FolderLock::~FolderLock() {
  if (take(descriptor_, F_WRLCK, 0, everything) == 0 && is_current(descriptor_, file_))
    ::unlink(file_.c_str());
  ::close(descriptor_);
  remove_empty(made_);
}

}  // namespace incognita
