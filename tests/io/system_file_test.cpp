// Systems written as TOML: valid files, and every kind of invalid one.
#include "incognita/io/formats/system_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "incognita/io/formats/toml_value.hpp"
#include "tests/io/damage.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::contents;
using testing::message_of;
using testing::Scratch;

std::string complaint(const std::string& toml) {
  return message_of([&] { read_system(toml, "s.toml"); });
}

/// A file with every key; `with` replaces a part of it.
const std::string whole = R"toml(name = "cart"
title = "cart on a line"
source = "by hand"
representation = "world"
segment_duration_s = 0.5

[parameters]
L = 1.5
[inputs]
v = [-1, 1]
[states]
x = "v + drag"
w = 0
[definitions]
drag = "-0.1*w*L"
half = "drag/2"
[region]
x = [-2, 2]
w = [0.5, 1e1]
[measurements]
place = "x"
[landmark.states]
p = 0
[landmark.region]
p = [3, 9]
[landmark.definitions]
r = "p - x"
[landmark.measurements]
distance = { is = "r", sigma = 0.1 }
[landmark.directions.depth]
p = "r"
[anchor.constants]
q = [-9, -3]
[anchor.definitions]
s = "q - x"
[anchor.measurements]
distance = { is = "s" }
[motion.steady]
v = "u*half"
x = -1.5
draw.u = [0, 1]
[directions."along x"]
x = 1
landmark.p = "r/r"
[error]
source = "(1.2)"
states.x = "error of x"
[error.F]
x = { w = "-0.1*L" }
[error.H]
place = { x = 1 }
[error.directions."along x"]
x = 1
landmark.p = 1
[landmark.error.H]
distance = { p = 1, x = -1 }
[landmark.error.F]
p = {}
[landmark.error.directions.depth]
p = 1
[anchor.error.H]
distance = { x = -1 }
)toml";

std::string with(const std::string& part, const std::string& by) {
  std::string text = whole;
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), by);
}

std::string at(const SourceLocation& location) {
  return std::to_string(location.line) + ":" + std::to_string(location.column);
}

std::string described(const std::vector<NamedExpression>& all) {
  std::string text;
  for (const NamedExpression& e : all)
    text += e.name + "@" + at(e.location) + "=" + e.expression.text + "@" + at(e.expression.location) + " ";
  return text;
}

std::string described(const std::vector<NamedRange>& all) {
  std::string text;
  for (const NamedRange& r : all)
    text += r.name + "@" + at(r.location) + "=" + toml_number(r.low) + ".." + toml_number(r.high) + " ";
  return text;
}

std::string described(const std::vector<MeasurementText>& all) {
  std::string text;
  for (const MeasurementText& m : all)
    text += m.name + "@" + at(m.location) + "=" + m.expression.text + "@" + at(m.expression.location) + "+-" +
            toml_number(m.sigma) + " ";
  return text;
}

std::string described(const std::vector<DirectionText>& all) {
  std::string text;
  for (const DirectionText& d : all)
    text += "[" + d.name + "@" + at(d.location) + " " + described(d.vehicle) + "| " + described(d.landmark) +
            "] ";
  return text;
}

std::string described(const std::vector<SparseRow>& all) {
  std::string text;
  for (const SparseRow& row : all)
    text += "[" + row.name + "@" + at(row.location) + " " + described(row.entries) + "] ";
  return text;
}

/// The equations with their locations, as text.
template <class T>
std::string without_location(const T& items) {
  static const std::regex location("@[0-9]+:[0-9]+");
  return std::regex_replace(described(items), location, "");
}

