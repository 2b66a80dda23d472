// The list of settings, reading files and the command line, and every way in which both can be wrong.
#include "incognita/io/scenario/settings.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/math/nearest_name.hpp"
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

TEST(Settings, KeysAreUniqueAndEndWithTheirUnit) {
  Scenario scenario;
  std::set<std::string> seen;
  std::set<const void*> fields;
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
                                                     {"grey", "_grey"}};
  for (const Setting& setting : list_settings(scenario)) {
    EXPECT_TRUE(seen.insert(setting.key).second) << setting.key;
    EXPECT_TRUE(
        fields.insert(std::visit([](auto* f) { return static_cast<const void*>(f); }, setting.field)).second)
        << setting.key;
    EXPECT_FALSE(setting.help.empty()) << setting.key;
    if (suffix.count(setting.unit)) {
      EXPECT_TRUE(setting.key.ends_with(suffix.at(setting.unit))) << setting.key;
    }
  }
}

// A field that is forgotten in the list could never be set. Every byte of the structs is a field's or
// padding, whose amount on a 64-bit machine is known: whoever adds a field adds it to the list, and an int
// may change the padding.
TEST(Settings, EveryFieldIsBound) {
  Scenario scenario;
  std::size_t bytes = 0;
  for (const Setting& setting : list_settings(scenario)) {
    bytes += std::visit([](auto* f) { return sizeof *f; }, setting.field);
  }
  constexpr std::size_t padding = 148;
  // Parameters of models that have no member of their own are bound one by one, not as a map
  constexpr std::size_t maps = 2 * sizeof(std::map<std::string, double>);
  EXPECT_EQ(sizeof(Scenario), bytes + padding + maps);
}

TEST(Settings, DefaultsAreAllowedAndReadBack) {
  Scenario scenario, other;
  const std::vector<Setting> settings = list_settings(scenario), others = list_settings(other);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (settings[i].key == "recording.folder" || settings[i].key == "start.target") continue;
    EXPECT_NO_THROW(assign_text(others[i], settings[i].written())) << settings[i].key;
    EXPECT_EQ(settings[i].written(), others[i].written());
  }
}

/// Every word of a choice is taken, and written back as it was given.
TEST(Settings, ChoicesAreReadAndWrittenByTheirWords) {
  Scenario scenario;
  int choices = 0;
  for (const Setting& setting : list_settings(scenario)) {
    for (const std::string& word : setting.allowed.choices) {
      assign_text(setting, word);
      EXPECT_EQ(setting.written(), "\"" + word + "\"") << setting.key;
    }
    choices += setting.allowed.choices.empty() ? 0 : 1;
  }
  EXPECT_GE(choices, 20);
  EXPECT_EQ(scenario.decision.gaze, DecisionSettings::Gaze::fisher_given_state) << "the last of its words";
}

TEST(Settings, DefaultsAreTheStructs) {
  LoadedScenario mine = loaded(free_start);
  Scenario defaults;
  defaults.start.from = StartSettings::From::free;
  const std::vector<Setting> read = list_settings(mine.scenario), wanted = list_settings(defaults);
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].written(), wanted[i].written()) << read[i].key;
    EXPECT_EQ(mine.sources.at(read[i].key) == "default", read[i].key != "start.from");
  }
}

