// The fuzz target of run.mcap without libFuzzer: on small mutations of a synthetic run.
#include <gtest/gtest.h>

#include <ctime>
#include <string>

#include "incognita/math/random.hpp"
#include "incognita/record/mcap/snapshot_log.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/io/damage.hpp"
#include "tests/record/synthetic_run.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

/// CPU time of this process, independent of other load.
double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Three chunks, two of them with images.
std::string synthetic_run() {
  const testing::Scratch scratch;
  SnapshotLog log(scratch / "run.mcap", RunInfo{});
  for (int i = 0; i < 24; ++i) {
    Snapshot snapshot = testing::synthetic_snapshot({}, 10 * i);
    if (i < 12) snapshot.image = std::make_shared<Image>(24, 16, static_cast<std::uint8_t>(5 * i));
    log.publish(snapshot);
  }
  log.close({});
  return testing::contents(scratch / "run.mcap");
}

void feed(const std::string& bytes) {
  const double begin = seconds();
  EXPECT_EQ(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), 0);
  EXPECT_LT(seconds() - begin, 1.0 * INCOGNITA_SLOWNESS) << bytes.size() << " bytes";
}

/// Mutations at random places mostly hit snapshots: these hit what surrounds them, too.
TEST(RunReplay, MutatedLengthsAndOffsetsAreReadOrRefused) {
  const std::string whole = synthetic_run();
  feed(whole);
  RandomStream random(5, "replay");
  for (const std::string& part :
       {std::string("\x06", 1), std::string("\x08", 1), std::string("\x07", 1), std::string("\x05", 1),
        std::string("/snapshot"), std::string("\x02\x14", 2)})
    for (std::size_t at = whole.find(part), n = 0; at != std::string::npos && n < 15;
         at = whole.find(part, at + 1), ++n)
      for (int i = 0; i < 4; ++i) {
        std::string bytes = whole;
        const std::size_t byte = std::min(at + static_cast<std::size_t>(random.below(24)), bytes.size() - 1);
        bytes[byte] = static_cast<char>(i == 0 ? 0xFF : random.below(256));
        feed(bytes);
      }
}

TEST(RunReplay, MutatedRunsAreReadOrRefused) {
  constexpr int times = 250;
  const std::string whole = synthetic_run();
  RandomStream random(4, "replay");
  for (int i = 0; i < times; ++i) feed(testing::damaged(whole, random));
  for (int i = 0; i < times; ++i) {  // without an index
    std::string cut = whole.substr(0, static_cast<std::size_t>(random.below(static_cast<int>(whole.size()))));
    feed(cut);
    feed(testing::damaged(cut, random));
  }
}

/// Files of many small records: a file of a megabyte is read in about the same time, whatever is in it.
TEST(RunReplay, LargestFilesAreReadOrRefusedInTime) {
  const std::string head = synthetic_run().substr(0, 8);
  const auto filled = [&](const std::string& part) {
    std::string bytes = head;
    while (bytes.size() < (1 << 20)) bytes += part;
    return bytes;
  };
  feed(filled(std::string("\x80\0\0\0\0\0\0\0\0", 9)));                  // records of no content
  feed(filled(std::string("\x04\x04\0\0\0\0\0\0\0\0\0\0\0", 13)));       // channels that are too short
  feed(filled(std::string("\x06\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF", 9)));  // a chunk of 2^64 bytes
  feed(filled("\xFF"));
  feed(filled(std::string(1, '\0')));
  feed(head);
  feed("");
}

}  // namespace
}  // namespace incognita