TEST(SystemFile, ReadsPlanarExactly) {
  const SystemText planar = load_system("planar");
  EXPECT_EQ(planar.file, "planar.toml");
  EXPECT_EQ(planar.name, "planar");
  EXPECT_EQ(planar.title, "vehicle on a plane, bearings");
  EXPECT_EQ(planar.source, "thesis (4.11), (4.12)");
  EXPECT_EQ(planar.representation, "world");
  EXPECT_EQ(planar.segment_duration_s, 1.0);
  EXPECT_TRUE(planar.parameters.empty());
  EXPECT_EQ(without_location(planar.inputs), "v=0.5..2.0 omega=-1.0..1.0 ");
  EXPECT_EQ(without_location(planar.vehicle.states), "x=v*cos(theta) y=v*sin(theta) theta=omega ");
  EXPECT_EQ(without_location(planar.vehicle.region), "x=-2.0..2.0 y=-2.0..2.0 theta=-3.0..3.0 ");
  EXPECT_TRUE(planar.vehicle.definitions.empty() && planar.vehicle.measurements.empty());
  ASSERT_TRUE(planar.landmark && planar.anchor);
  EXPECT_EQ(without_location(planar.landmark->states), "xf=0 yf=0 ");
  EXPECT_EQ(without_location(planar.landmark->region), "xf=3.0..9.0 yf=3.0..9.0 ");
  EXPECT_EQ(without_location(planar.landmark->definitions), "rx=xf - x ry=yf - y ");
  EXPECT_EQ(without_location(planar.landmark->measurements), "bearing=atan2(ry, rx) - theta+-0.01 ");
  EXPECT_TRUE(planar.anchor->states.empty());
  EXPECT_EQ(without_location(planar.anchor->region), "ax=-9.0..-3.0 ay=-9.0..9.0 ");
  EXPECT_EQ(without_location(planar.anchor->definitions), "bx=ax - x by=ay - y ");
  EXPECT_EQ(without_location(planar.anchor->measurements), "bearing=atan2(by, bx) - theta+-0.01 ");
  ASSERT_GE(planar.motions.size(), 2u);
  EXPECT_EQ(planar.motions[0].name, "straight");
  EXPECT_EQ(without_location(planar.motions[0].assignments), "omega=0 ");
  EXPECT_EQ(without_location(planar.motions[1].assignments), "v=0 omega=0 ");
  EXPECT_EQ(without_location(planar.directions),
            "[translation along x x=1 | xf=1 ] "
            "[translation along y y=1 | yf=1 ] "
            "[rotation x=-y y=x theta=1 | xf=-yf "
            "yf=xf ] "
            "[scale x=x y=y | xf=xf yf=yf ] ");
  EXPECT_EQ(without_location(planar.landmark_directions), "[depth | xf=rx yf=ry ] ");
  EXPECT_FALSE(planar.error_form);
}

TEST(SystemFile, ReadsEveryKey) {
  const SystemText cart = read_system(whole, "s.toml");
  EXPECT_EQ(cart.file, "s.toml");
  EXPECT_EQ(cart.segment_duration_s, 0.5);
  ASSERT_EQ(cart.parameters.size(), 1u);
  EXPECT_EQ(cart.parameters[0].name, "L");
  EXPECT_EQ(cart.parameters[0].value, 1.5);
  EXPECT_EQ(described(cart.vehicle.region), "x@18:1=-2.0..2.0 w@19:1=0.5..10.0 ");
  EXPECT_EQ(described(cart.vehicle.measurements), "place@21:1=x@21:10+-1.0 ");
  EXPECT_EQ(described(cart.anchor->measurements), "distance@37:1=s@37:20+-1.0 ");
  EXPECT_EQ(described(cart.motions[0].assignments), "v@39:1=u*half@39:6 x@40:1=-1.5@40:5 ");
  EXPECT_EQ(described(cart.motions[0].draws), "u@41:6=0.0..1.0 ");
  ASSERT_TRUE(cart.error_form);
  EXPECT_EQ(cart.error_form->source, "(1.2)");
  EXPECT_EQ(described(cart.error_form->names), "x@47:8=error of x@47:13 ");
  EXPECT_EQ(described(cart.error_form->directions), "[along x@52:19 x@53:1=1@53:5 | p@54:10=1@54:14 ] ");
  EXPECT_EQ(described(cart.error_form->landmark_directions), "[depth@59:28 | p@60:1=1@60:5 ] ");
  EXPECT_EQ(described(cart.vehicle.error_F), "[x@49:1 w@49:7=-0.1*L@49:12 ] ");
  EXPECT_EQ(described(cart.vehicle.error_H), "[place@51:1 x@51:11=1@51:15 ] ");
  EXPECT_EQ(described(cart.landmark->error_H), "[distance@56:1 p@56:14=1@56:18 x@56:21=-1@56:25 ] ");
  EXPECT_EQ(described(cart.landmark->error_F), "[p@58:1 ] ");
  EXPECT_EQ(described(cart.anchor->error_H), "[distance@62:1 x@62:14=-1@62:18 ] ");
}