TEST(LoadScenario, ReadsEveryKindOfValue) {
  const LoadedScenario mine = loaded(free_start +
                                     "[run]\nseed = 12345678901\nduration_s = 7\n[search]\n"
                                     "patch_size_px = 13\n[birth]\nmethod = \"depth-line\"\n"
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
  EXPECT_EQ(mine.sources.at("run.world"), "default");
  ASSERT_EQ(mine.overrides.size(), 3u);
  EXPECT_HAS(mine.overrides[0], "run.seed = 5 (--set) replaces 2 (");
  EXPECT_HAS(mine.overrides[0], "mine.toml:4)");
  EXPECT_EQ(mine.overrides[2], "run.seed = 9 (--seed) replaces 5 (--set)");
}

TEST(LoadScenario, SetTakesTextsAndLists) {
  const LoadedScenario mine =
      loaded(free_start,
             {"recording.folder=a b=c", "decision.max_bound_m=[2, 1, 3.5]", "birth.method=\"depth-line\""});
  EXPECT_EQ(mine.scenario.recording.folder, "a b=c");
  EXPECT_EQ(mine.scenario.decision.max_bound_m, Eigen::Vector3d(2, 1, 3.5));
  EXPECT_EQ(mine.scenario.slam.initialization.method, InitializationSettings::Method::depth_line);
}

TEST(LoadScenario, RefusesUnknownNamesWithTheNearest) {
  const std::string key = complaint(free_start + "[run]\nsede = 3\n");
  EXPECT_HAS(key, "mine.toml:4: there is no setting `run.sede`; the nearest is `run.seed`");
  const std::string section = complaint(free_start + "\n[fliter]\nsigma_pixel_px = 1\n");
  EXPECT_HAS(section, "mine.toml:4: there is no section `fliter`; the nearest is `filter`");
  EXPECT_HAS(complaint(free_start, {"filter.sigma_pixel=1"}),
             "--set: there is no setting `filter.sigma_pixel`; the nearest is `filter.sigma_pixel_px`");
  EXPECT_HAS(complaint(free_start, {"run.seed"}), "--set: `run.seed` must be written section.name=value");
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
      {"run", "world = \"rom\"",
       "run.world = \"rom\": must be `room`, `points` or `recording`; the nearest is `room`"},
      {"run", "world = 3", "run.world = 3: must be a text"},
      {"camera", "width_px = -320", "camera.width_px = -320: must be 16 to 16384"},
      {"camera", "width_px = 99999999999999", "camera.width_px = 99999999999999: must be 16 to 16384"},
      {"search", "patch_size_px = 10", "search.patch_size_px = 10: must be odd, 9 to 15"},
      {"search", "patch_size_px = 17", "search.patch_size_px = 17: must be odd, 9 to 15"},
      {"birth", "particles = 1", "birth.particles = 1: must be 2 to 100000"},
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

TEST(LoadScenario, TellsAllFaultsAtOnce) {
  const std::string text = complaint(free_start + "[run]\nsede = 1\nrate_hz = -1\n", {"run.world=x"});
  EXPECT_HAS(text, "mine.toml:4: ");
  EXPECT_HAS(text, "mine.toml:5: ");
  EXPECT_HAS(text, "--set: run.world = x");
}

TEST(LoadScenario, RefusesContradictions) {
  struct Case {
    const char *text, *part;
  };
  const Case cases[] = {
      {"[birth]\nmax_depth_m = 0.2",
       "mine.toml:4: birth.max_depth_m = 0.2: must be more than birth.min_depth_m"},
      {"[birth]\nbox_width_px = 400",
       "mine.toml:4: birth.box_width_px = 400: must be at most camera.width_px, which is 320"},
      {"[decision]\nmax_bound_m = [1, -2e9, 1]", "mine.toml:4: decision.max_bound_m"},
      {"[run]\nworld = \"recording\"", "default: recording.folder = \"\": must name the recording"},
      {"[room]\nstart_position_m = [9, 0, 1]",
       "mine.toml:4: room.start_position_m = [9.0, 0.0, 1.0]: must be inside"},
      {"[camera]\nu0_px = 400",
       "mine.toml:4: camera.u0_px = 400.0: camera u0_px must lie inside the image width"},
      {"[camera]\nkd1_per_px2 = 0.34",
       "mine.toml:4: camera.kd1_per_px2 = 0.34: camera kd1_per_px2 must leave a ray"},
      {"[camera]\nk1 = -8\nmodel = \"pinhole\"", "mine.toml:4: camera.k1 = -8.0: camera k1 must leave a ray"},
      {"[camera]\nk1 = -0.3", "mine.toml:4: camera.k1 = -0.3: must be 0, camera.model being `wide-angle`"},
      {"[camera]\nkd1_per_px2 = 9e-6\nmodel = \"pinhole\"",
       "mine.toml:4: camera.kd1_per_px2 = 9e-06: must be 0"},
      {"[room]\nsize_m = [6, 1.9, 2.5]",
       "mine.toml:4: room.size_m = [6.0, 1.9, 2.5]: must be 2 to 50 long and wide"},
      {"[room]\nsize_m = [6, 6, 30]",
       "mine.toml:4: room.size_m = [6.0, 6.0, 30.0]: must be 2 to 50 long and wide"},
      {"[run]\nduration_s = 1e7\nrate_hz = 1000",
       "mine.toml:4: run.duration_s = 10000000.0: must make at most 1e+09"},
      {"[map]\nmax_landmarks = 5", "map.wanted_visible = 12: must be at most map.max_landmarks"},
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
  EXPECT_EQ(room.scenario.run.world, "room");
  EXPECT_EQ(davison.scenario.recording.folder, "monoslam_testseq/frames");
  EXPECT_EQ(davison.scenario.camera.kd1_per_px2, 9e-6);
  EXPECT_TRUE(davison.sources.at("camera.kd1_per_px2").starts_with("davison.toml:"));
}

TEST(EffectiveToml, GivesTheSameScenarioAgain) {
  for (const char* name : {"room", "davison"}) {
    LoadedScenario first = load_scenario(
        name, std::vector<std::string>{"filter.sigma_pixel_px=0.4234567890123456789",
                                       "run.seed=9007199254740993", "decision.min_bound_m=[-1e-7,-3,0.1]"});
    const std::string text = effective_toml(first);
    const Scratch scratch;
    LoadedScenario again = load_scenario(scratch.write("effective.toml", text).string());
    const std::vector<Setting> a = list_settings(first.scenario), b = list_settings(again.scenario);
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].written(), b[i].written()) << a[i].key;
      const bool in_force = inapplicable_reason(a[i].key, first.scenario).empty();
      EXPECT_EQ(again.sources.at(a[i].key) == "default", !in_force) << a[i].key;
    }
    EXPECT_HAS(text, "sigma_pixel_px = 0.4234567890123457  # --set; px; ");
    EXPECT_HAS(text, "# default; ");
  }
}

