// The settings and their tree, reading files and the command line, and every way in which both can be wrong.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <typeinfo>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/io/scenario/renamed_settings.hpp"
#include "incognita/io/scenario/unknown_setting.hpp"
#include "incognita/math/nearest_name.hpp"
#include "tests/merged_toml.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::Scratch;

std::string complaint(const std::string& toml, const std::vector<std::string>& sets = {}) {
  const Scratch scratch;
  const std::filesystem::path file = scratch.write("mine.toml", toml);
  return message_of([&] { load_scenario(file.string(), sets); });
}

LoadedScenario loaded(const std::string& toml, const std::vector<std::string>& sets = {},
                      const std::vector<Flag>& flags = {}) {
  const Scratch scratch;
  return load_scenario(scratch.write("mine.toml", toml).string(), sets, flags);
}

const std::string free_start = "[start]\nfrom = \"free\"\n";

TEST(NearestName, CountsEdits) {
  EXPECT_EQ(edit_distance("seed", "seed"), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("sede", "seed"), 1);  // neighbours swapped
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(nearest_name("sigma_pixels_px", {"seed", "sigma_pixel_px", "max_scale"}), "sigma_pixel_px");
  EXPECT_EQ(nearest_name("x", {}), "");
}

const std::vector<CatalogedSetting>& catalog() {
  static const std::vector<CatalogedSetting> all = all_settings();
  return all;
}

/// `--set` options that make a setting appear.
std::vector<std::string> sets_for(const CatalogedSetting& cataloged) {
  std::vector<std::string> sets;
  for (const auto& [key, values] : cataloged.context) sets.push_back(key + "=" + values.front());
  return sets;
}

TEST(Settings, KeysAreUniqueAndEndWithTheirUnit) {
  std::set<std::string> seen;
  const std::map<std::string, std::string> suffix = {{"s", "_s"},
                                                     {"Hz", "_hz"},
                                                     {"px", "_px"},
                                                     {"m", "_m"},
                                                     {"rad", "_rad"},
                                                     {"m/s", "_m_s"},
                                                     {"rad/s", "_rad_s"},
                                                     {"m/s^2", "_m_s2"},
                                                     {"rad/s^2", "_rad_s2"},
                                                     {"1/s", "_per_s"},
                                                     {"1/m", "_per_m"},
                                                     {"1/s^2", "_per_s2"},
                                                     {"1/px^2", "_per_px2"},
                                                     {"gray", "_gray"},
                                                     {"m^2", "_m2"},
                                                     {"1/m^2", "_per_m2"}};
  for (const auto& [setting, context] : catalog()) {
    EXPECT_TRUE(seen.insert(setting.key).second) << setting.key;
    EXPECT_FALSE(setting.help.empty()) << setting.key;
    if (suffix.count(setting.unit)) {
      EXPECT_TRUE(setting.key.ends_with(suffix.at(setting.unit))) << setting.key;
    }
  }
  EXPECT_GT(seen.size(), 180u);
}

/// The size of a struct whose members are those it describes, in that order of their addresses.
template <class S>
std::size_t described_size() {
  S s;
  std::map<const void*, std::pair<std::size_t, std::size_t>> members;  // size and alignment by address
  S::describe([&](auto member, auto&&...) {
    using Member = std::remove_reference_t<decltype(s.*member)>;
    members[&(s.*member)] = {sizeof(Member), alignof(Member)};
  });
  std::size_t size = 0, alignment = 1;
  const auto align = [&](std::size_t to) { size = (size + to - 1) / to * to; };
  for (const auto& [address, member] : members) {
    align(member.second);
    size += member.first;
    alignment = std::max(alignment, member.second);
  }
  align(alignment);
  return size;
}