TEST(SystemFile, AcceptsAMinimalFile) {
  const SystemText little =
      read_system("name = \"a\"\nstates.x = 0\nregion.x = [1, 1]\nmeasurements.z = \"x\"", "s.toml");
  EXPECT_EQ(little.title, "a");
  EXPECT_EQ(little.representation, "world");
  EXPECT_EQ(little.segment_duration_s, 1);
  EXPECT_FALSE(little.landmark || little.anchor || little.error_form);
}

TEST(SystemFile, EveryBuiltInSystemLoadsByName) {
  const std::vector<std::string> names = built_in_systems();
  EXPECT_GE(names.size(), 1u);
  for (const std::string& name : names) {
    const SystemText system = load_system(name);
    EXPECT_TRUE(name == system.name || name == system.name + "-" + system.representation) << name;
    EXPECT_EQ(load_system(name, system.representation).file, system.file);
    EXPECT_EQ(load_system(system.name, system.representation).file, system.file);
  }
}

/// The text at a location of the file is the one that was read from there.
void expect_there(const std::vector<std::string>& lines, const SourceLocation& location,
                  const std::string& text) {
  ASSERT_GE(location.line, 1) << text;
  const std::string& line = lines.at(static_cast<std::size_t>(location.line) - 1);
  EXPECT_EQ(line.substr(static_cast<std::size_t>(location.column) - 1, text.size()), text) << line;
}

TEST(SystemFile, LocationsAreThoseInTheFile) {
  for (const std::string& name : built_in_systems()) {
    const auto file = testing::lines(std::string(INCOGNITA_SOURCE_DIR) + "/systems/" + name + ".toml");
    const SystemText system = load_system(name);
    const auto expect_all_there = [&](const std::vector<NamedExpression>& all) {
      for (const NamedExpression& e : all) {
        expect_there(file, e.location, e.name);
        if (e.expression.text.find('\n') == std::string::npos)
          expect_there(file, e.expression.location, e.expression.text);
      }
    };
    for (const BlockText* block : {&system.vehicle, system.landmark ? &*system.landmark : nullptr}) {
      if (!block) continue;
      expect_all_there(block->states);
      expect_all_there(block->definitions);
      for (const MeasurementText& m : block->measurements)
        expect_there(file, m.expression.location, m.expression.text);
      for (const NamedRange& range : block->region) expect_there(file, range.location, range.name);
      for (const SparseRow& row : block->error_F) expect_all_there(row.entries);
    }
    for (const DirectionText& direction : system.directions) {
      expect_there(
          file, direction.location,
          direction.name.find(' ') == std::string::npos ? direction.name : '"' + direction.name + '"');
      expect_all_there(direction.landmark);
    }
  }
}

TEST(SystemFile, RepresentationIsSelectedOrRefused) {
  EXPECT_EQ(load_system("planar", "world").representation, "world");
  EXPECT_EQ(load_system("planar", "relative").file, "planar-relative.toml");
  EXPECT_EQ(load_system("planar-relative", "world").file, "planar.toml");
  EXPECT_EQ(message_of([] { load_system("cv6", "relative"); }),
            "cv6 is built in with the representation `world`, not `relative`");
  EXPECT_EQ(message_of([] { load_system("planar", "polar"); }),
            "the representation must be `world` or `relative`, not `polar`");
  const Scratch scratch;
  const std::string file = scratch.write("cart.toml", whole).string();
  EXPECT_EQ(load_system(file).file, file);
  EXPECT_EQ(load_system(file, "world").name, "cart");
  EXPECT_HAS(message_of([&] { load_system(file, "relative"); }),
             "cart.toml: has the representation `world`, not `relative`");
}

TEST(SystemFile, RefusesAMissingFile) {
  EXPECT_HAS(message_of([] { load_system("planer"); }),
             "planer: no such system file, nor a built-in system; built in are: ");
  for (const char* file : {"some/where/planer.toml", "planer.toml", "some/where"}) {
    const std::string message = message_of([&] { load_system(file); });
    EXPECT_HAS(message, std::string(file) + ": no such system file; built in, by their names alone, are: ");
    EXPECT_EQ(message.find("nearest"), std::string::npos) << message;
  }
  EXPECT_HAS(message_of([] { load_system("planer"); }), "the nearest is planar");
  const Scratch scratch;
  EXPECT_HAS(message_of([&] { load_system(scratch.folder().string()); }), "is a folder, not a file");
  const std::string large = scratch.write("large.toml", "#" + std::string(1 << 20, '-')).string();
  EXPECT_HAS(message_of([&] { load_system(large); }), "is larger than the 1048576 bytes allowed");
}

