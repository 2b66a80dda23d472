#include "incognita/report/plot.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/csv_table.hpp"
#include "tests/record/file_size_limit.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

namespace fs = std::filesystem;
using testing::contents;
using testing::Scratch;
using namespace std::string_literals;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

Plot plot_of(std::vector<Curve> curves) {
  Plot plot;
  plot.id = "fig-1";
  plot.panels.resize(1);
  plot.panels[0].curves = std::move(curves);
  return plot;
}

/// A panel of each kind, a curve of each style.
Plot everything() {
  Plot plot = plot_of({{"band", Style::band, {0, 1, 2}, {-1, -1, -1}, {1, 2, 1}},
                       {"line", Style::line, {0, 1, 2}, {0.1, 1. / 3, 0}},
                       {"dashed", Style::dashed, {0, 2}, {1, 0}, {}, Color::pink},
                       {"", Style::thin, {0, 2}, {0, 1}},
                       over_steps("steps", {1, 2, 3}, Style::steps, 1)});
  Panel map;
  map.equal_axes = true;
  map.curves = {{"seen", Style::circles, {0, 1}, {0, 1}},
                {"known", Style::crosses, {0, 1}, {1, 0}},
                {"true", Style::stars, {0.5}, {0.5}},
                {"cloud", Style::points, {0.2, 0.3}, {0.5, 0.6}},
                ellipses("2 sigma", {{0, 1}}, {Eigen::Matrix2d::Identity()})};
  Panel gain;
  gain.log_y = true;
  gain.y_range = {{1e-3, 1}};
  gain.curves = {over_steps("gain", {1, 0.1, 0})};
  Panel net;
  net.surfaces = {{"net", {0, 1, 2}, {0, 1}, {1, 2, 3, 4, nan, 6}}};
  plot.panels.insert(plot.panels.end(), {map, gain, net});
  plot.columns = 2;
  plot.title = "everything";
  return plot;
}

/// Draws the plot and requires a picture.
std::string drawn(const Scratch& scratch, const Plot& plot) {
  std::vector<std::string> warnings;
  const LedgerFigure figure = draw_plot(scratch.folder(), plot, &warnings);
  EXPECT_EQ(warnings, std::vector<std::string>{});
  const std::string svg = contents(scratch / figure.file);
  EXPECT_HAS(svg, "</svg>");
  return svg;
}

std::string script(const Scratch& scratch) { return contents(scratch / "figures/fig-1.gp"); }

TEST(Plot, DrawsEveryKindOfPanelAndCurve) {
  const Scratch scratch;
  const std::string svg = drawn(scratch, everything());
  for (const char* label : {"everything", "band", "line", "dashed", "steps", "seen", "cloud", "gain", "net"})
    EXPECT_HAS(svg, ">" + std::string(label) + "<");
  const LedgerFigure figure = draw_plot(scratch.folder(), everything(), nullptr);
  EXPECT_EQ(figure.id, "fig-1");
  EXPECT_EQ(figure.file, "figures/fig-1.svg");
  EXPECT_EQ(figure.data, "figures/fig-1.csv");
}

TEST(Plot, SameNumbersSameBytes) {
  const Scratch one, two;
  EXPECT_EQ(drawn(one, everything()), drawn(two, everything()));
  for (const char* file : {"figures/fig-1.csv", "figures/fig-1.gp"})
    EXPECT_EQ(contents(one / file), contents(two / file));
}

TEST(Plot, TableHasEveryNumber) {
  const Scratch scratch;
  drawn(scratch, everything());
  const CsvTable table = read_csv(scratch / "figures/fig-1.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"panel", "curve", "x", "y", "y2_or_z", "label"}));
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"1", "1", "0", "-1", "1", "band"}));
  EXPECT_EQ(table.rows[4], (std::vector<std::string>{"1", "2", "1", "0.3333333333333333", "", "line"}));
  EXPECT_EQ(table.rows[10],
            (std::vector<std::string>{"1", "5", "1", "1", "", "steps"}));  // indices from `first`
  EXPECT_EQ(table.rows.back(), (std::vector<std::string>{"4", "1", "2", "1", "6", "net"}));
  EXPECT_EQ(table.rows[table.rows.size() - 2][4], "nan");
}