// A member that is forgotten in describe() could never be set.
TEST(Settings, EveryMemberIsDescribed) {
  const auto expect_all = []<class... S>(std::type_identity<std::tuple<S...>>) {
    const auto expect = [](std::size_t described, std::size_t size, const char* name) {
      EXPECT_EQ(described, size) << name;
    };
    (expect(described_size<S>(), sizeof(S), typeid(S).name()), ...);
  };
  expect_all(
      std::type_identity<std::tuple<
          FilterSettings, SearchSettings, InitializationSettings, MapSettings, HealthSettings, StartSettings,
          RangeBearingSettings, PlanarFilterSettings, PlanarStartSettings, DataAssociationSettings,
          DecisionSettings, ExplorationSettings, ControlSettings, RoomSettings, OperatorSettings, RunSettings,
          WorldSettings, WideAngleLens, PinholeLens, CameraSettings, RecordingSettings, TeamStartSettings,
          FormSettings, PointsSettings, TruePlantSettings, PlaneTerrain, WavesTerrain, ImageTerrain,
          TerrainSettings, ControllerSettings, LawSettings, PathFile, PathSettings, PointPath, CirclePath,
          BackAndForthPath, WayPointPath>>{});
}

/// Every setting appears with its choices, takes its default when that is given, and takes each of its words.
TEST(Settings, DefaultsAndWordsAreTakenWhereTheyBelong) {
  int words = 0;
  for (const CatalogedSetting& cataloged : catalog()) {
    std::vector<std::string> values = cataloged.setting.options;
    words += values.size() > 1 ? 1 : 0;
    values.push_back(cataloged.setting.default_value);
    for (const std::string& value : values) {
      std::vector<std::string> sets = sets_for(cataloged);
      sets.push_back(cataloged.setting.key + "=" + value);
      const std::string said = complaint("", sets);
      EXPECT_EQ(said.find(cataloged.setting.key + " = " + value + ": must be `"), std::string::npos) << said;
      EXPECT_EQ(said.find("belongs to"), std::string::npos) << said;
    }
  }
  EXPECT_GE(words, 25);
}

/// A setting that a scenario does not have is refused with the choices that it needs.
TEST(Settings, OfOtherChoicesAreExplained) {
  int others = 0;
  for (const CatalogedSetting& cataloged : catalog()) {
    const auto& [setting, context] = cataloged;
    if (context.size() != 1) continue;
    ++others;
    const std::string said = complaint(free_start, {setting.key + "=" + setting.default_value});
    EXPECT_HAS(said, "--set: `" + setting.key + "` belongs to `" + context.begin()->first + " = ");
    EXPECT_HAS(said, "; here `" + context.begin()->first + " = ");
  }
  EXPECT_GT(others, 20);
}

TEST(Settings, RenamedOnesSayTheirNewName) {
  std::set<std::string> known;
  for (const CatalogedSetting& cataloged : catalog()) known.insert(cataloged.setting.key);
  ASSERT_GT(renamed_settings().size(), 100u);
  for (const auto& [before, after] : renamed_settings()) {
    EXPECT_FALSE(known.contains(before)) << before << " is in use";
    EXPECT_TRUE(known.contains(after)) << after;
    const std::string key(before);
    const std::string said = complaint(
        testing::merged_toml(free_start + "[" + section_of(key) + "]\n" + name_in_section(key) + " = 1\n"));
    EXPECT_HAS(said, "`" + key + "` is now ");
    EXPECT_HAS(said, "`" + std::string(after) + "`");
  }
}

