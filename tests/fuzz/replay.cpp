// The fuzz target without libFuzzer: on the built-in systems, on the corpus, and on small mutations of both.
#include <gtest/gtest.h>

#include <ctime>
#include <filesystem>
#include <map>
#include <string>

#include "incognita/math/random.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/io/damage.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

/// CPU time of this process, independent of other load.
double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// name -> bytes, of both folders
std::map<std::string, std::string> seeds() {
  std::map<std::string, std::string> files;
  for (const char* folder : {"/systems", "/tests/fuzz/corpus"}) {
    for (const auto& entry : std::filesystem::directory_iterator(std::string(INCOGNITA_SOURCE_DIR) + folder))
      files[entry.path().filename().string()] = testing::contents(entry.path());
  }
  return files;
}

void feed(const std::string& bytes, const std::string& whose) {
  const double begin = seconds();
  EXPECT_EQ(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), 0);
  EXPECT_LT(seconds() - begin, 1.0 * INCOGNITA_SLOWNESS) << whose << ":\n" << bytes.substr(0, 4000);
}

TEST(SystemReplay, SeedsAreReadOrRefusedInTime) {
  const std::map<std::string, std::string> files = seeds();
  EXPECT_GE(files.size(), 20u);
  for (const auto& [name, bytes] : files) feed(bytes, name);
}

/// Larger than a person would write, but possible for a program.
TEST(SystemReplay, LargestFilesAreReadOrRefusedInTime) {
  const auto filled = [](const std::string& head, const std::string& part, const std::string& tail) {
    std::string text = head;
    while (text.size() + part.size() + tail.size() < (1 << 20)) text += part;
    return text + tail;
  };
  feed(filled("x = \"", "(", "\""), "parentheses");
  feed(filled("[states]\nx = \"", "-", "1\""), "signs");
  feed(filled("", "a.", "a = 1"), "a key of many parts");
  feed(filled("[", "a.", "a]"), "a section of many parts");
  feed(filled("x = ", "[", ""), "lists");
  feed(filled("x = ", "{a=", ""), "tables");
  std::string part = "{ ";
  for (int i = 0; i < 99; ++i) part += "a.";
  feed(filled("x = ", part + "a = ", "1"), "tables by keys of many parts");
  feed(filled("x = [", "1,", "1]"), "a long list");
  feed(filled("", "[[a]]\n", ""), "many tables");
  feed(filled("\"", "x", "\" = 1"), "a long key");
  feed(filled("x = \"\"\"", "\xce\xb8", "\"\"\""), "a long text");
  feed(filled("", "#\n", ""), "comments");
  std::string keys = "[definitions]\n";
  for (int i = 0; keys.size() < 1'000'000; ++i) keys += "k" + std::to_string(i) + " = 1\n";
  feed(keys, "many definitions");
}

TEST(SystemReplay, MutatedSeedsAreReadOrRefusedInTime) {
  constexpr int times = 4000;
  constexpr double longest_s = 30.0 * INCOGNITA_SLOWNESS;
  const std::map<std::string, std::string> files = seeds();
  ASSERT_FALSE(files.empty());
  RandomStream random(3, "replay");
  const double begin = seconds();
  auto seed = files.begin();
  for (int i = 0; i < times && seconds() - begin < longest_s; ++i) {
    feed(testing::damaged(seed->second, random), "damaged " + seed->first);
    if (++seed == files.end()) seed = files.begin();
  }
  EXPECT_LT(seconds() - begin, longest_s);
}

}  // namespace
}  // namespace incognita
