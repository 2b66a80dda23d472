// Who may use the server: host, origin, token.
#include "incognita/live/access.hpp"

#include <gtest/gtest.h>

#include <set>

#include "incognita/live/refusal_log.hpp"

namespace incognita {
namespace {

using ::testing::Test;

std::string refusal(std::string_view host, std::string_view origin, std::string_view token = "",
                    const AccessRules& rules = {}) {
  return refusal_of({host, origin, token, {}}, rules);
}

TEST(Access, ThisMachineNeedsNoToken) {
  for (const char* host : {"localhost:8321", "127.0.0.1:8321", "[::1]:8321", "localhost", "127.3.4.5:1"})
    EXPECT_EQ(refusal(host, ""), "") << host;
  EXPECT_EQ(refusal("localhost:8321", "http://localhost:8321"), "");
}

TEST(Access, RefusesOtherHostsWithoutAToken) {
  for (const char* host :
       {"evil.example:8321", "localhost.evil.example", "127.0.0.1.evil.example", "", "[::1"})
    EXPECT_NE(refusal(host, ""), "") << host;
}

TEST(Access, RefusesPagesOfOtherOrigins) {
  EXPECT_NE(refusal("localhost:8321", "http://evil.example"), "");
  EXPECT_NE(refusal("localhost:8321", "http://localhost:9000"), "");
  EXPECT_NE(refusal("localhost:8321", "https://localhost:8321"), "");
  EXPECT_NE(refusal("localhost:8321", "null"), "");
  for (const bool encrypted : {false, true})
    EXPECT_EQ(refusal_of({"localhost:8321", "https://localhost:8321", "", "", encrypted}, {}).empty(),
              encrypted);
  EXPECT_EQ(refusal("localhost:8321", "https://app.foxglove.dev", "", {"", {"https://app.foxglove.dev"}}),
            "");
}

TEST(Access, RefusesWhatAnotherSiteEmbeds) {
  EXPECT_NE(refusal_of({"localhost:8321", "", "", "cross-site"}, {}), "");
  EXPECT_NE(refusal_of({"localhost:8321", "", "", "same-site"}, {}), "");
  EXPECT_EQ(refusal_of({"localhost:8321", "", "", "same-origin"}, {}), "");
  EXPECT_EQ(refusal_of({"localhost:8321", "", "", "none"}, {}), "");
  EXPECT_EQ(refusal_of({"localhost:8321", "https://app.foxglove.dev", "", "cross-site"},
                       {"", {"https://app.foxglove.dev"}}),
            "");
}

TEST(Access, ATokenMustBeRight) {
  const AccessRules rules{"0123456789abcdef", {}};
  EXPECT_EQ(refusal("robot.local:8321", "", "0123456789abcdef", rules), "");
  EXPECT_NE(refusal("robot.local:8321", "", "0123456789abcdee", rules), "");
  EXPECT_NE(refusal("robot.local:8321", "", "0123456789abcdef0", rules), "");
  EXPECT_NE(refusal("robot.local:8321", "", "", rules), "");
  EXPECT_NE(refusal("localhost:8321", "", "", rules), "");
}

TEST(Access, TokensDiffer) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(random_token());
  EXPECT_EQ(tokens.size(), 100u);
  EXPECT_EQ(tokens.begin()->size(), 32u);
}

TEST(Access, KnowsLoopbackAddresses) {
  for (const char* address : {"127.0.0.1", "127.1.2.3", "::1", "localhost"})
    EXPECT_TRUE(is_loopback(address));
  for (const char* address : {"0.0.0.0", "::", "192.168.1.2", "127.evil.example", ""})
    EXPECT_FALSE(is_loopback(address)) << address;
}

TEST(RefusalLog, PrintsAFloodOnce) {
  std::vector<std::string> lines;
  RefusalLog log([&](const std::string& line) { lines.push_back(line); });
  const auto start = RefusalLog::Clock::now();
  for (int i = 0; i < 1000; ++i) log.add("refused", start + std::chrono::microseconds(i));
  EXPECT_EQ(lines, std::vector<std::string>{"refused"});
  log.add("refused", start + std::chrono::seconds(2));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[1], "refused (1000 times)");
}

TEST(RefusalLog, PrintsAFewLinesPerSecondWhateverTheySay) {
  std::vector<std::string> lines;
  RefusalLog log([&](const std::string& line) { lines.push_back(line); });
  const auto start = RefusalLog::Clock::now();
  for (int i = 0; i < 1000; ++i)
    log.add("host " + std::to_string(i) + " \x1b[31m\x9b", start + std::chrono::microseconds(i));
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "host 0 ?[31m?");
  log.add("another", start + std::chrono::seconds(2));
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_EQ(lines[5], "995 further refusals of other kinds");
}

}  // namespace
}  // namespace incognita