std::size_t lines_of(const std::string& text) {
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// What a scenario has besides follows from the choice, so that only the choice is certainly wrong.
TEST(Settings, AWrongChoiceIsTheOnlyProblem) {
  struct Case {
    const char *text, *problem;
  };
  const Case cases[] = {
      {"[world]\ntype = \"point\"\n[points]\ncount = 3\n[vehicle]\nmodel = \"ackermann\"\nwheelbase_m = 2\n",
       "mine.toml:2: world.type = \"point\": must be `room`, `points`, `recording`, `live` or `robot`; the nearest is `points`"},
      {"[world]\ntype = \"points\"\n[vehicle]\nmodel = \"tricycle\"\nwheelbase_m = 2\nfront_m = 1\n",
       "mine.toml:4: vehicle.model = \"tricycle\": must be "},
      {"[start]\nfrom = \"free\"\n[camera]\nmodel = \"fish-eye\"\nk1 = 1\nk4 = 1\n",
       "mine.toml:4: camera.model = \"fish-eye\": must be `wide-angle`, `pinhole` or `fisheye`"},
      {"[start]\nfrom = \"free\"\n[birth]\nmethod = \"line\"\n[landmark_initialization]\nparticles = 9\n",
       "mine.toml:4: `birth.method` is now `landmark_initialization.method`"},
      {"[run]\nworld = \"points\"\n[points]\ncount = 3\n[vehicle]\nmodel = "
       "\"ackermann\"\nwheelbase_m = 2\n",
       "mine.toml:2: `run.world` is now `world.type`"},
  };
  for (const Case& one : cases) {
    const std::string said = complaint(one.text);
    EXPECT_HAS(said, one.problem);
    EXPECT_EQ(lines_of(said), 1u) << said;
  }
}

TEST(Settings, RenamedSectionsSayTheirNewName) {
  for (const char* lines : {"", "width_px = 3\n"}) {
    const std::string said = complaint(free_start + "[birth]\n" + lines);
    EXPECT_HAS(said, "mine.toml:3: section `birth` is now `landmark_initialization`");
    EXPECT_EQ(lines_of(said), 1u) << said;
  }
  EXPECT_HAS(complaint(free_start, {"lost.frames=3"}), "--set: section `lost` is now `health`");
  EXPECT_HAS(complaint(free_start + "[serch]\n"), "mine.toml:3: there is no section `serch`");
  EXPECT_EQ(complaint(free_start + "[points]\n"), "(none)") << "it has no settings to refuse";
}

TEST(Settings, DefaultsAreTheStructs) {
  const LoadedScenario mine = loaded(free_start);
  for (const SettingInForce& setting : mine.settings) {
    if (setting.key != "start.from") {
      EXPECT_EQ(setting.value, setting.default_value) << setting.key;
    }
    EXPECT_EQ(setting.is_given(), setting.key == "start.from");
  }
}

TEST(LoadScenario, ReadsEveryKindOfValue) {
  const LoadedScenario mine =
      loaded(free_start +
             "[run]\nseed = 12345678901\nduration_s = 7\n[search]\n"
             "patch_size_px = 13\n[landmark_initialization]\nmethod = \"depth-line\"\n"
             "[room]\nsize_m = [4, 5.5, 2.25]\n");
  EXPECT_EQ(mine.scenario.run.seed, 12345678901);
  EXPECT_EQ(mine.scenario.run.duration_s, 7);
  EXPECT_EQ(mine.scenario.slam.search.patch_size_px, 13);
  EXPECT_EQ(mine.scenario.slam.initialization.method, InitializationSettings::Method::depth_line);
  EXPECT_EQ(mine.scenario.room.size_m, Eigen::Vector3d(4, 5.5, 2.25));
  EXPECT_EQ(mine.name, "mine");
  EXPECT_TRUE(mine.sources.at("search.patch_size_px").ends_with("mine.toml:7"));
}

TEST(LoadScenario, FlagsBeatSetsBeatTheFileBeatsDefaults) {
  const LoadedScenario mine = loaded(free_start + "[run]\nseed = 2\nduration_s = 3\nrate_hz = 20\n",
                                     {"run.seed=5", "run.duration_s=6.5"}, {{"run.seed", "9", "--seed"}});
  EXPECT_EQ(mine.scenario.run.seed, 9);
  EXPECT_EQ(mine.scenario.run.duration_s, 6.5);
  EXPECT_EQ(mine.scenario.run.rate_hz, 20);
  EXPECT_EQ(mine.sources.at("run.seed"), "--seed");
  EXPECT_EQ(mine.sources.at("run.duration_s"), "--set");
  EXPECT_EQ(mine.sources.at("world.type"), "default");
  ASSERT_EQ(mine.overrides.size(), 3u);
  EXPECT_HAS(mine.overrides[0], "run.seed = 5 (--set) replaces 2 (");
  EXPECT_HAS(mine.overrides[0], "mine.toml:4)");
  EXPECT_EQ(mine.overrides[2], "run.seed = 9 (--seed) replaces 5 (--set)");
}

TEST(LoadScenario, SetTakesTextsAndLists) {
  const LoadedScenario mine =
      loaded(free_start, {"start.from=target", "start.target=a b=c", "decision.max_bound_m=[2, 1, 3.5]",
                          "landmark_initialization.method=\"depth-line\""});
  EXPECT_EQ(mine.scenario.start.target, "a b=c");
  EXPECT_EQ(mine.scenario.decision.max_bound_m, Eigen::Vector3d(2, 1, 3.5));
  EXPECT_EQ(mine.scenario.slam.initialization.method, InitializationSettings::Method::depth_line);
}

TEST(LoadScenario, RefusesUnknownNamesWithTheNearest) {
  const std::string key = complaint(free_start + "[run]\nsede = 3\n");
  EXPECT_HAS(key, "mine.toml:4: there is no setting `run.sede`; the nearest is `run.seed`");
  const std::string section = complaint(free_start + "\n[serch]\ngate_sigmas = 1\n");
  EXPECT_HAS(section, "mine.toml:4: there is no section `serch`; the nearest is `search`");
  EXPECT_HAS(complaint(free_start, {"sensor.sigma_pixel=1"}),
             "--set: there is no setting `sensor.sigma_pixel`; the nearest is `sensor.sigma_pixel_px`");
  for (const char* set : {"run.seed", "", "=3", "run=3", "run.=3", ".seed=3"})
    EXPECT_HAS(complaint(free_start, {set}),
               "--set: `" + std::string(set) + "` must be written section.name=value");
  EXPECT_HAS(complaint(free_start + "\"\" = 1\n"),
             "mine.toml:3: the name is empty; a setting of [start] is written name = value");
  for (const char* section : {"\"\" = 1\n", "[\"\"]\na = 1\n"})
    EXPECT_HAS(complaint(section + free_start),
               "mine.toml:1: the name is empty; a section is written [name]");
  EXPECT_HAS(complaint("run = 3\n" + free_start), "mine.toml:1: run = 3: must be a section, written [run]");
  const std::string scenario = message_of([] { load_scenario("rooom"); });
  EXPECT_HAS(scenario, "rooom: no such scenario file");
  EXPECT_HAS(scenario, "the nearest is room");
}

TEST(LoadScenario, RefusesWrongValues) {
  struct Case {
    const char *section, *line, *part;
  };
  const Case cases[] = {
      {"run", "seed = \"x\"", "run.seed = \"x\": must be a whole number, at least 0, and is a text"},
      {"run", "seed = 1.5", "run.seed = 1.5: must be a whole number, at least 0, and is a number"},
      {"run", "seed = -1", "run.seed = -1: must be at least 0"},
      {"run", "rate_hz = 0", "run.rate_hz = 0: must be more than 0 to 10000"},
      {"run", "duration_s = -3.0", "run.duration_s = -3.0: must be more than 0"},
      {"run", "duration_s = nan", "run.duration_s = nan: must be finite"},
      {"run", "duration_s = inf", "run.duration_s = inf: must be finite"},
      {"run", "rate_hz = true", "run.rate_hz = true: must be a number"},
      {"run", "rate_hz = 2020-01-01", "and is a date or time"},
      {"world", "type = \"rom\"",
       "world.type = \"rom\": must be `room`, `points`, `recording`, `live` or `robot`; the nearest is `room`"},
      {"world", "type = 3", "world.type = 3: must be a text"},
      {"camera", "width_px = -320", "camera.width_px = -320: must be 16 to 16384"},
      {"camera", "width_px = 99999999999999", "camera.width_px = 99999999999999: must be 16 to 16384"},
      {"search", "patch_size_px = 10", "search.patch_size_px = 10: must be odd, 9 to 15"},
      {"search", "patch_size_px = 17", "search.patch_size_px = 17: must be odd, 9 to 15"},
      {"landmark_initialization", "max_new_per_frame = -1",
       "landmark_initialization.max_new_per_frame = -1: must be 0 to"},
      {"room", "size_m = [1, 2]", "room.size_m = [1, 2]: must be a list of three numbers"},
      {"room", "size_m = [6, 2, nan]", "room.size_m = [6, 2, nan]: must be finite"},
      {"room", "size_m = [6, \"2\", 3]", "must be a list of three numbers"},
      {"room", "boxes = {a = 1}", "room.boxes = {...}: must be a whole number"},
  };
  for (const Case& one : cases) {
    const std::string text = complaint(free_start + "[" + one.section + "]\n" + one.line + "\n");
    EXPECT_HAS(text, one.part);
    EXPECT_HAS(text, "mine.toml:4: ");
  }
  EXPECT_HAS(complaint(free_start, {"run.seed=many"}), "--set: run.seed = many: must be a whole number");
  EXPECT_HAS(complaint(free_start, {"run.seed=1\n[x]"}), "must be a whole number");
  EXPECT_HAS(complaint(free_start, {"run.rate_hz=inf"}), "must be finite");
  EXPECT_HAS(complaint(free_start, {"run.rate_hz="}), "must be a number");
}

TEST(LoadScenario, NamesAllFaultsAtOnce) {
  const std::string text = complaint(free_start + "[run]\nsede = 1\nrate_hz = -1\n", {"world.type=x"});
  EXPECT_HAS(text, "mine.toml:4: ");
  EXPECT_HAS(text, "mine.toml:5: ");
  EXPECT_HAS(text, "--set: world.type = x");
}

/// A word of the file need not fit the choices that replace it.
TEST(LoadScenario, ReplacesWordsThatDoNotFitOtherReplacements) {
  const std::string points =
      "[world]\ntype = \"points\"\n[vehicle]\nmodel = \"differential-drive\"\n[sensor]\n"
      "type = \"range-bearing\"\n";
  const std::vector<std::string> room = {"world.type=room", "vehicle.model=terrain", "sensor.type=camera",
                                         "start.from=free"};
  EXPECT_EQ(complaint(points, room), "(none)");
  EXPECT_HAS(complaint(points, {"world.type=room", "vehicle.model=terrain"}),
             "sensor.type = \"range-bearing\": must be");
}

TEST(LoadScenario, RefusesContradictions) {
  struct Case {
    const char *text, *part;
  };
  const Case cases[] = {
      {"[landmark_initialization]\nselection = \"random-box\"\nmax_depth_m = 0.2",
       "mine.toml:5: landmark_initialization.max_depth_m = 0.2: must be more than landmark_initialization.min_depth_m"},
      {"[landmark_initialization]\nselection = \"random-box\"\nbox_width_px = 400",
       "mine.toml:5: landmark_initialization.box_width_px = 400: must be at most camera.width_px, which is 320"},
      {"[decision]\nmax_bound_m = [1, -2e9, 1]", "mine.toml:4: decision.max_bound_m"},
      {"[world]\ntype = \"recording\"", "default: recording.folder = \"\": must name the recording"},
      {"[room]\nstart_position_m = [9, 0, 1]",
       "mine.toml:4: room.start_position_m = [9.0, 0.0, 1.0]: must be inside"},
      {"[camera]\nu0_px = 400",
       "mine.toml:4: camera.u0_px = 400.0: must lie inside the image, 0 to 320 (camera.width_px)"},
      {"[camera]\nkd1_per_px2 = 0.34", "mine.toml:4: camera.kd1_per_px2 = 0.34: must leave a ray"},
      {"[camera]\nk1 = -8\nmodel = \"pinhole\"", "mine.toml:4: camera.k1 = -8.0: must leave a ray"},
      {"[camera]\nk1 = -0.3",
       "mine.toml:4: `camera.k1` belongs to `camera.model = \"pinhole\" or \"fisheye\"`; here `camera.model = "
       "\"wide-angle\"`"},
      {"[camera]\nk4 = -0.3\nmodel = \"pinhole\"",
       "mine.toml:4: `camera.k4` belongs to `camera.model = \"fisheye\"`; here `camera.model = \"pinhole\"`"},
      {"[camera]\nkd1_per_px2 = 9e-6\nmodel = \"pinhole\"",
       "mine.toml:4: `camera.kd1_per_px2` belongs to `camera.model = \"wide-angle\"`"},
      {"[room]\nsize_m = [6, 1.9, 2.5]",
       "mine.toml:4: room.size_m = [6.0, 1.9, 2.5]: must be 2 to 50 long and wide"},
      {"[room]\nsize_m = [6, 6, 30]",
       "mine.toml:4: room.size_m = [6.0, 6.0, 30.0]: must be 2 to 50 long and wide"},
      {"[run]\nduration_s = 1e7\nrate_hz = 1000",
       "mine.toml:4: run.duration_s = 10000000.0: must make at most 1e+09"},
      {"[map]\nmax_landmarks = 5\nwanted_visible = 12",
       "map.wanted_visible = 12: must be at most map.max_landmarks"},
  };
  for (const Case& one : cases) EXPECT_HAS(complaint(free_start + one.text + "\n"), one.part);
  EXPECT_HAS(complaint("[start]\nfrom = \"target\"\n"), "start.target = \"\": must name a target file");
  EXPECT_HAS(complaint("[start]\nfrom = \"target\"\n"), "without a target write start.from = \"free\"");
}

TEST(LoadScenario, RefusesWhatIsNotToml) {
  EXPECT_HAS(complaint("[run]\nseed = \n"), "mine.toml:2: not valid TOML");
  EXPECT_HAS(complaint("[run\n"), "mine.toml:1: not valid TOML");
  EXPECT_HAS(complaint("a = 1\na = 2\n"), "mine.toml:2: not valid TOML");
  EXPECT_HAS(complaint("a = " + std::string(100000, '[')), "not valid TOML");
  EXPECT_HAS(complaint(std::string(2 << 20, '#')), "mine.toml: is larger than");
  EXPECT_HAS(message_of([] { load_scenario("/"); }), "is a folder");
}

// Whatever a file holds, the answer is a scenario or an InputError.
TEST(LoadScenario, SurvivesMutations) {
  const std::string seed = read_file("embedded:/room.toml", 1 << 20);
  ASSERT_GT(seed.size(), 500u);
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return random() % n; };
  const std::string pieces[] = {"[", "]", "[[", "\"",          "\"\"\"",       "'''",   "{",     "}",
                                "=", ".", "\n", "\\u",         "\xff",         "\0",    "1e999", "nan",
                                "#", "-", "0x", "1979-05-27T", "\xef\xbb\xbf", "a.b.c", ","};
  int refused = 0, accepted = 0;
  for (int i = 0; i < 6000; ++i) {
    std::string text = seed.substr(0, i % 3 == 0 ? below(seed.size()) : seed.size());
    for (std::size_t edits = 1 + below(4); edits > 0; --edits) {
      const std::size_t at = below(text.size() + 1);
      switch (below(4)) {
        case 0:
          text.insert(at, pieces[below(std::size(pieces))]);
          break;
        case 1:
          text.insert(at, 1, static_cast<char>(random()));
          break;
        case 2:
          text.erase(at, below(20));
          break;
        default:
          if (at < text.size()) text[at] = static_cast<char>(random());
      }
    }
    try {
      parse_toml(text, "fuzz");
      ++accepted;
    } catch (const InputError& error) {
      EXPECT_HAS(error.what(), "fuzz:");
      ++refused;
    }
  }
  EXPECT_GT(refused, 500);
  EXPECT_GT(accepted, 500);
}

