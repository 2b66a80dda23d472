// Usage errors: messages, streams and exit codes before any work is done.
#include <gtest/gtest.h>

#include <csignal>

#include "tests/app/program.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Circumstances;
using testing::Ended;
using testing::Scratch;
using testing::Stream;
using testing::Words;

Ended ended(const Words& arguments) {
  const Scratch scratch;
  Ended found = testing::incognita(arguments, scratch.folder());
  EXPECT_EQ(testing::everything_in(scratch.folder()).size(), 0u);
  return found;
}

void expect_usage_error(const Words& arguments, const std::string& what) {
  const Ended found = ended(arguments);
  EXPECT_EQ(found.code, 2) << found.err;
  EXPECT_SAYS(found.err, what);
  EXPECT_EQ(found.out, "");
}

TEST(ProgramUsage, EveryHelpHasAnExample) {
  for (const Words& command : {Words{}, Words{"run"}, Words{"evaluate"}, Words{"adjust"}, Words{"config"},
                               Words{"view"}, Words{"calibrate"}, Words{"target"}}) {
    Words arguments = command;
    arguments.push_back("--help");
    const Ended help = ended(arguments);
    EXPECT_EQ(help.code, 0);
    EXPECT_SAYS(help.out, command.empty() ? "incognita run room" : "incognita " + command.front());
    EXPECT_SAYS(help.out, "Example");
    EXPECT_EQ(help.err, "");
  }
}

TEST(ProgramUsage, PrintsItsVersion) {
  const Ended version = ended({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out, INCOGNITA_VERSION "\n");
}

TEST(ProgramUsage, ErrorsSuggestTheNearestName) {
  expect_usage_error({}, "a command is required: run, evaluate, adjust, calibrate");
  expect_usage_error({"evalaute"}, "there is no command `evalaute`; the nearest is `evaluate`");
  expect_usage_error({"--verson"}, "there is no option `--verson`; the nearest is `--version`");
  expect_usage_error({"run", "room", "--sed", "3"}, "there is no option `--sed`; the nearest is `--seed`");
  expect_usage_error({"run", "room", "--durations=3"}, "`--durations`; the nearest is `--duration`");
  expect_usage_error({"run", "room", "davison"}, "unexpected argument `davison`");
  expect_usage_error({"run", "room", "--set"}, "--set");
  expect_usage_error({"evaluate"}, "ESTIMATE is required");
  expect_usage_error({"run", "rom"}, "rom: no such scenario file, nor a built-in scenario");
  expect_usage_error({"run", "rom"}, "the nearest is room");
  expect_usage_error({"config", "davisn"}, "the nearest is davison");
  expect_usage_error({"run", "room", "--out", ""}, "--out: is empty");
}

TEST(ProgramUsage, FlagsAreCheckedLikeTheirSettings) {
  expect_usage_error({"run", "room", "--seed", "-1"}, "--seed: run.seed = -1: must be at least 0");
  expect_usage_error({"run", "room", "--seed", "1.5"}, "--seed: run.seed = 1.5: must be a whole number");
  // more than 64 bits: it must not be replaced by another seed
  expect_usage_error({"run", "room", "--seed", "99999999999999999999"},
                     "run.seed = 99999999999999999999: must");
  for (const char* value : {"0", "nan", "1e9", "soon", ""})
    expect_usage_error({"run", "room", "--duration", value},
                       std::string("run.duration_s = ") + value + ": must");
}

TEST(ProgramUsage, StandardOutputHasOnlyResults) {
  const Ended config = ended({"config", "room", "--json", "--set", "run.seed=7"});
  EXPECT_EQ(config.code, 0);
  EXPECT_TRUE(nlohmann::json::accept(config.out));
  EXPECT_SAYS(config.err, "run.seed = 7 (--set) replaces 1");
}

TEST(ProgramUsage, UnwritableResultsAreAFailure) {
  const Scratch scratch;
  for (const Words& words : {Words{"config", "room"}, Words{"config", "room", "--json"}, Words{"--help"}}) {
    for (const Stream where : {Stream::full_disk, Stream::closed}) {
      const Ended found = testing::incognita(words, Circumstances{scratch.folder(), where});
      EXPECT_EQ(found.code, 1);
      EXPECT_SAYS(found.err, "incognita: standard output: ");
    }
  }
}

TEST(ProgramUsage, AClosedPipeEndsItSilently) {
  const Scratch scratch;
  const Ended found =
      testing::incognita({"config", "room"}, Circumstances{scratch.folder(), Stream::no_reader});
  EXPECT_EQ(found.signal, SIGPIPE);  // as for any filter
  EXPECT_EQ(found.err, "");
}

TEST(ProgramUsage, UnwritableMessagesChangeNothing) {
  const Scratch scratch;
  for (const Stream where : {Stream::full_disk, Stream::closed, Stream::no_reader}) {
    const std::string out = "run" + std::to_string(static_cast<int>(where));
    const Words words = {"run", "room", "--duration", "0.1", "--no-figures", "--out", out};
    const Ended run = testing::incognita(words, Circumstances{scratch.folder(), Stream::kept, where});
    EXPECT_EQ(run.code, 0);
    const nlohmann::json summary = testing::summary_of(scratch.folder() / out);
    EXPECT_EQ(summary["status"], "done");
    EXPECT_EQ(summary["frames"], 3);
    testing::expect_whole_tables(scratch.folder() / out);
  }
  EXPECT_EQ(
      testing::incognita({"run", "rom"}, Circumstances{scratch.folder(), Stream::kept, Stream::full_disk})
          .code,
      2);
}

}  // namespace
}  // namespace incognita