struct Fault {
  const char *part, *by, *message;
};

void expect_problems(std::initializer_list<Fault> problems) {
  for (const Fault& problem : problems) {
    const std::string message = complaint(with(problem.part, problem.by));
    EXPECT_TRUE(message.starts_with(problem.message))
        << problem.by << "\n  gives " << message << "\n  not   " << problem.message;
  }
}

TEST(SystemFile, RefusesInvalidKeysAndTypes) {
  expect_problems({
      {"name = \"cart\"\n", "", "s.toml: the system has no name; write name = \"...\" at the top"},
      {"name = \"cart\"", "name = 3", "s.toml:1:8: `name` must be a text, and is a whole number"},
      {"name = \"cart\"", "name = \"\"",
       "s.toml:1:8: `name` must be one line of 1 to 400 characters, and is empty"},
      {"\"cart on a line\"", "\"\"\"cart\non a line\"\"\"",
       "s.toml:2:9: `title` must be one line of 1 to 400 characters, and has a line break"},
      {"title", "titel", "s.toml:2:1: there is no section or key `titel`; the nearest is `title`"},
      {"[states]", "[state]", "s.toml:11:2: there is no section or key `state`; the nearest is `states`"},
      {"[landmark.states]", "[landmark.inputs]",
       "s.toml:22:11: there is no `landmark` key `inputs`; the nearest is "},
      {"[anchor.constants]", "[anchor.states]", "s.toml:32:9: there is no `anchor` key `states`"},
      {"[anchor.error.H]", "[anchor.error.F]", "s.toml:61:15: there is no `anchor.error` key `F`"},
      {"[error.F]", "[error.G]", "s.toml:48:8: there is no `error` key `G`; the nearest is `F`"},
      {"[landmark.error.F]", "[landmark.error.states]", "s.toml:57:17: there is no `landmark.error` key"},
      {"\"world\"", "\"globe\"",
       "s.toml:4:18: `representation` must be `world` or `relative`, and is `globe`"},
      {"= 0.5", "= 0", "s.toml:5:22: `segment_duration_s` must be more than 0, and is 0"},
      {"= 0.5", "= nan", "s.toml:5:22: `segment_duration_s` must be a finite number, and is nan"},
      {"L = 1.5", "L = \"1\"", "s.toml:8:5: `L` must be a finite number, and is \"1\""},
      {"L = 1.5", "L = -inf", "s.toml:8:5: `L` must be a finite number, and is -inf"},
      {"v = [-1, 1]", "v = [-1, 1, 2]",
       "s.toml:10:5: `v` must be a range, [lowest, highest], and has 3 entries"},
      {"v = [-1, 1]", "v = [1]", "s.toml:10:5: `v` must be a range, [lowest, highest], and has 1 entry"},
      {"v = [-1, 1]", "v = [-1, inf]", "s.toml:10:10: `v` must be a finite number, and is inf"},
      {"v = [-1, 1]", "v = [-1, true]", "s.toml:10:10: `v` must be a finite number, and is true"},
      {"v = [-1, 1]", "v = 1", "s.toml:10:5: `v` must be a range"},
      {"w = 0", "w = true", "s.toml:13:5: `w` must be an expression in quotes, and is true or false"},
      {"w = 0", "w = nan", "s.toml:13:5: `w` must be a finite number, and is nan"},
      {"w = 0", "w.v = 0", "s.toml:13:1: `w` must be an expression in quotes, and is a table"},
      {"sigma = 0.1", "sigma = 0", "s.toml:29:32: `sigma` must be more than 0, and is 0"},
      {"sigma = 0.1", "sigma = -inf", "s.toml:29:32: `sigma` must be a finite number, and is -inf"},
      {"sigma = 0.1", "sgima = 1",
       "s.toml:29:24: there is no `distance` key `sgima`; the nearest is `sigma`"},
      {"{ is = \"s\" }", "{ sigma = 1 }",
       "s.toml:37:1: measurement `distance` has no expression; write { is ="},
      {"x = { w = \"-0.1*L\" }", "x = 1", "s.toml:49:5: `x` must be a section, and is a whole number"},
      {"\"error of x\"", "1", "s.toml:47:12: `x` must be a text, and is a whole number"},
      {"[parameters]\nL = 1.5\n", "parameters = 1\n", "s.toml:7:14: `parameters` must be a section"},
  });
}