TEST(LoadScenario, SurvivesRandomBytesInFiles) {
  std::mt19937 random(11);
  const Scratch scratch;
  for (int i = 0; i < 300; ++i) {
    std::string text;
    for (std::size_t n = random() % 200; n > 0; --n) text += static_cast<char>(random());
    const std::string file = scratch.write("noise.toml", text).string();
    try {
      load_scenario(file);
    } catch (const InputError&) {
    }
  }
}

TEST(LoadScenario, FindsBuiltInScenariosFromAnywhere) {
  const std::filesystem::path here = std::filesystem::current_path();
  const Scratch scratch;
  std::filesystem::current_path(scratch.folder());
  const LoadedScenario room = load_scenario("room"), davison = load_scenario("davison");
  std::filesystem::current_path(here);
  EXPECT_EQ(room.scenario.world.type, WorldSettings::Type::room);
  EXPECT_EQ(davison.scenario.recording.folder, "monoslam_testseq/frames");
  EXPECT_EQ(std::get<WideAngleLens>(davison.scenario.camera.model).kd1_per_px2, 9e-6);
  EXPECT_TRUE(davison.sources.at("camera.kd1_per_px2").starts_with("davison.toml:"));
}

void expect_same_again(const LoadedScenario& first) {
  const Scratch scratch;
  const LoadedScenario again = load_scenario(scratch.write("effective.toml", effective_toml(first)).string());
  ASSERT_EQ(first.settings.size(), again.settings.size()) << first.name;
  for (std::size_t i = 0; i < first.settings.size(); ++i) {
    EXPECT_EQ(first.settings[i].key, again.settings[i].key) << first.name;
    EXPECT_EQ(first.settings[i].value, again.settings[i].value) << first.settings[i].key;
    const bool is_replaced = again.settings[i].key == "camera.file";  // by the values that it gives
    EXPECT_NE(again.settings[i].is_given(), is_replaced) << again.settings[i].key;
  }
}

