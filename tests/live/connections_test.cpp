// Which connections give way to others.
#include "incognita/live/connections.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "tests/scratch.hpp"

namespace incognita {
namespace {

/// Connections that note what is closed, and what is logged.
struct Opened {
  Opened(std::size_t most, std::size_t most_strangers) : connections(most, most_strangers) {}

  /// The number of the connection; none if it is refused.
  std::optional<std::size_t> open(const std::string& from) {
    if (!connections.make_room(from, [this](const std::string& line) { log += line + "\n"; }))
      return std::nullopt;
    const std::size_t number = places.size();
    places.push_back(std::make_unique<Connections::Place>(connections, from,
                                                          [this, number] { closed.push_back(number); }));
    return number;
  }

  Connections connections;
  std::vector<std::unique_ptr<Connections::Place>> places;
  std::vector<std::size_t> closed;
  std::string log;
};

TEST(Connections, WithoutAccessGiveWayToTheNextOfTheirAddress) {
  Opened opened(10, 2);
  for (const char* from : {"a", "b", "a", "a", "b", "a"}) EXPECT_TRUE(opened.open(from));
  EXPECT_EQ(opened.closed, (std::vector<std::size_t>{0, 2}));
  EXPECT_HAS(opened.log,
             "a connection of a was closed for its next: it has 2 without access, the most that may be");
}

TEST(Connections, GiveWayInTheOrderOfTheirLastUse) {
  Opened opened(3, 3);
  for (const char* from : {"a", "b", "c"}) opened.open(from);
  opened.places[0]->renew();
  opened.open("d");
  opened.open("e");
  opened.open("f");
  EXPECT_EQ(opened.closed, (std::vector<std::size_t>{1, 2, 0}));
  EXPECT_HAS(
      opened.log,
      "a connection of b was closed for another: it has no access, and there are 3, the most that may be");
}

TEST(Connections, WithAccessNeverGiveWay) {
  Opened opened(3, 2);
  for (int i = 0; i < 3; ++i) {
    opened.open("a");
    opened.places.back()->trust();
  }
  opened.places[1]->renew();
  EXPECT_FALSE(opened.open("a"));
  EXPECT_HAS(opened.log, "a connection of a was refused: there are 3, the most that may be");
  EXPECT_TRUE(opened.closed.empty());
  opened.places.erase(opened.places.begin());
  EXPECT_TRUE(opened.open("a"));
}

TEST(Connections, ThatWereClosedCountNoMoreAndGainNothing) {
  Opened opened(2, 2);
  opened.open("a");
  opened.open("b");
  opened.open("c");
  opened.places[0]->trust();
  opened.places[0]->renew();
  opened.places[0].reset();
  opened.open("d");
  EXPECT_EQ(opened.closed, (std::vector<std::size_t>{0, 1})) << "two of four are open";
}

TEST(Connections, TakeTheirPlaceAlong) {
  Opened opened(1, 1);
  opened.open("a");
  opened.places[0]->trust();
  {
    const Connections::Place moved(std::move(*opened.places[0]));
    opened.places[0].reset();
    EXPECT_FALSE(opened.open("b"));
  }
  EXPECT_TRUE(opened.open("b"));
}

}  // namespace
}  // namespace incognita
