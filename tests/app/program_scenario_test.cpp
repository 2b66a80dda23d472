// Scenarios, settings and targets that cannot be: refused before anything begins, and nothing is left behind.
#include <gtest/gtest.h>

#include "tests/app/program.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Ended;
using testing::pgm;
using testing::Scratch;
using testing::Words;

void expect_refused(const Scratch& scratch, Words words, const Words& messages) {
  const std::set<std::string> before = testing::everything_in(scratch.folder());
  words.insert(words.begin(), "run");
  const Ended ended = testing::incognita(words, scratch.folder());
  EXPECT_EQ(ended.code, 2) << ended.err;
  for (const std::string& message : messages) EXPECT_SAYS(ended.err, message);
  EXPECT_EQ(ended.out, "");
  EXPECT_EQ(testing::everything_in(scratch.folder()), before);
}

TEST(ProgramScenario, RefusesWhatIsInTheFile) {
  const Scratch scratch;
  std::string binary = "\x01\xff\xfe";
  for (int i = 0; i < 3000; ++i) binary += static_cast<char>(i * i * 7 + i * 13);
  const std::pair<std::string, Words> wrong[] = {
      {"[run]\n\nsede = 7\n", {"s.toml:3: there is no setting `run.sede`; the nearest is `run.seed`"}},
      {"[rum]\nseed = 7\n", {"s.toml:1: there is no section `rum`; the nearest is `run`"}},
      {"[run]\nduration_s = nan\n", {"s.toml:2: run.duration_s = nan: must be finite"}},
      {"[run]\nduration_s = -inf\n", {"s.toml:2: run.duration_s = -inf: must be finite"}},
      {"[run]\nrate_hz = \"30\"\n", {"s.toml:2: run.rate_hz = \"30\": must be a number", "and is a text"}},
      {"[world]\ntype = \"rom\"\n",
       {"s.toml:2: world.type = \"rom\": must be `room`, `points`, `recording`, `live` or `robot`",
        "nearest is `room`"}},
      {"[room]\nsize_m = [6, 6]\n", {"s.toml:2: room.size_m = [6, 6]: must be a list of three numbers"}},
      {"[run]\nseed = 1\nseed = 2\n", {"s.toml:3: not valid TOML: "}},
      {"[run\n", {"s.toml:1: not valid TOML: "}},
      {binary, {"s.toml:1: not valid TOML: "}},
      {std::string(1'200'000, '#'), {"s.toml: is larger than the 1048576 bytes allowed"}},
      {"[run]\nseed = true\n[search]\npatch_size_px = 10\n[map]\nmax_landmark = 3\n",
       {"s.toml:2: run.seed = true", "s.toml:4: search.patch_size_px = 10: must be odd, 9 to 15",
        "s.toml:6: there is no setting `map.max_landmark`; the nearest is `map.max_landmarks`"}},
  };
  for (const auto& [content, messages] : wrong) {
    scratch.write("s.toml", content);
    expect_refused(scratch, {"s.toml"}, messages);
  }
}

TEST(ProgramScenario, RefusesWhatIsNoFile) {
  const Scratch scratch;
  scratch.write("folder/file", "");
  expect_refused(scratch, {"folder"}, {"folder: is a folder, not a file"});
  expect_refused(scratch, {"folder/file/more.toml"}, {"folder/file/more.toml: no such scenario file"});
  expect_refused(scratch, {"/dev/zero"}, {"/dev/zero: is no regular file; a pipe or device is not read"});
  scratch.write("empty.toml", "");
  expect_refused(scratch, {"empty.toml"}, {"default: start.target = \"\": must name a target file"});
}

TEST(ProgramScenario, RefusesTheSameFromTheCommandLine) {
  const Scratch scratch;
  const std::pair<std::string, std::string> wrong[] = {
      {"run.sede=7", "--set: there is no setting `run.sede`; the nearest is `run.seed`"},
      {"run.seed", "--set: `run.seed` must be written section.name=value"},
      {"run.seed=", "--set: run.seed = : must be a whole number"},
      {"run.duration_s=nan", "--set: run.duration_s = nan: must be finite"},
      {"run.duration_s=inf", "--set: run.duration_s = inf: must be finite"},
      {"run.rate_hz=fast", "--set: run.rate_hz = fast: must be a number"},
      {"room.size_m=[6, 6]", "--set: room.size_m = [6, 6]: must be a list of three numbers"},
      {"world.type=rom", "the nearest is `room`"},
      {"run.seed=1]\n[run", "--set: run.seed = 1]"},
      {"run.seed=99999999999999999999", "run.seed = 99999999999999999999: must"},
  };
  for (const auto& [set, message] : wrong) expect_refused(scratch, {"room", "--set", set}, {message});
}

TEST(ProgramScenario, RefusesCamerasThatCannotBe) {
  const Scratch scratch;
  const std::pair<Words, std::string> wrong[] = {
      {{"camera.fu_px=-195"}, "--set: camera.fu_px = -195: must be more than 0"},
      {{"camera.fv_px=0"}, "--set: camera.fv_px = 0: must be more than 0"},
      {{"camera.u0_px=400"},
       "--set: camera.u0_px = 400.0: must lie inside the image, 0 to 320 (camera.width_px)"},
      {{"camera.v0_px=-3"},
       "--set: camera.v0_px = -3.0: must lie inside the image, 0 to 240 (camera.height_px)"},
      {{"camera.width_px=0"}, "--set: camera.width_px = 0: must be 16 to 16384"},
      {{"camera.kd1_per_px2=9"}, "is its unit right?"},
      {{"camera.k1=-0.3"}, "--set: `camera.k1` belongs to `camera.model = \"pinhole\" or \"fisheye\"`"},
      {{"camera.model=pinhole", "camera.kd1_per_px2=1e-6"},
       "--set: `camera.kd1_per_px2` belongs to `camera.model = \"wide-angle\"`"},
  };
  for (const auto& [sets, message] : wrong) {
    Words words = {"room"};
    for (const std::string& set : sets) words.insert(words.end(), {"--set", set});
    expect_refused(scratch, words, {message});
  }
}