TEST(EffectiveToml, GivesEveryScenarioAgain) {
  for (const std::string& name : embedded_scenarios()) expect_same_again(load_scenario(name));
  expect_same_again(load_scenario("car-park-anchored", std::vector<std::string>{"estimator.use_fixes=true"}));
}

TEST(EffectiveToml, KeepsEveryDigit) {
  const LoadedScenario first = load_scenario(
      "room", std::vector<std::string>{"sensor.sigma_pixel_px=0.4234567890123456789",
                                       "run.seed=9007199254740993", "decision.min_bound_m=[-1e-7,-3,0.1]"});
  expect_same_again(first);
  const std::string text = effective_toml(first);
  EXPECT_HAS(text, "sigma_pixel_px = 0.4234567890123457  # --set; px; ");
  EXPECT_HAS(text, "# default; ");
  EXPECT_EQ(text.find("[vehicle_start]"), std::string::npos);
}

TEST(LoadScenario, RefusesASectionOfAnotherSensor) {
  EXPECT_HAS(complaint("[world]\ntype = \"recording\"\n[sensor]\ntype = \"range-bearing\"\n"
                       "[recording]\nfolder = \"x\"\n[camera]\nfu_px = 200\nfv_px = 200\n"),
             "mine.toml:7: section `camera` belongs to `sensor.type = \"camera\"`; here `sensor.type = "
             "\"range-bearing\"`");
  EXPECT_HAS(complaint(free_start + "[vehicle]\nmodel = \"ackermann\"\n"),
             "vehicle.model = \"ackermann\": must be `free-camera` or `terrain`");
}

