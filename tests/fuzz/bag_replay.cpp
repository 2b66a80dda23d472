// The fuzz target of bags without libFuzzer: on the written bags, and on small mutations of them.
#include <gtest/gtest.h>

#include <ctime>
#include <string>

#include "incognita/math/random.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/io/bags/bag_scene.hpp"
#include "tests/io/damage.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

/// CPU time of this process, independent of other load.
double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void feed(const std::string& bytes) {
  const double begin = seconds();
  EXPECT_EQ(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), 0);
  EXPECT_LT(seconds() - begin, 1.0 * INCOGNITA_SLOWNESS) << bytes.size() << " bytes";
}

TEST(BagReplay, WrittenBagsAndTheirMutationsAreReadOrRefused) {
  RandomStream random(7, "replay");
  for (const std::string& name : testing::names_of_bags()) {
    const std::string whole = testing::contents(testing::written_bag(name));
    ASSERT_FALSE(whole.empty()) << name;
    feed(whole);
    for (int i = 0; i < 30; ++i) feed(testing::damaged(whole, random));
    for (int i = 0; i < 15; ++i) {  // without an index
      const std::string cut =
          whole.substr(0, static_cast<std::size_t>(random.below(static_cast<int>(whole.size()))));
      feed(testing::damaged(cut, random));
    }
  }
}

/// Records of no content, as many as fit: a file of a megabyte is read in about the same time, whatever is in it.
TEST(BagReplay, ManyEmptyRecordsAreReadInTime) {
  std::string mcap("\x89MCAP0\r\n", 8), bag = "#ROSBAG V2.0\n";
  const std::string record("\x01\0\0\0\0\0\0\0\0", 9), header("\x08\0\0\0\x04\0\0\0op=\x04\0\0\0\0", 16);
  while (mcap.size() < 1'000'000) mcap += record;
  while (bag.size() < 1'000'000) bag += header;
  feed(mcap);
  feed(bag);
}

}  // namespace
}  // namespace incognita
