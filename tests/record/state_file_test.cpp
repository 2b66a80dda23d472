// A state file is either whole or refused, whatever happens to it or to the program that writes it.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/crc.hpp>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "incognita/record/files/durable_file.hpp"
#include "incognita/record/files/state_file.hpp"
#include "tests/record/file_size_limit.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::Scratch;

std::string small_file() {
  return state_file_bytes("0.1.0",
                          {{"scenario", "[run]\n"}, {"estimate", std::string(100, '\x7f')}, {"empty", ""}});
}

std::string refusal_of(const Scratch& scratch, const std::string& bytes) {
  const auto path = scratch.write("run.state", bytes);
  const std::string message = message_of([&] { read_state_file(path); });
  if (message != "(none)") {
    EXPECT_HAS(message, path.string());
  }
  return message;
}

TEST(StateFile, IsReadAsWritten) {
  const Scratch scratch;
  const StateFile file = read_state_file(scratch.write("run.state", small_file()));
  EXPECT_EQ(file.program_version, "0.1.0");
  ASSERT_EQ(file.sections.size(), 3u);
  EXPECT_EQ(file.section("scenario").bytes, "[run]\n");
  EXPECT_EQ(file.section("scenario").offset, 60u + 3 * 32);
  EXPECT_EQ(file.section("estimate").bytes, std::string(100, '\x7f'));
  EXPECT_TRUE(file.has("empty"));
  EXPECT_HAS(message_of([&] { (void)file.section("world"); }), "has no section `world`");
}

TEST(StateFile, EveryTruncationIsRefused) {
  const Scratch scratch;
  const std::string bytes = small_file();
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_NE(refusal_of(scratch, bytes.substr(0, size)), "(none)") << size;
}

TEST(StateFile, EveryChangedByteIsRefused) {
  const Scratch scratch;
  const std::string bytes = small_file();
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (const int change : {1, 0x80, 0xff}) {
      std::string other = bytes;
      other[at] = static_cast<char>(other[at] ^ change);
      EXPECT_NE(refusal_of(scratch, other), "(none)") << at;
    }
}

TEST(StateFile, SaysWhatIsWrongAndWhatToDo) {
  const Scratch scratch;
  const std::string bytes = small_file();
  std::string other = bytes;
  other[60 + 3 * 32 + 6 + 50] = 0;
  EXPECT_HAS(refusal_of(scratch, other),
             "the checksum of section `estimate`, bytes 162 to 262, does not fit");
  EXPECT_HAS(refusal_of(scratch, other), "resume from another file");
  EXPECT_HAS(refusal_of(scratch, bytes + "more"),
             "the last section ends at byte 262, and the file at byte 266");
  EXPECT_HAS(refusal_of(scratch, bytes.substr(0, 200)),
             "section `estimate` is at bytes 162 to 262, and the file ends at byte 200");
}

TEST(StateFile, ForeignFilesAreRefused) {
  const Scratch scratch;
  for (const std::string& bytes :
       {std::string("\x89PNG\r\n\x1a\n and more than sixty bytes of something else entirely, no state"),
        std::string("[run]\nseed = 1\n"), std::string(100'000, '\0')})
    EXPECT_HAS(refusal_of(scratch, bytes), "is not a saved run; name a run.state that `incognita run` wrote");
  EXPECT_HAS(message_of([&] { read_state_file(scratch.folder()); }), "is not a regular file");
  EXPECT_HAS(message_of([&] { read_state_file(scratch / "none"); }), "cannot be read: No such file");
}

TEST(StateFile, AnotherFormatIsRefusedWithItsVersion) {
  const Scratch scratch;
  std::string bytes = state_file_bytes("0.9.2", {{"scenario", ""}});
  const std::uint32_t newer = state_format + 1;
  std::memcpy(bytes.data() + 16, &newer, sizeof newer);
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), 56);
  const auto sum = static_cast<std::uint32_t>(crc.checksum());
  std::memcpy(bytes.data() + 56, &sum, sizeof sum);
  const std::string message = refusal_of(scratch, bytes);
  EXPECT_HAS(message, "has format 2, written by incognita 0.9.2; this program reads format 1");
  EXPECT_HAS(message, "resume it with that version");
}

/// The n-th of a series of files, of other sizes each.
std::string numbered_file(int n) {
  return state_file_bytes("0.1.0",
                          {{"number", std::to_string(n)},
                           {"content", std::string(200'000 + static_cast<std::size_t>(n * 7919 % 800'000),
                                                   static_cast<char>('a' + n % 26))}});
}

TEST(StateFile, OpensAfterEachOfFiftyKills) {
  const Scratch scratch;
  const auto path = scratch / "run.state";
  write_durably(path, numbered_file(0));
  std::mt19937 random(1);
  for (int kill = 0; kill < 50; ++kill) {
    const pid_t child = ::fork();
    if (child == 0) {
      for (int n = 1;; ++n) write_durably(path, numbered_file(n));
    }
    ASSERT_GT(child, 0);
    ::usleep(static_cast<useconds_t>(500 + random() % 20'000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const StateFile file = read_state_file(path);
    ASSERT_EQ(file.sections.size(), 2u) << kill;
  }
}

TEST(StateFile, AFullDiskLeavesTheLastGoodFile) {
  const Scratch scratch;
  const auto path = scratch / "run.state";
  write_durably(path, numbered_file(1));
  const std::string next = numbered_file(2);
  for (std::size_t limit = 0; limit < next.size(); limit += next.size() / 20) {
    const testing::FileSizeLimit full(limit);
    EXPECT_HAS(message_of<RecordError>([&] { write_durably(path, next); }), "run.state: File too large");
  }
  EXPECT_EQ(read_state_file(path).section("number").bytes, "1");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scratch.folder())) files += entry.exists();
  EXPECT_EQ(files, 1u);  // no part is left
}

}  // namespace
}  // namespace incognita
