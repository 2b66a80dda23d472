// The command `incognita reproduce` for a user.
#include <gtest/gtest.h>

#include "tests/app/program.hpp"
#include "tests/record/schema.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Ended;
using testing::Json;
using testing::Scratch;
using testing::Words;

Ended reproduce(const Scratch& scratch, const Words& more) {
  Words words = {"reproduce"};
  words.insert(words.end(), more.begin(), more.end());
  return testing::incognita(words, scratch.folder());
}

Json listed(const Scratch& scratch) {
  const Ended list = reproduce(scratch, {"--list", "--json"});
  EXPECT_EQ(list.code, 0) << list.err;
  return Json::parse(list.out);
}

TEST(ProgramReproduce, HelpHasAnExample) {
  const Scratch scratch;
  const Ended help = reproduce(scratch, {"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_SAYS(help.out, "Example: incognita reproduce");
  EXPECT_SAYS(help.out, "--seeds");
}

TEST(ProgramReproduce, ListLeavesNothingBehind) {
  const Scratch scratch;
  const Json all = listed(scratch);
  const Ended text = reproduce(scratch, {"--list"});
  EXPECT_EQ(text.code, 0);
  for (const Json& experiment : all) EXPECT_SAYS(text.out, experiment["id"].get<std::string>());
  EXPECT_EQ(testing::everything_in(scratch.folder()).size(), 0u);
}

TEST(ProgramReproduce, RefusesInvalidArgumentsBeforeAnyWork) {
  const Scratch scratch;
  const std::pair<Words, std::string> wrong[] = {
      {{"chapter-9"}, "there is no example or figure `chapter-9`"},
      {{"--seeds", "0"}, "--seeds: 0: must be a whole number from 1 to 100000"},
      {{"--seeds", "100001"}, "must be a whole number from 1 to 100000"},
      {{"--seeds", "-5"}, "must be a whole number from 1 to 100000"},
      {{"--seeds", "1.5"}, "1.5: must be a whole number"},
      {{"--seeds", "many"}, "many: must be a whole number"},
      {{"--seeds", "99999999999999999999"}, "must be a whole number"},
      {{"--seed", "3"}, "there is no option `--seed`; the nearest is `--seeds`"},
      {{"--out", ""}, "--out: is empty"}};
  for (const auto& [words, message] : wrong) {
    const Ended ended = reproduce(scratch, words);
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_SAYS(ended.err, message);
    EXPECT_EQ(ended.out, "");
  }
  EXPECT_EQ(testing::everything_in(scratch.folder()).size(), 0u);
}

TEST(ProgramReproduce, SuggestsTheNearestId) {
  const Scratch scratch;
  const Json all = listed(scratch);
  ASSERT_FALSE(all.empty());
  const std::string id = all[0]["id"];
  EXPECT_SAYS(reproduce(scratch, {id + "x"}).err, "the nearest is `" + id + "`");
}

TEST(ProgramReproduce, AnswerConformsToItsSchema) {
  const Scratch scratch;
  const Json all = listed(scratch);
  ASSERT_FALSE(all.empty());
  const std::string id = all[0]["id"];
  const Ended ended = reproduce(scratch, {id, "--seeds", "2", "--json", "--out", "ledger"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const Json json = Json::parse(ended.out, nullptr, false);
  ASSERT_TRUE(json.is_array()) << ended.out;
  EXPECT_EQ(testing::problems(json, Json::parse(testing::contents(std::string(INCOGNITA_SOURCE_DIR) +
                                                                  "/docs/schemas/reproduce.schema.json"))),
            "");
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0]["id"], id);
  EXPECT_EQ(testing::contents(scratch / "ledger/claims.json"), ended.out);
  for (const Json& figure : json[0]["figures"]) {
    EXPECT_NE(testing::contents(scratch / ("ledger/" + figure["data"].get<std::string>())), "");
    EXPECT_SAYS(testing::contents(scratch / ("ledger/" + figure["file"].get<std::string>())), "</svg>");
  }
}

}  // namespace
}  // namespace incognita