TEST(SystemFile, RefusesInvalidNames) {
  const std::string long_name(41, 'x');
  expect_problems({
      {"L = 1.5", "\"my L\" = 1.5", "s.toml:8:1: `my L` is not a name; a name is a letter followed by"},
      {"L = 1.5", "_L = 1.5", "s.toml:8:1: `_L` is not a name"},
      {"L = 1.5", "\"\" = 1.5", "s.toml:8:1: `` is not a name"},
      {"L = 1.5", "\"\\u001b[2J\" = 1.5", "s.toml:8:1: `?[2J` is not a name"},
      {"L = 1.5", (long_name + " = 1").c_str(), "s.toml:8:1: `xxxxxxxxxxx"},
      {"L = 1.5", "pi = 1.5", "s.toml:8:1: `pi` is reserved; choose another name"},
      {"L = 1.5", "I = 1.5", "s.toml:8:1: `I` is reserved"},
      {"L = 1.5", "tanh = 1.5", "s.toml:8:1: `tanh` is reserved"},
      {"L = 1.5", "draw = 1.5", "s.toml:8:1: `draw` is reserved"},
      {"v = [-1, 1]", "L = [-1, 1]", "s.toml:10:1: there is a parameter `L` already, in line 8"},
      {"half =", "w =", "s.toml:16:1: there is a state `w` already, in line 13"},
      {"[landmark.states]\np = 0\n[landmark.region]\np", "[landmark.states]\nx = 0\n[landmark.region]\nx",
       "s.toml:23:1: there is a state `x` already, in line 12"},
      {"r = \"p - x\"", "drag = \"p - x\"", "s.toml:27:1: there is a definition `drag` already, in line 15"},
      {"q = [-9, -3]", "v = [-9, -3]", "s.toml:33:1: there is an input `v` already, in line 10"},
      {"draw.u", "draw.w", "s.toml:41:6: there is a state `w` already, in line 13"},
      {"place = \"x\"", "\"the place\" = \"x\"", "s.toml:21:1: `the place` is not a name"},
      {"[motion.steady]", "[motion.general]", "s.toml:38:9: every system has the motion `general`"},
      {"[motion.steady]", "[motion.\"\"]",
       "s.toml:38:9: a name of 1 to 80 characters on one line is required"},
      {"[directions.\"along x\"]", "[directions.depth]",
       "s.toml:30:22: there is a direction `depth` already"},
  });
}

TEST(SystemFile, RefusesNamesReservedForLandmarkStates) {
  const std::string text =
      "name = \"s\"\n[states]\ny_1 = 0\n[region]\ny_1 = [0, 1]\n[landmark.states]\ny = 0\n"
      "[landmark.region]\ny = [0, 1]\n[landmark.measurements]\nz = \"y - y_1\"\n";
  try {
    read_system(text, "s.toml");
    FAIL() << "read";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "s.toml:3:1: `y_1` is the displayed name of state `y` of a landmark; choose another name");
  }
}

TEST(SystemFile, RefusesUnknownNames) {
  expect_problems({
      {"w = [0.5, 1e1]", "ww = [0.5, 1e1]", "s.toml:19:1: state `ww` has no equation; the nearest is `w`"},
      {"w = [0.5, 1e1]\n", "",
       "s.toml:13:1: state `w` has no region; write w = [lowest, highest] under [region]"},
      {"p = [3, 9]\n", "",
       "s.toml:23:1: state `p` has no region; write p = [lowest, highest] under [landmark.region]"},
      {"[states]\nx = \"v + drag\"\nw = 0\n", "",
       "s.toml:15:1: the region contains `x`, but there are no states; write x = \"its rate of change\" under "
       "[states]"},
      {"[landmark.region]\np", "[landmark.region]\nx", "s.toml:25:1: state `x` has no equation"},
      {"v = \"u*half\"", "L = \"u*half\"", "s.toml:39:1: there is no state or input `L`"},
      {"x = 1\nlandmark.p", "v = 1\nlandmark.p", "s.toml:43:1: there is no state `v`; the nearest is `x`"},
      {"landmark.p = \"r/r\"", "landmark.x = 1",
       "s.toml:44:10: there is no landmark state `x`; the nearest is"},
      {"depth]\np = \"r\"", "depth]\nx = 1", "s.toml:31:1: there is no landmark state `x`"},
      {"states.x", "states.v", "s.toml:47:8: there is no state `v`"},
      {"x = { w", "v = { w", "s.toml:49:1: there is no state `v`"},
      {"x = { w", "x = { p", "s.toml:49:7: there is no state `p`; the nearest is `x`"},
      {"place = { x", "plaice = { x",
       "s.toml:51:1: there is no measurement `plaice`; the nearest is `place`"},
      {"place = { x = 1 }\n", "", "s.toml:21:1: the error form has no row for measurement `place`"},
      {"{ p = 1, x = -1 }", "{ p = 1, q = -1 }", "s.toml:56:21: there is no state `q`"},
      {"p = {}", "x = {}", "s.toml:58:1: there is no state `x`; the nearest is `p`"},
  });
}