TEST(ProgramScenario, RefusesRoomsThatCannotBe) {
  const Scratch scratch;
  for (const char* set :
       {"room.boxes=1000", "room.boxes=-1", "room.size_m=[100, 100, 100]", "room.size_m=[1.9, 6, 2.5]",
        "room.sigma_image_gray=255", "room.clearance_m=1", "room.start_position_m=[9, 0, 1]"})
    expect_refused(scratch, {"room", "--set", set}, {std::string("--set: ") + std::string(set).substr(0, 9)});
  expect_refused(scratch, {"room", "--set", "run.rate_hz=10000", "--set", "run.duration_s=1e7"},
                 {"at most 1e+09 frames"});
}

TEST(ProgramScenario, RefusesATargetThatIsNotWhereTheRoomHasIt) {
  const Scratch scratch;
  const Ended ended =
      testing::incognita({"run", "room", "--set", "room.size_m=[10, 6, 2.5]"}, scratch.folder());
  EXPECT_EQ(ended.code, 2);
  EXPECT_SAYS(ended.err, "start.target = targets/sheet.toml: has a corner at [3, 0.21, 1.4485]");
  EXPECT_SAYS(ended.err, "hangs at x = 5 (room.size_m, --set)");
  const Ended check = testing::incognita({"config", "--check", "room", "--set", "room.size_m=[10, 6, 2.5]"},
                                         scratch.folder());
  EXPECT_EQ(check.code, 2);
  EXPECT_EQ(check.err, ended.err);
  EXPECT_EQ(testing::everything_in(scratch.folder()).size(), 0u);
}

TEST(ProgramScenario, ChecksSayWhatRunsSay) {
  const Scratch scratch;
  scratch.write("bad.toml", "[run]\nsede = 7\n");
  scratch.write("no-target.toml", "[start]\nfrom = \"target\"\ntarget = \"t.toml\"\n");
  for (const char* file : {"bad.toml", "no-target.toml", "nothing.toml"}) {
    const Ended run = testing::incognita({"run", file}, scratch.folder());
    const Ended check = testing::incognita({"config", "--check", file}, scratch.folder());
    EXPECT_EQ(run.code, 2);
    EXPECT_EQ(check.code, 2);
    EXPECT_EQ(run.err, check.err);
  }
}

std::string corner(const std::string& position, const std::string& patch = "p.pgm") {
  return "[[corner]]\nposition_m = " + position + "\npatch = \"" + patch + "\"\n";
}

TEST(ProgramScenario, RefusesTargetsThatCannotBe) {
  const Scratch scratch;
  scratch.write("s.toml", "[start]\nfrom = \"target\"\ntarget = \"t.toml\"\n");
  scratch.write("p.pgm", pgm(11, 11));
  scratch.write("cut.pgm", pgm(11, 11).substr(0, 60));
  const std::string head = "name = \"sheet\"\nnormal = [-1, 0, 0]\n";
  const std::string three = corner("[3, 0.2, 1]") + corner("[3, -0.2, 1]") + corner("[3, 0.2, 1.5]");
  const std::pair<std::string, Words> wrong[] = {
      {"name = \n", {"t.toml:1: not valid TOML"}},
      {"nmae = \"sheet\"\n",
       {"t.toml:1: nmae: there is no such key in a target file; the nearest is `name`"}},
      {head + three, {"corner: must be 4 to 100 tables", "and is 3"}},
      {head + three + corner("[3, nan, 1.5]"), {"t.toml:13: position_m"}},
      {head + three + corner("[3, 0.2, 1.5]"), {"corners 2 and 3 are at the same place"}},
      {head + corner("[3, 0.1, 1]") + corner("[3, 0.2, 1]") + corner("[3, 0.3, 1]") + corner("[3, 0.4, 1]"),
       {"the corners are on one line"}},
      {head + three + corner("[4, -0.2, 1.5]"), {"the corners are not in one plane"}},
      {head + three + corner("[3, -0.2, 1.5]", "nowhere.pgm"),
       {"t.toml:14: patch", "nowhere.pgm is not there"}},
      {head + three + corner("[3, -0.2, 1.5]", "cut.pgm"), {"t.toml:14: patch", "cut.pgm", "truncated"}},
      {head + three + corner("[3, -0.2, 1.5]", "."), {"t.toml:14: patch"}},
      {"\x01\xff\x02", {"t.toml:1: not valid TOML"}},
      {"", {"t.toml:1: name: is missing"}},
  };
  for (const auto& [content, messages] : wrong) {
    scratch.write("t.toml", content);
    expect_refused(scratch, {"s.toml"}, messages);
  }
  std::filesystem::remove(scratch.folder() / "t.toml");
  expect_refused(scratch, {"s.toml"}, {"s.toml:3: start.target = \"t.toml\": there is no such file"});
  std::filesystem::create_directory(scratch.folder() / "t.toml");
  expect_refused(scratch, {"s.toml"}, {"start.target"});
}

}  // namespace
}  // namespace incognita