/// Nothing controls the motion of recorded images.
/// The box of new landmarks, which is larger by default, is no setting unless they are chosen in it.
TEST(LoadScenario, TakesASmallCameraWhoseLandmarksAreChosenInNoBox) {
  const std::string small =
      free_start + "[camera]\nwidth_px = 32\nheight_px = 24\nu0_px = 15.5\nv0_px = 11.5\n";
  EXPECT_EQ(complaint(small), "(none)");
  EXPECT_HAS(complaint(small + "[landmark_initialization]\nselection = \"random-box\"\n"),
             "landmark_initialization.box_width_px");
}

/// A live run is repeated from what it recorded.
TEST(ReplayToml, IsTheLiveScenarioWithTheRecordingInPlaceOfTheCamera) {
  const LoadedScenario live = loaded(
      free_start + "[world]\ntype = \"live\"\n[live]\nsource = \"/dev/video0\"\n[camera]\nfu_px = 321\n");
  const Scratch scratch;
  std::filesystem::create_directories(scratch / "recording");
  const LoadedScenario replay =
      load_scenario(scratch.write("replay.toml", replay_toml(live, "recording")).string());
  EXPECT_TRUE(replay.scenario.is_recording());
  EXPECT_EQ(replay.scenario.recording.folder, "recording");
  EXPECT_EQ(replay.scenario.camera.fu_px, 321);
  for (const SettingInForce& setting : live.settings) {
    if (setting.key.starts_with("live.") || setting.key == "world.type") continue;
    EXPECT_TRUE(replay.sources.contains(setting.key)) << setting.key;
  }
}