TEST(EffectiveToml, GivesTheSameVehicleAgain) {
  LoadedScenario first =
      load_scenario("car-park-anchored", std::vector<std::string>{"vehicle_filter.use_fixes=true"});
  const std::string text = effective_toml(first);
  EXPECT_HAS(text, "anchors_m = [[2.8953, -4.0353], [9.9489, 6.9239]]");
  EXPECT_EQ(text.find("[camera]"), std::string::npos);
  const Scratch scratch;
  LoadedScenario again = load_scenario(scratch.write("effective.toml", text).string());
  const std::vector<Setting> a = settings_in_force(first.scenario), b = settings_in_force(again.scenario);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].written(), b[i].written()) << a[i].key;
}

TEST(LoadScenario, RefusesASectionOfAnotherSensor) {
  EXPECT_HAS(
      complaint("[run]\nworld = \"recording\"\nsensor = \"range-bearing\"\n[recording]\nfolder = \"x\"\n"
                "[camera]\nfu_px = 200\n"),
      "camera.fu_px = 200.0: means nothing with run.sensor = `range-bearing`");
  EXPECT_HAS(complaint(free_start + "[vehicle]\nmodel = \"ackermann\"\n"),
             "vehicle.model = \"ackermann\": means nothing with run.sensor = `camera`");
}

TEST(LoadScenario, ReadsPairsAndAnswers) {
  const std::string vehicle =
      "[run]\nworld = \"recording\"\nsensor = \"range-bearing\"\n[recording]\nfolder = \"x\"\n";
  const LoadedScenario mine = loaded(vehicle +
                                     "[vehicle_filter]\nanchors_m = [[1, 2.5]]\nuse_fixes = true\n"
                                     "[vehicle_start]\nposition_m = [3, 4]\n");
  ASSERT_EQ(mine.scenario.planar.filter.anchors.size(), 1u);
  EXPECT_EQ(mine.scenario.planar.filter.anchors[0], Eigen::Vector2d(1, 2.5));
  EXPECT_TRUE(mine.scenario.planar.filter.use_fixes);
  EXPECT_EQ(mine.scenario.planar.start.position_m, Eigen::Vector2d(3, 4));
  EXPECT_HAS(complaint(vehicle + "[vehicle_filter]\nanchors_m = [1, 2]\n"), "must be a list of [x, y]");
  EXPECT_HAS(complaint(vehicle + "[vehicle_filter]\nanchors_m = [[1, 2, 3]]\n"), "anchors_m");
  EXPECT_HAS(complaint(vehicle + "[vehicle_filter]\nuse_fixes = 1\n"), "must be true or false");
}

TEST(EffectiveToml, StaysOnItsLinesWhateverIsInTexts) {
  LoadedScenario first = load_scenario("room", std::vector<std::string>{"recording.folder=a\"b\\c\n[x]\tü"});
  first.sources["run.seed"] = "two\nlines";
  const Scratch scratch;
  const LoadedScenario again = load_scenario(scratch.write("e.toml", effective_toml(first)).string());
  EXPECT_EQ(again.scenario.recording.folder, "a\"b\\c\n[x]\tü");
}

}  // namespace
}  // namespace incognita
