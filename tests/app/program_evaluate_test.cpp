// The command `incognita evaluate` with valid and invalid input.
#include <gtest/gtest.h>

#include "tests/app/program.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Ended;
using testing::Scratch;
using testing::Words;

const char* path_text = "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 1 1 0 0 0 0 1\n3 1 1 1 0 0 0 1\n";

Ended evaluate(const Scratch& scratch, const Words& more) {
  Words words = {"evaluate"};
  words.insert(words.end(), more.begin(), more.end());
  return testing::incognita(words, scratch.folder());
}

TEST(ProgramEvaluate, RefusesInvalidTrajectories) {
  const Scratch scratch;
  scratch.write("truth", path_text);
  std::string binary;
  for (int i = 0; i < 5000; ++i) binary += static_cast<char>(i * i * 31 + i * 17);
  const std::pair<std::string, std::string> wrong[] = {
      {binary, "given:1: "},
      {"", "given: no pose in it"},
      {"# only a comment\n", "given: no pose in it"},
      {std::string(200'000, 'x'), "given:1: a line of more than 65536 bytes"},
      {std::string(path_text) + "4 nan 0 0 0 0 0 1\n", "given:5: `nan` is not a finite number"},
      {std::string(path_text) + "4 0 0 0 0 0 0 9\n", "given:5: the quaternion has length 9"},
      {std::string(path_text) + "4 0 0\n", "given:5: 3 columns, 8 are needed"}};
  for (const auto& [content, message] : wrong) {
    scratch.write("given", content);
    const Ended as_estimate = evaluate(scratch, {"given", "--truth", "truth"});
    EXPECT_EQ(as_estimate.code, 2);
    EXPECT_SAYS(as_estimate.err, message);
    EXPECT_EQ(as_estimate.out, "");
  }
  EXPECT_EQ(evaluate(scratch, {"truth", "--truth", "given", "--json"}).code, 2);
  for (const char* none : {"nothing-here", "/dev/zero", "."}) {
    const Ended ended = evaluate(scratch, {"truth", "--truth", none});
    EXPECT_EQ(ended.code, 2) << none;
    EXPECT_SAYS(ended.err, none);
  }
}

TEST(ProgramEvaluate, RefusesAFolderThatIsNotARun) {
  const Scratch scratch;
  scratch.write("truth", path_text);
  scratch.write("folder/readme", "");
  const Ended ended = evaluate(scratch, {"folder", "--truth", "truth"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_SAYS(ended.err, "folder: is a folder without estimate.tum");
}

TEST(ProgramEvaluate, FailsWithTooFewMatches) {
  const Scratch scratch;
  scratch.write("truth", path_text);
  scratch.write("one", "0 0 0 0 0 0 0 1\n");
  scratch.write("later", "12 0 0 0 0 0 0 1\n10 0 0 0 0 0 0 1\n11 1 0 0 0 0 0 1\n");
  const Ended one = evaluate(scratch, {"one", "--truth", "truth", "--json"});
  EXPECT_EQ(one.code, 1);
  EXPECT_SAYS(one.err, "1 of 1 estimated poses have a true one within 0.01 s, at least 3 are needed");
  EXPECT_EQ(one.out, "");
  const Ended later = evaluate(scratch, {"later", "--truth", "truth"});
  EXPECT_EQ(later.code, 1);
  EXPECT_SAYS(later.err, "0 of 3 estimated poses");
  EXPECT_SAYS(later.err, "spans 10 to 12 s, the truth 0 to 3 s; see --max-dt");
}

TEST(ProgramEvaluate, AcceptsDuplicateStamps) {
  const Scratch scratch;
  scratch.write("once", path_text);
  scratch.write("twice", std::string("0 0 0 0 0 0 0 1\n") + path_text);
  for (const Words& words : {Words{"once", "--truth", "twice"}, Words{"twice", "--truth", "once"}}) {
    const Ended ended = evaluate(scratch, words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_SAYS(ended.out, "matched 4 of ");
  }
}

TEST(ProgramEvaluate, AnswersAreFinite) {
  const Scratch scratch;
  scratch.write("huge", "0 1e308 1e308 1e308 0 0 0 1\n1 0 0 -1e308 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  for (const char* alignment : {"none", "se3", "sim3", "yaw"}) {
    const Ended ended = evaluate(scratch, {"huge", "--truth", "huge", "--align", alignment});
    EXPECT_EQ(ended.out.find("nan"), std::string::npos) << ended.out;
    EXPECT_EQ(ended.out.find("inf"), std::string::npos) << ended.out;
    EXPECT_TRUE(ended.code == 0 || (ended.code == 1 && !ended.err.empty()));
  }
  EXPECT_SAYS(evaluate(scratch, {"huge", "--truth", "huge"}).err, "too large to be compared");
  EXPECT_SAYS(evaluate(scratch, {"hgue"}).err, "hgue: there is no such file or folder");
}

TEST(ProgramEvaluate, RefusesInvalidIntervals) {
  const Scratch scratch;
  scratch.write("truth", path_text);
  const std::pair<Words, std::string> wrong[] = {
      {{"--max-dt", "nan"}, "nan: must be 0 or more"},
      {{"--max-dt", "-1"}, "-1: must be 0 or more"},
      {{"--rpe-delta-s", "nan"}, "nan: must be more than 0"},
      {{"--rpe-delta-s", "0"}, "0: must be more than 0"},
      {{"--max-dt", "soon"}, "soon: must be 0 or more"},
      {{"--align", "se4"}, "must be auto, none, se3, sim3 or yaw"}};
  for (const auto& [option, message] : wrong) {
    Words words = {"truth", "--truth", "truth"};
    words.insert(words.end(), option.begin(), option.end());
    const Ended ended = evaluate(scratch, words);
    EXPECT_EQ(ended.code, 2);
    EXPECT_SAYS(ended.err, message);
  }
}

TEST(ProgramEvaluate, StatesWhyThereIsNoNees) {
  const Scratch scratch;
  scratch.write("truth", path_text);
  scratch.write("covariance.csv", "t\n");
  const Ended ended =
      evaluate(scratch, {"truth", "--truth", "truth", "--align", "none", "--covariance", "covariance.csv"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_SAYS(ended.err, "no NEES: covariance.csv has no usable covariance");
}

}  // namespace
}  // namespace incognita