TEST(Plot, ScriptSelectsTheRowsOfEachCurve) {
  const Scratch scratch;
  drawn(scratch, everything());
  const std::string text = script(scratch);
  EXPECT_HAS(text, "data = 'figures/fig-1.csv'");
  EXPECT_HAS(text, "data skip 1 every ::0::2 using 3:4:5 with filledcurves fillcolor rgb blue");
  EXPECT_HAS(text, "data skip 1 every ::3::5 using 3:4 with lines linecolor rgb orange");
  EXPECT_HAS(
      text, "every ::6::7 using 3:4 with lines linecolor rgb pink linewidth 1.3 dashtype 2 title \"dashed\"");
  EXPECT_HAS(text, "every ::8::9 using 3:4 with lines linecolor rgb green linewidth 0.6 notitle");
  EXPECT_HAS(text, "every ::10::12 using 3:4 with steps");
  EXPECT_HAS(text, "set size ratio -1\nset xtics 1\nset ytics 1\n");
  EXPECT_HAS(text, "set logscale y");
  EXPECT_HAS(text, "set yrange [0.001:1]");
  EXPECT_HAS(text, "set multiplot layout 2,2 title \"everything\"");
}

TEST(Plot, NamesMayReplaceNumbers) {
  const Scratch scratch;
  Plot plot = plot_of({{"chosen", Style::steps, {0, 1, 2}, {1, 0, 1}}});
  plot.panels.push_back(plot.panels.front());
  plot.panels.front().y_names = {"stay", "go \"up\""};
  drawn(scratch, plot);
  const std::string text = script(scratch);
  EXPECT_HAS(text, R"(set ytics ("stay" 0, "go \042up\042" 1))");
  EXPECT_LT(text.find("set ytics ("), text.rfind("set ytics autofreq")) << "of one panel only";
}

/// Tics depend on the displayed range, not on values outside.
TEST(Plot, EqualRangesHaveEqualTics) {
  const Scratch scratch;
  Plot plot = plot_of({{"path", Style::line, {0, 55}, {12, 14.5}}});
  plot.panels[0].equal_axes = true;
  Panel shown;
  shown.equal_axes = true;
  shown.x_range = shown.y_range = {{-3.2, 3.2}};
  shown.curves = {{"far away", Style::line, {0, 40}, {0, 1}}};
  Panel net;
  net.surfaces = {{"net", {0, 1, 2}, {0, 1}, {1, 2, 3, 4, 5, 6}}};
  plot.panels.insert(plot.panels.end(), {shown, net});
  drawn(scratch, plot);
  const std::string text = script(scratch);
  EXPECT_HAS(text, "set yrange [*:*]\nset size ratio -1\nset xtics 10\nset ytics 10\n");
  EXPECT_HAS(text, "set yrange [-3.2:3.2]\nset size ratio -1\nset xtics 2\nset ytics 2\n");
  const std::size_t reset = text.rfind("set xtics autofreq\n");
  ASSERT_NE(reset, std::string::npos);
  EXPECT_LT(text.rfind("set xtics 2\n"), reset) << "not those of the previous panel";
}

TEST(Plot, OfOnePointHasTics) {
  const Scratch scratch;
  Plot plot = plot_of({{"one", Style::stars, {1e6}, {5}}});
  plot.panels[0].equal_axes = true;
  drawn(scratch, plot);
  EXPECT_HAS(script(scratch), "set size ratio -1\nset xtics 1\nset ytics 1\n");
}

TEST(Plot, NonFiniteValuesAreGaps) {
  const Scratch scratch;
  const std::string svg =
      drawn(scratch, plot_of({{"a", Style::line, {0, 1, 2, 3, 4, 5}, {nan, 1, 2, inf, 1, 2}},
                              {"b", Style::band, {0, 1, 2}, {0, nan, 0}, {1, nan, 1}}}));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_HAS(contents(scratch / "figures/fig-1.csv"), "1,1,0,nan,,a\n");
}

TEST(Plot, WithoutDataAxesAndKeyRemain) {
  const Scratch scratch;
  Plot plot = plot_of({{"none", Style::line, {}, {}}, {"unknown", Style::points, {0, 1}, {nan, nan}}});
  EXPECT_HAS(drawn(scratch, plot), ">unknown<");
  plot.panels[0].log_y = true;
  plot.panels[0].curves = {{"below", Style::line, {0, 1}, {0, -1}}};
  EXPECT_HAS(drawn(scratch, plot), ">below<");
  plot.panels[0] = Panel{};
  drawn(scratch, plot);
  plot.panels[0].surfaces = {{"hole", {0, 1}, {0, 1}, {nan, nan, nan, nan}}};
  drawn(scratch, plot);
  drawn(scratch, plot_of({{"a point", Style::line, {1}, {0}}}));
}

