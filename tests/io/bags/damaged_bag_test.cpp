// Bags that are cut off or damaged: what comes before is used, and errors name file and byte. Nothing crashes.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "incognita/io/recordings/recording.hpp"
#include "incognita/messages/errors.hpp"
#include "tests/io/bags/bag_scene.hpp"
#include "tests/io/damage.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::contents;
using testing::Scratch;
using testing::written_bag;

std::string all_notes(const Recording& recording) {
  std::string all;
  for (const std::string& note : recording.notes) all += note + "\n";
  return all;
}

/// Reads the bytes as a bag and all its images; the recording if it was accepted. Errors must name the file.
std::optional<Recording> read_bytes(const Scratch& scratch, const std::string& bytes,
                                    const BagTopics& topics = {}) {
  const std::filesystem::path path = scratch.write("x.bag", bytes);
  std::optional<Recording> recording;
  try {
    recording = read_recording(path, "bag", 30, "", topics);
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(path.string())) << error.what();
    EXPECT_LT(std::string(error.what()).size(), 3000u);
    return std::nullopt;
  }
  EXPECT_FALSE(recording->frames.empty());
  for (std::size_t i = 0; i < recording->frames.size(); ++i) {
    EXPECT_TRUE(i == 0 || recording->frames[i - 1].t < recording->frames[i].t);
    try {
      EXPECT_FALSE(recording->images->read(i)->empty());
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(path.string())) << error.what();
    }
  }
  for (const RecordedPose& pose : recording->truth) {
    EXPECT_TRUE(std::isfinite(pose.t) && pose.position.allFinite());
    EXPECT_NEAR(pose.world_from_camera.norm(), 1, 1e-9);
  }
  return recording;
}

class DamagedBag : public ::testing::TestWithParam<std::string> {
 protected:
  const std::string whole_ = contents(written_bag(GetParam()));
  const Scratch scratch_;
};

/// The images that were found are the first ones of their topic, and whole. Without a topic named, the guess follows what is there.
TEST_P(DamagedBag, ThatIsCutOffHasWhatComesBefore) {
  std::size_t last = 0;
  for (std::size_t size = 0; size < whole_.size(); size += size < 600 ? 13 : 331) {
    const auto recording = read_bytes(scratch_, whole_.substr(0, size), {"/cam/image_raw", ""});
    if (!recording) {
      EXPECT_EQ(last, 0u) << size;
      continue;
    }
    const auto images = static_cast<std::size_t>(recording->frames.size());
    EXPECT_GE(images, last) << size;
    EXPECT_LE(images, 12u);
    for (std::size_t i = 0; i < images; ++i)
      EXPECT_EQ(*recording->images->read(i), testing::bag_image(static_cast<int>(i))) << size;
    last = images;
  }
  EXPECT_EQ(last, 12u);
}

TEST_P(DamagedBag, ThatIsCutOffSaysWhere) {
  const std::size_t half = whole_.size() / 2;
  const auto recording = read_bytes(scratch_, whole_.substr(0, half));
  ASSERT_TRUE(recording);
  const std::string notes = all_notes(*recording);
  EXPECT_HAS(notes, "x.bag: at byte ");
  EXPECT_HAS(notes, "is cut off");
  EXPECT_HAS(notes, "; what comes before it is used");
}

TEST_P(DamagedBag, WithMutationsIsReadOrRefused) {
  const int times = GetParam() == "bz2.bag" ? 60 : 200;
  int accepted = 0;
  RandomStream random(1, "bags");
  for (int i = 0; i < times; ++i)
    accepted += read_bytes(scratch_, testing::damaged(whole_, random)).has_value();
  EXPECT_GT(accepted, times / 20);
}

/// Lengths, offsets, counts and operations at the ends of the file, where one byte changes everything.
TEST_P(DamagedBag, WithOneByteChangedIsReadOrRefused) {
  const std::size_t step = GetParam() == "bz2.bag" ? 53 : 23;
  for (const std::size_t begin : {std::size_t{0}, std::size_t{4096}, whole_.size() - 1500})
    for (std::size_t at = begin; at < std::min(begin + 1500, whole_.size()); at += step)
      for (const char byte : {'\xFF', '\x7F', '\0'}) {
        std::string bytes = whole_;
        bytes[at] = byte;
        read_bytes(scratch_, bytes);
      }
}

std::string name_of_damaged(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  name[name.find('.')] = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Bags, DamagedBag,
                         ::testing::Values("plain.mcap", "zstd.mcap", "lz4.mcap", "plain.bag", "bz2.bag",
                                           "lz4.bag"),
                         name_of_damaged);

/// A chunk inside an intact index: only its messages are missing.
TEST(DamagedChunk, CostsItsMessagesAlone) {
  for (const std::string name : {"zstd.mcap", "lz4.bag"}) {
    const Scratch scratch;
    std::string bytes = contents(written_bag(name));
    for (std::size_t at = bytes.size() / 2; at < bytes.size() / 2 + 40; ++at) bytes[at] ^= 0x5A;
    const auto recording = read_bytes(scratch, bytes);
    ASSERT_TRUE(recording) << name;
    EXPECT_LT(recording->frames.size(), 12u) << name;
    EXPECT_GE(recording->frames.size(), 5u) << name;
    EXPECT_HAS(all_notes(*recording), "messages cannot be read and are not used, the first: ");
    EXPECT_HAS(all_notes(*recording), "x.bag: in the chunk at byte ");
    EXPECT_HAS(all_notes(*recording), "cannot be decompressed");
  }
}

/// A chunk of a few bytes that claims to have gigabytes.
TEST(DamagedChunk, ThatClaimsTooMuchIsRefused) {
  const Scratch scratch;
  std::string bytes = contents(written_bag("zstd.mcap"));
  const std::size_t word = bytes.find(std::string("\x04\0\0\0zstd", 8));
  ASSERT_NE(word, std::string::npos);
  bytes.replace(word - 12, 8, std::string(5, '\xFF') + std::string(3, '\0'));  // 1 TB
  const auto recording = read_bytes(scratch, bytes);
  ASSERT_TRUE(recording);
  EXPECT_HAS(all_notes(*recording), "are more than the 256 MiB allowed");
}

}  // namespace
}  // namespace incognita