TEST(SystemFile, DisturbedStatesBelongToTheVehicle) {
  const auto disturbed = [](const std::string& list) {
    return with("segment_duration_s = 0.5", "segment_duration_s = 0.5\ndisturbed = " + list);
  };
  const SystemText cart = read_system(disturbed("[\"w\", 'x']"), "s.toml");
  ASSERT_EQ(cart.disturbed.size(), 2u);
  EXPECT_EQ(cart.disturbed[0].name, "w");
  EXPECT_EQ(at(cart.disturbed[1].location), "6:19");
  EXPECT_EQ(complaint(disturbed("[\"w\", \"v\"]")), "s.toml:6:19: there is no state `v`; the nearest is `x`");
  EXPECT_EQ(complaint(disturbed("[\"w\", \"w\"]")), "s.toml:6:19: `w` occurs twice");
  EXPECT_TRUE(complaint(disturbed("[\"w\", 1]")).starts_with("s.toml:6:13: `disturbed` must be a list of"));
  EXPECT_TRUE(complaint(disturbed("\"w\"")).starts_with("s.toml:6:13: `disturbed` must be a list of"));
}

TEST(SystemFile, RefusesInvalidRangesAndMissingEntries) {
  expect_problems({
      {"v = [-1, 1]", "v = [1, -1]", "s.toml:10:1: the range of `v` is empty; write [lowest, highest]"},
      {"v = [-1, 1]", "v = [-1.7e308, 1.7e308]", "s.toml:10:1: the range of `v` must be finite"},
      {"q = [-9, -3]", "q = [-3, -9]", "s.toml:33:1: the range of `q` is empty"},
      {"draw.u = [0, 1]", "draw.u = [1, 0]", "s.toml:41:6: the range of `u` is empty"},
      {"p = 0\n", "", "s.toml: a landmark needs a state; a landmark with known position is an anchor"},
      {"x = 1\nlandmark.p = \"r/r\"\n", "", "s.toml:42:13: direction `along x` is empty"},
  });
  EXPECT_EQ(complaint("name = \"a\""),
            "s.toml: the system has no states; write x = \"its rate of change\" under [states]");
  EXPECT_HAS(complaint("name = \"a\"\nstates.x = 0\nregion.x = [0, 1]\n"),
             "s.toml: the system has no measurement; write one under [measurements], ");
}

TEST(SystemFile, LocatesInvalidExpressions) {
  expect_problems({
      {"\"v + drag\"", "\"v + darg\"", "s.toml:12:10: there is no `darg` in the scope of this expression"},
      {"\"v + drag\"", "'v + * drag'", "s.toml:12:10: an operand is missing between `+` and `*`"},
      {"\"v + drag\"", "\"v + r\"", "s.toml:12:10: there is no `r` in the scope of this expression"},
      {"\"-0.1*w*L\"", "\"half\"", "s.toml:15:9: there is no `half` in the scope of this expression"},
      {"w = 0", "w = 1e305", "s.toml:13:5: a number's exponent is at most 300"},
      {"w = 0", "w = \"\"", "s.toml:13:6: the expression is empty"},
      {"\"r\", sigma", "\"r**2\", sigma", "s.toml:29:21: write a power with ^, not **"},
      {"\"p - x\"", "\"p - q\"", "s.toml:27:10: there is no `q` in the scope of this expression"},
      {"\"q - x\"", "\"p - x\"", "s.toml:35:6: there is no `p` in the scope of this expression"},
      {"\"u*half\"", "\"u*p\"", "s.toml:39:8: there is no `p` in the scope of this expression"},
      {"x = -1.5", "x = \"2x\"", "s.toml:40:7: an operation is missing before `x`"},
      {"x = 1\nlandmark.p", "x = \"r\"\nlandmark.p",
       "s.toml:43:6: there is no `r` in the scope of this expression"},
      {"\"r/r\"", "\"r/\"", "s.toml:44:16: an operand is missing after `/`"},
      {"\"-0.1*L\"", "\"-0.1*p\"", "s.toml:49:17: there is no `p` in the scope of this expression"},
      {"\"error of x\"", "\"\"", "s.toml:47:12: `x` must be one line of 1 to 400 characters"},
      // With escapes or several lines the location is that of the opening quote
      {"\"v + drag\"", "\"\"\"\nv +\n  darg\"\"\"", "s.toml:12:5: there is no `darg`"},
      {"\"v + drag\"\nw = 0", "\"\"\"\nv +\n  drag\"\"\"\nw = \"zz\"", "s.toml:15:6: there is no `zz`"},
  });
}

