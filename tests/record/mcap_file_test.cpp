#include "incognita/record/mcap/mcap_file.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "file_size_limit.hpp"
#include "incognita/messages/errors.hpp"
#include "mcap_reader.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::contents;
using testing::McapContents;
using testing::read_mcap;
using testing::Scratch;

constexpr std::uint64_t second = 1'000'000'000;
constexpr const char* number_schema = R"({"type":"object","properties":{"x":{"type":"number"}}})";

std::string message(int i, std::size_t bytes = 0) {
  return "{\"x\":" + std::to_string(i) + std::string(bytes, ' ') + "}";
}

/// Over `seconds`, ten messages per second of `bytes` each on /a, and one per second on /b.
void fill(McapFile& file, int seconds, std::size_t bytes = 0) {
  const std::uint16_t a = file.add_channel("/a", "test.Number", number_schema);
  const std::uint16_t b = file.add_channel("/b", "test.Number", number_schema);
  for (int i = 0; i < 10 * seconds; ++i) {
    file.write(a, i * second / 10, message(i, bytes));
    if (i % 10 == 0) file.write(b, i * second / 10, message(-i));
  }
}

TEST(McapFile, ContainsWhatWasWritten) {
  const Scratch scratch;
  McapFile file(scratch / "run.mcap", "incognita test");
  fill(file, 5);
  file.close();
  const McapContents read = read_mcap(contents(scratch / "run.mcap"));
  EXPECT_EQ(read.library, "incognita test");
  EXPECT_EQ(read.schemas, (std::map<std::string, std::string>{{"test.Number", number_schema}}));
  EXPECT_EQ(read.schema_of_topic,
            (std::map<std::string, std::string>{{"/a", "test.Number"}, {"/b", "test.Number"}}));
  ASSERT_EQ(read.count("/a"), 50u);
  ASSERT_EQ(read.count("/b"), 5u);
  for (int i = 0; i < 50; ++i) {
    const auto& found = *read.of("/a")[static_cast<std::size_t>(i)];
    EXPECT_EQ(found.data, message(i));
    EXPECT_EQ(found.log_time_ns, i * second / 10);
    EXPECT_EQ(found.publish_time_ns, found.log_time_ns);
  }
  EXPECT_EQ(read.of("/b")[4]->data, message(-40));
}

TEST(McapFile, WithoutMessagesIsValid) {
  const Scratch scratch;
  {
    McapFile file(scratch / "run.mcap", "incognita test");
    EXPECT_TRUE(read_mcap(contents(scratch / "run.mcap")).messages.empty());  // also while it is open
    file.add_channel("/a", "test.Number", number_schema);
  }
  EXPECT_TRUE(read_mcap(contents(scratch / "run.mcap")).schemas.empty());
}

