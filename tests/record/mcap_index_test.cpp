// The reader of run.mcap, against the writer and against the independent reader of the tests.
#include <gtest/gtest.h>

#include "incognita/messages/errors.hpp"
#include "incognita/record/mcap/mcap_file.hpp"
#include "incognita/record/mcap/mcap_reader.hpp"
#include "mcap_reader.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

namespace fs = std::filesystem;
using testing::contents;
using testing::message_of;
using testing::Scratch;

constexpr std::uint64_t second = 1'000'000'000;

std::string message(int i) { return "{\"x\":" + std::to_string(i) + "}"; }

/// Five chunks of 2 s.
fs::path written(const fs::path& path) {
  McapFile file(path, "test");
  const std::uint16_t a = file.add_channel("/a", "Number", "{}"), b = file.add_channel("/b", "Number", "{}");
  for (int i = 0; i < 100; ++i) {
    file.write(a, i * second / 10, message(i));
    if (i % 10 == 0) file.write(b, i * second / 10, message(-i));
  }
  file.close();
  return path;
}

/// The first `count` messages of /a, and all in that time of /b.
void expect_messages(const McapReader& reader, int count) {
  ASSERT_EQ(reader.messages("/a").size(), static_cast<std::size_t>(count));
  ASSERT_EQ(reader.messages("/b").size(), static_cast<std::size_t>((count + 9) / 10));
  for (int i = 0; i < count; ++i) {
    const bags::MessagePlace& place = reader.messages("/a")[static_cast<std::size_t>(i)];
    EXPECT_EQ(place.time_ns, i * second / 10);
    EXPECT_EQ(reader.text(place), message(i));
    if (i % 10 != 0) continue;
    EXPECT_EQ(reader.text(reader.messages("/b")[static_cast<std::size_t>(i / 10)]), message(-i));
  }
}

void overwrite(std::string& bytes, std::size_t at, const std::string& with) {
  bytes.replace(at, with.size(), with);
}

TEST(McapIndex, FindsTheMessagesThatWereWritten) {
  const Scratch scratch;
  const McapReader reader(written(scratch / "run.mcap"));
  expect_messages(reader, 100);
  EXPECT_EQ(reader.damage(), "");
  EXPECT_TRUE(reader.messages("/c").empty());
}

TEST(McapIndex, WithoutAnIndexReadsTheRecords) {
  const Scratch scratch;
  const std::string bytes = contents(written(scratch / "run.mcap"));
  const McapReader cut(scratch.write("cut.mcap", bytes.substr(0, bytes.size() - 1)));
  expect_messages(cut, 100);
  EXPECT_EQ(cut.damage(), "") << "all records are there";
  std::string wrong = bytes;  // the checksum of the summary is wrong
  wrong[bytes.size() - 60] ^= 1;
  expect_messages(McapReader(scratch.write("wrong.mcap", wrong)), 100);
}

TEST(McapIndex, OfACutFileHasItsCompleteChunks) {
  const Scratch scratch;
  const std::string bytes = contents(written(scratch / "run.mcap"));
  std::size_t last = 0;
  for (std::size_t size = 9; size < bytes.size(); size += 7) {
    const fs::path path = scratch.write("cut.mcap", bytes.substr(0, size));
    try {
      const McapReader reader(path);
      const std::size_t count = reader.messages("/a").size();
      EXPECT_EQ(count % 20, 0u);
      EXPECT_GE(count, last);
      expect_messages(reader, static_cast<int>(count));
      last = count;
    } catch (const InputError& error) {
      EXPECT_EQ(last, 0u) << error.what();
      EXPECT_HAS(error.what(), path.string() + ": at byte ");
      EXPECT_HAS(error.what(), "no message before it");
    }
  }
  EXPECT_EQ(last, 100u);
}

/// What a killed program may leave: a part of the next chunk over the old closing part, whose footer is intact.
TEST(McapIndex, OfAPartlyOverwrittenClosingPartHasTheChunksBefore) {
  const Scratch scratch;
  const std::string bytes = contents(written(scratch / "run.mcap"));
  const std::string chunk_head("\x06\x00\x10\x00\x00\x00\x00\x00\x00", 9);
  const std::size_t data_end = bytes.find(std::string("\x0F\x04\0\0\0\0\0\0\0", 9));
  ASSERT_NE(data_end, std::string::npos);
  std::string killed = bytes;
  overwrite(killed, data_end, chunk_head + std::string(40, '\1'));
  const McapReader reader(scratch.write("killed.mcap", killed));
  expect_messages(reader, 100);
  EXPECT_HAS(reader.damage(),
             "killed.mcap: at byte " + std::to_string(data_end) + ": a record of 4096 bytes is cut off");
}

TEST(McapIndex, StopsAtAWrongChecksum) {
  const Scratch scratch;
  std::string bytes = contents(written(scratch / "run.mcap"));
  bytes.resize(bytes.size() - 1);  // no index
  bytes[bytes.find(message(45))] = '[';
  const McapReader reader(scratch.write("run.mcap", bytes));
  expect_messages(reader, 40);
  EXPECT_HAS(reader.damage(), "the checksum of a chunk is wrong");
}

TEST(McapIndex, ItsEntriesAreChecked) {
  const Scratch scratch;
  const std::string bytes = contents(written(scratch / "run.mcap"));
  const std::size_t at = bytes.find(message(45));
  std::string wrong = bytes;
  wrong[at - 31] = '\x04';  // the message record becomes one of another kind
  const McapReader reader(scratch.write("run.mcap", wrong));
  ASSERT_EQ(reader.messages("/a").size(), 100u);
  EXPECT_HAS(message_of([&] { reader.text(reader.messages("/a")[45]); }),
             "run.mcap: at byte " + std::to_string(at - 31) + ": no complete message");
  wrong = bytes;
  overwrite(wrong, at - 30, std::string(8, '\xFF'));  // its length
  const McapReader longer(scratch.write("longer.mcap", wrong));
  EXPECT_HAS(message_of([&] { longer.text(longer.messages("/a")[45]); }), "no complete message");
}