TEST(LoadScenario, RefusesAControllerOfRecordedImages) {
  const std::string said = complaint(free_start +
                                     "[world]\ntype = \"recording\"\n[recording]\nfolder = \"x\"\n"
                                     "[controller]\ngain_position_per_s2 = 3\n");
  EXPECT_HAS(said, "mine.toml:7: section `controller` belongs to `world.type = ");
  EXPECT_HAS(said, "; here `world.type = \"recording\"`");
}

/// The choice of the command line decides. The file's settings of the choice it replaces are left out, with a note each;
/// settings of another choice are errors as soon as the command line gives them, or the file decides the choice itself.
TEST(LoadScenario, ChoicesOfTheCommandLineComeFirst) {
  const std::string text =
      "[world]\ntype = \"points\"\n[sensor]\ntype = \"range-bearing\"\n[vehicle]\nmodel = "
      "\"differential-drive\"\nsensor_forward_m = 0.3\n[controller]\nlaw = \"feedback-linearization\"\n";
  const LoadedScenario circle =
      loaded(text + "[path]\nradius_m = 3\n", {"path.type=circle", "path.rate_rad_s=0.1"});
  EXPECT_EQ(std::get<CirclePath>(circle.scenario.path.type).radius_m, 3);
  EXPECT_EQ(std::get<CirclePath>(circle.scenario.path.type).rate_rad_s, 0.1);

  const std::string on_circle = text + "[path]\ntype = \"circle\"\nradius_m = 3\n";
  const LoadedScenario point = loaded(on_circle, {"path.type=point"});
  EXPECT_TRUE(std::holds_alternative<PointPath>(point.scenario.path.type));
  ASSERT_EQ(point.overrides.size(), 2u);  // the choice itself and what goes with it
  EXPECT_HAS(point.overrides[1], "path.radius_m (");
  EXPECT_HAS(point.overrides[1],
             "mine.toml:12) is left out: it belongs to a choice that the command line replaces");

  const std::string belongs =
      "`path.radius_m` belongs to `path.type = \"circle\" or \"back-and-forth\"`; here "
      "`path.type = \"point\"`";
  EXPECT_HAS(complaint(on_circle, {"path.type=point", "path.radius_m=3"}), "--set: " + belongs);
  EXPECT_HAS(complaint(text + "[path]\ntype = \"point\"\nradius_m = 3\n"), "mine.toml:12: " + belongs);
}