TEST(McapFile, ClosesAChunkAtAMegabyteOrTwoSeconds) {
  const Scratch scratch;
  McapFile slow(scratch / "slow.mcap", ""), large(scratch / "large.mcap", "");
  fill(slow, 10);
  fill(large, 10, 100'000);  // a megabyte per second
  slow.close();
  large.close();
  EXPECT_EQ(read_mcap(contents(scratch / "slow.mcap")).chunk_sizes.size(), 5u);
  const auto sizes = read_mcap(contents(scratch / "large.mcap")).chunk_sizes;
  ASSERT_EQ(sizes.size(), 10u);
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i) {
    EXPECT_GE(sizes[i], 1024u * 1024u);
    EXPECT_LT(sizes[i], 1024u * 1024u + 110'000u);
  }
}

TEST(McapFile, IsReadableWhileItIsWritten) {
  const Scratch scratch;
  McapFile file(scratch / "run.mcap", "");
  const std::uint16_t a = file.add_channel("/a", "test.Number", number_schema);
  std::size_t last = 0;
  for (int i = 0; i < 200; ++i) {
    file.write(a, i * second / 10, message(i));
    const std::size_t there = read_mcap(contents(scratch / "run.mcap")).messages.size();
    EXPECT_GE(there, last);
    EXPECT_GE(there + 20, static_cast<std::size_t>(i)) << "two seconds are missing at most";
    last = there;
  }
  EXPECT_GT(last, 0u);
}

TEST(McapFile, AcceptsAClockThatJumpsBackAndALateChannel) {
  const Scratch scratch;
  McapFile file(scratch / "run.mcap", "");
  const std::uint16_t a = file.add_channel("/a", "test.Number", number_schema);
  for (const std::uint64_t t : {10 * second, 11 * second, 3 * second, 4 * second}) file.write(a, t, "{}");
  file.write(file.add_channel("/late", "test.Other", "{}"), 5 * second, "{}");
  file.close();
  const McapContents read = read_mcap(contents(scratch / "run.mcap"));
  EXPECT_EQ(read.messages.size(), 5u);
  EXPECT_EQ(read.schema_of_topic.at("/late"), "test.Other");
}

TEST(McapFile, SameMessagesSameBytes) {
  const Scratch scratch;
  for (const char* name : {"one", "two"}) {
    McapFile file(scratch / name, "incognita test");
    fill(file, 7, 1000);
  }
  EXPECT_EQ(contents(scratch / "one"), contents(scratch / "two"));
  EXPECT_FALSE(contents(scratch / "one").empty());
}

TEST(McapFile, OnAFullDiskKeepsItsCompleteChunksAndIsClosed) {
  for (const rlim_t bytes : {5'000, 100'000, 2'500'000, 4'000'001}) {
    const Scratch scratch;
    const testing::FileSizeLimit limit(bytes);
    McapFile file(scratch / "run.mcap", "");
    std::string reason;
    try {
      fill(file, 100, 50'000);  // a chunk is a megabyte
    } catch (const RecordError& error) {
      reason = error.what();
    }
    EXPECT_NE(reason.find("run.mcap"), std::string::npos) << reason;
    EXPECT_NE(reason.find("ulimit"), std::string::npos) << reason;
    EXPECT_FALSE(file.is_open());
    EXPECT_NO_THROW(file.write(1, 1000 * second, "{}"));  // the failure was reported once
    EXPECT_NO_THROW(file.close());
    const McapContents read = read_mcap(contents(scratch / "run.mcap"));
    EXPECT_EQ(read.chunk_sizes.size(), bytes / 1'060'000) << "as many whole chunks as fit";
    for (std::size_t i = 0; i < read.count("/a"); ++i)
      EXPECT_EQ(read.of("/a")[i]->data, message(static_cast<int>(i), 50'000));
  }
}

TEST(McapFile, LosesAtMostTwoSecondsWhenKilled) {
  const Scratch scratch;
  const pid_t child = ::fork();
  if (child == 0) {
    McapFile file(scratch / "run.mcap", "");
    fill(file, 60, 1000);
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_GE(read_mcap(contents(scratch / "run.mcap")).count("/a"), 580u);
}

TEST(McapFile, TruncatedAnywhereKeepsItsCompleteChunks) {
  const Scratch scratch;
  McapFile file(scratch / "run.mcap", "");
  fill(file, 10, 1000);
  file.close();
  const std::string whole = contents(scratch / "run.mcap");
  std::size_t last = 0;
  for (std::size_t size = 200; size < whole.size(); size += 997) {
    EXPECT_THROW(read_mcap(whole.substr(0, size)), std::runtime_error);
    const std::size_t there = testing::read_open_mcap(whole.substr(0, size)).messages.size();
    EXPECT_GE(there, last);
    last = there;
  }
  EXPECT_EQ(last, 110u);
}

TEST(McapFile, NamesTheFileThatItCannotOpen) {
  try {
    McapFile("/nowhere/at/all.mcap", "");
    FAIL();
  } catch (const RecordError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all.mcap"), std::string::npos);
  }
  const Scratch scratch;
  const testing::FileSizeLimit limit(20);
  EXPECT_THROW(McapFile(scratch / "run.mcap", ""), RecordError);
  EXPECT_FALSE(std::filesystem::exists(scratch / "run.mcap"));
}

TEST(McapReader, DetectsEveryChangedByte) {  // so that the tests above can fail
  const Scratch scratch;
  McapFile file(scratch / "run.mcap", "incognita test");
  fill(file, 3);
  file.close();
  const std::string whole = contents(scratch / "run.mcap");
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 4);
    EXPECT_ANY_THROW(read_mcap(changed)) << "byte " << i;
  }
}

}  // namespace
}  // namespace incognita