TEST(McapIndex, IsThatOfTheIndependentReader) {
  const Scratch scratch;
  const std::string bytes = contents(written(scratch / "run.mcap"));
  const testing::McapContents expected = testing::read_mcap(bytes);
  const McapReader reader(scratch / "run.mcap");
  for (const std::string topic : {"/a", "/b"}) {
    const auto messages = expected.of(topic);
    ASSERT_EQ(reader.messages(topic).size(), messages.size());
    for (std::size_t i = 0; i < messages.size(); ++i) {
      EXPECT_EQ(reader.messages(topic)[i].time_ns, messages[i]->log_time_ns);
      EXPECT_EQ(reader.text(reader.messages(topic)[i]), messages[i]->data);
    }
  }
}

TEST(McapIndex, HasAFileThatIsStillBeingWritten) {
  const Scratch scratch;
  McapFile file(scratch / "run.mcap", "test");
  const std::uint16_t a = file.add_channel("/a", "Number", "{}");
  for (int i = 0; i < 30; ++i) file.write(a, i * second / 10, message(i));
  const McapReader early(scratch / "run.mcap");
  EXPECT_EQ(early.messages("/a").size(), 20u) << "the first chunk";
  for (int i = 30; i < 90; ++i) file.write(a, i * second / 10, message(i));
  file.close();
  EXPECT_EQ(early.text(early.messages("/a")[19]), message(19));
  EXPECT_EQ(McapReader(scratch / "run.mcap").messages("/a").size(), 90u);
}

TEST(McapIndex, RefusesOtherFiles) {
  const Scratch scratch;
  const std::string bytes = contents(written(scratch / "run.mcap"));
  const auto refusal = [&](const std::string& content) {
    const fs::path path = scratch.write("other.mcap", content);
    return message_of([&] { McapReader reader(path); });
  };
  EXPECT_HAS(refusal(""), "other.mcap: at byte 0: not an MCAP file; name the run.mcap of a run directory");
  EXPECT_HAS(refusal("\x89PNG\r\n and so on"), "not an MCAP file");
  EXPECT_HAS(refusal(bytes.substr(0, 8)), "no message before it");
  EXPECT_HAS(refusal(bytes.substr(0, 8) + std::string(1000, '\0')), "at byte 8: no record begins there");
  EXPECT_HAS(message_of([&] { McapReader reader(scratch / "none.mcap"); }), "none.mcap: cannot be read");
  EXPECT_HAS(message_of([&] { McapReader reader(scratch.folder()); }), "not a regular file");
}

TEST(McapIndex, RefusesOtherEncodingsAndCompression) {
  const Scratch scratch;
  std::string bytes = contents(written(scratch / "run.mcap"));
  std::string encoded = bytes;
  const std::string json("\x02\0\0\0/a\x04\0\0\0json", 14);  // topic and encoding of a channel
  for (std::size_t at = encoded.find(json); at != std::string::npos; at = encoded.find(json, at + 1))
    overwrite(encoded, at, std::string("\x02\0\0\0/a\x04\0\0\0ros1", 14));
  encoded.resize(encoded.size() - 1);                        // no index
  const std::size_t chunk = encoded.find("\x06");            // the first record after the header
  overwrite(encoded, chunk + 9 + 24, std::string(4, '\0'));  // no checksum
  EXPECT_HAS(message_of([&] { McapReader reader(scratch.write("ros.mcap", encoded)); }),
             "messages of `/a` are encoded as `ros1`, not as JSON");

  McapFile other(scratch / "zstd.mcap", "test");
  other.close();
  std::string compressed = contents(scratch / "zstd.mcap").substr(0, 8);
  compressed += std::string("\x06\x2C\0\0\0\0\0\0\0", 9) + std::string(28, '\0') +
                std::string("\x04\0\0\0zstd", 8) + std::string(8, '\0');
  EXPECT_HAS(message_of([&] { McapReader reader(scratch.write("zstd.mcap", compressed)); }),
             "zstd.mcap: at byte 8: compressed with `zstd`; decompress it: mcap decompress");
}

/// A file must not make the index larger than itself.
TEST(McapIndex, RefusesChunksThatOverlapInTheSummary) {
  const Scratch scratch;
  const std::string bytes = contents(written(scratch / "run.mcap"));
  // The second chunk index becomes a copy of the first; the summary is without a checksum then
  const std::size_t footer = bytes.size() - 8 - 29;
  std::string wrong = bytes;
  overwrite(wrong, footer + 9 + 16, std::string(4, '\0'));
  const std::size_t data_end = bytes.find(std::string("\x0F\x04\0\0\0\0\0\0\0", 9));
  const std::string head = std::string("\x08", 1);
  std::vector<std::size_t> indexes;
  for (std::size_t at = data_end + 13; at < footer;) {
    std::uint64_t length = 0;
    for (int i = 7; i >= 0; --i)
      length = length << 8 | static_cast<unsigned char>(bytes[at + 1 + static_cast<std::size_t>(i)]);
    if (bytes[at] == head[0]) indexes.push_back(at);
    at += 9 + length;
  }
  ASSERT_EQ(indexes.size(), 5u);
  expect_messages(McapReader(scratch.write("unchanged.mcap", wrong)), 100);
  overwrite(wrong, indexes[1], bytes.substr(indexes[0], indexes[1] - indexes[0]));
  expect_messages(McapReader(scratch.write("run.mcap", wrong)), 100);  // from the records
}

}  // namespace
}  // namespace incognita
