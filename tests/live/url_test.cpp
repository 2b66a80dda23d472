// Addresses of requests taken apart.
#include "incognita/live/url.hpp"

#include <gtest/gtest.h>

namespace incognita {
namespace {

using Query = std::vector<std::pair<std::string, std::string>>;

TEST(RequestTarget, IsTakenApart) {
  const auto target = parse_target("/api/config?scenario=room&set=run.seed%3D7&set=a+b&empty=&alone");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, "/api/config");
  EXPECT_EQ(
      target->query,
      (Query{{"scenario", "room"}, {"set", "run.seed=7"}, {"set", "a b"}, {"empty", ""}, {"alone", ""}}));
}

TEST(RequestTarget, KeepsAPlusInThePath) { EXPECT_EQ(parse_target("/a+b%20c")->path, "/a+b c"); }

TEST(RequestTarget, RefusesWhatIsNotOne) {
  for (const char* target : {"", "http://x/", "*", "/%", "/%2", "/%zz", "/a%00b", "/?x=%", "/?%q=1"})
    EXPECT_FALSE(parse_target(target)) << target;
}

TEST(RequestTarget, DecodesAnEscapeAtTheEnd) { EXPECT_EQ(parse_target("/a%2f")->path, "/a/"); }

}  // namespace
}  // namespace incognita