TEST(SystemFile, RefusesTooManyEntries) {
  const auto many = [](const std::string& name, int count, const std::string& value) {
    std::string text;
    for (int i = 0; i < count; ++i) text += name + std::to_string(i) + value + "\n";
    return text;
  };
  const auto complaint_of = [](const std::string& part, const std::string& more) {
    return complaint(with(part, part + more));
  };
  EXPECT_HAS(complaint_of("[states]\n", many("k", 63, " = 0")),
             "s.toml:76:1: there are 65 states; at most 64 are allowed");
  EXPECT_HAS(complaint_of("[measurements]\n", many("k", 64, " = 0")), "there are 65 measurements");
  EXPECT_HAS(complaint_of("[definitions]\n", many("k", 255, " = 0")), "there are 257 definitions");
  EXPECT_HAS(complaint_of("[parameters]\n", many("k", 256, " = 0")), "there are 257 parameters");
  EXPECT_HAS(complaint_of("[inputs]\n", many("k", 64, " = [0, 1]")), "there are 65 inputs");
  EXPECT_HAS(complaint_of("[anchor.constants]\n", many("k", 64, " = [0, 1]")), "there are 65 constants");
  EXPECT_HAS(complaint_of("half = \"drag/2\"\n", many("[motion.k", 64, "]")), "there are 65 motions");
  EXPECT_HAS(complaint_of("half = \"drag/2\"\n", many("[directions.k", 64, "]")), "there are 65 directions");
  EXPECT_HAS(complaint_of("half = \"drag/2\"\n", "[motion.z.draw]\n" + many("k", 65, " = [0, 1]")),
             "there are 65 draws");
  EXPECT_HAS(complaint(whole + "#" + std::string(1 << 20, '-')), "bytes are too many");
}

TEST(SystemFile, RefusesInvalidToml) {
  EXPECT_HAS(complaint("name = \"a\"\nstates = {\n"), "s.toml:2:11: not valid TOML: ");
  EXPECT_EQ(complaint(with("w = 0", "x = 0")),
            "s.toml:13:5: not valid TOML: there is a key `x` already in this section; keep one of them");
  EXPECT_EQ(complaint(whole + "[states]\nq = 0\n"),
            "s.toml:63:1: not valid TOML: there is a section or key `states` already; write all of it in one "
            "place");
  EXPECT_HAS(complaint(std::string("name = \"a\0\"", 11)), "s.toml:1:");
  EXPECT_HAS(complaint("name = \"\xff\""), "s.toml:1:");
}

TEST(DamagedSystem, IsReadOrRefused) {
  for (const std::string& text :
       {whole, contents(std::string(INCOGNITA_SOURCE_DIR) + "/systems/planar.toml")}) {
    const int fine = testing::still_read(text, 1500, [](const std::string& damaged) {
      const SystemText system = read_system(damaged, "s.toml");
      EXPECT_FALSE(system.name.empty());
      EXPECT_TRUE(std::isfinite(system.segment_duration_s) && system.segment_duration_s > 0);
      EXPECT_EQ(system.vehicle.region.size(), system.vehicle.states.size());
    });
    EXPECT_GT(fine, 30);
    EXPECT_LT(fine, 1400);
  }
}

}  // namespace
}  // namespace incognita