/// Those of a strategy that is not chosen are taken, so that a campaign can vary the strategy.
TEST(LoadScenario, TakesTheSettingsOfAllStrategies) {
  const std::string text =
      free_start +
      "[decision]\nsequence = \"go_left\"\ngaze_rate_rad_s = 0.1\nmin_bound_m = [-2, -2, 1]\n"
      "max_bound_m = [2, 2, 2]\n[exploration]\nexpected_landmarks = 5\n";
  for (const char* strategy :
       {"mutual-information", "random", "fixed-path", "lawn-mower", "wall-follower", "frontier", "none"})
    for (const char* gaze : {"swing", "hold", "constant-rate", "fisher"})
      EXPECT_EQ(complaint(text, {"decision.strategy=" + std::string(strategy),
                                 "decision.gaze=" + std::string(gaze)}),
                "(none)");
}

TEST(LoadScenario, ReadsPairsAndAnswers) {
  const std::string vehicle =
      "[world]\ntype = \"recording\"\n[sensor]\ntype = \"range-bearing\"\n[recording]\nfolder = \"x\"\n";
  const LoadedScenario mine = loaded(vehicle +
                                     "[estimator]\nanchors_m = [[1, 2.5]]\nuse_fixes = true\n"
                                     "[start]\nposition_m = [3, 4]\n");
  ASSERT_EQ(mine.scenario.planar.filter.anchors.size(), 1u);
  EXPECT_EQ(mine.scenario.planar.filter.anchors[0], Eigen::Vector2d(1, 2.5));
  EXPECT_TRUE(mine.scenario.planar.filter.use_fixes);
  EXPECT_EQ(mine.scenario.planar.start.position_m, Eigen::Vector2d(3, 4));
  EXPECT_HAS(complaint(vehicle + "[estimator]\nanchors_m = [1, 2]\n"), "must be a list of [x, y]");
  EXPECT_HAS(complaint(vehicle + "[estimator]\nanchors_m = [[1, 2, 3]]\n"), "anchors_m");
  EXPECT_HAS(complaint(vehicle + "[estimator]\nuse_fixes = 1\n"), "must be true or false");
}

TEST(EffectiveToml, StaysOnItsLinesWhateverIsInTexts) {
  LoadedScenario first = load_scenario("room", std::vector<std::string>{"start.target=a\"b\\c\n[x]\tü"});
  first.settings[0].source = "two\nlines";
  const Scratch scratch;
  const LoadedScenario again = load_scenario(scratch.write("e.toml", effective_toml(first)).string());
  EXPECT_EQ(again.scenario.start.target, "a\"b\\c\n[x]\tü");
}

}  // namespace
}  // namespace incognita