TEST(Plot, LabelsAreLiteralText) {
  const Scratch scratch;
  for (const std::string& label :
       {"it's \"1\", s_v^2 {x} \\ `touch hacked`7 @data"s, "'; system('touch hacked'); '"s,
        "\"; system(\"touch hacked\"); \""s, "\\"s, "'"s, "\"7"s, "`"s, "100% #1"s}) {
    Plot plot = plot_of({{label, Style::line, {0, 1}, {0, 1}}});
    plot.title = plot.panels[0].title = plot.panels[0].x_label = label;
    EXPECT_HAS(drawn(scratch, plot), "<text>" + label + "</text>");
    EXPECT_EQ(read_csv(scratch / "figures/fig-1.csv").rows[0][5], label);
    EXPECT_FALSE(fs::exists(scratch / "hacked"));
  }
  EXPECT_HAS(drawn(scratch, plot_of({{"two\nlines, <a & b", Style::line, {0}, {0}}})),
             "<text>two lines, &lt;a &amp; b<");
  EXPECT_EQ(testing::lines(scratch / "figures/fig-1.csv").size(), 2u);
}

TEST(Plot, WithoutGnuplotTableAndScriptRemain) {
  const Scratch scratch;
  drawn(scratch, everything());
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  std::vector<std::string> warnings;
  draw_plot(scratch.folder(), everything(), &warnings);
  draw_plot(scratch.folder(), everything(), &warnings);
  draw_plot(scratch.folder(), everything(), nullptr);
  ::setenv("PATH", path.c_str(), 1);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_HAS(warnings[0], "gnuplot is not installed");
  EXPECT_TRUE(fs::exists(scratch / "figures/fig-1.csv"));
  EXPECT_TRUE(fs::exists(scratch / "figures/fig-1.gp"));
  EXPECT_FALSE(fs::exists(scratch / "figures/fig-1.svg"));  // an old picture would show other numbers
}

TEST(Plot, RefusesInvalidFigures) {
  const Scratch scratch;
  const auto refused = [&](const Plot& plot) {
    return testing::message_of<std::invalid_argument>([&] { draw_plot(scratch.folder(), plot, nullptr); });
  };
  EXPECT_HAS(refused(plot_of({{"a", Style::line, {0, 1}, {0}}})), "`a` has 2 x, 1 y and 0 y2");
  EXPECT_HAS(refused(plot_of({{"a", Style::band, {0}, {0}}})), "1 x, 1 y and 0 y2");
  EXPECT_HAS(refused(plot_of({{"a", Style::line, {0}, {0}, {0}}})), "1 x, 1 y and 1 y2");
  Plot plot = everything();
  plot.panels[3].surfaces[0].z.pop_back();
  EXPECT_HAS(refused(plot), "`net` has 3 x, 2 y and 5 z");
  plot = everything();
  plot.panels[3].curves.push_back(over_steps("", {1}));
  EXPECT_HAS(refused(plot), "surfaces");
  plot = everything();
  plot.panels[2].y_range = {{0, 1}};
  EXPECT_HAS(refused(plot), "a range from 0 to 1");
  for (const char* id : {"", "../up", "a b", "a'b", ".hidden"}) {
    plot.id = id;
    EXPECT_HAS(refused(plot), "id") << id;
  }
  EXPECT_TRUE(fs::is_empty(scratch.folder()));
}

TEST(Plot, OnAFullDiskLeavesNoPartialFile) {
  const Scratch scratch;
  const testing::FileSizeLimit limit(500);
  EXPECT_THROW(draw_plot(scratch.folder(), everything(), nullptr), RecordError);
  EXPECT_TRUE(fs::is_empty(scratch / "figures"));
}

TEST(Plot, EllipsesHaveTheirPosition) {
  Eigen::Matrix2d covariance;
  covariance << 4, 0, 0, 1;
  const Curve curve = ellipses("e", {{1, 2}, {5, 5}}, {covariance, Eigen::Matrix2d::Zero()}, 3);
  ASSERT_EQ(curve.x.size(), 100u);
  for (std::size_t i = 0; i < 49; ++i)
    EXPECT_NEAR(std::pow((curve.x[i] - 1) / 6, 2) + std::pow((curve.y[i] - 2) / 3, 2), 1, 1e-12);
  EXPECT_EQ(curve.x[0], curve.x[48]);  // closed
  EXPECT_TRUE(std::isnan(curve.x[49]));
  EXPECT_EQ(curve.x[60], 5);
  EXPECT_THROW(ellipses("e", {{1, 2}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace incognita
