#include "incognita/io/formats/path_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "incognita/io/formats/named_table.hpp"
#include "incognita/math/nearest_name.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr double farthest_m = 1e6, latest_s = 1e10, shortest_s = 1e-6;
const std::vector<std::string> known = {"t", "x", "y", "z", "heading"};

void refuse_unknown(const NamedTable& table) {
  for (const std::string& column : table.columns()) {
    if (std::find(known.begin(), known.end(), column) != known.end()) continue;
    throw InputError(
        fmt::format("{}: a path has no column `{}`; the nearest is `{}`. Its columns are "
                    "t,x,y[,z[,heading]], named in the first line and separated by commas: remove the others",
                    table.header(), column.substr(0, 60), nearest_name(column, known)));
  }
}

double within(const NamedTable& table, std::size_t row, std::size_t column, double largest) {
  const double value = table.finite(row, column);
  if (std::abs(value) <= largest) return value;
  throw InputError(
      fmt::format("{}: `{}` is {}, and may be {:g} at most: t is in s, x, y and z are in m, heading in rad",
                  table.where(row), table.columns()[column], value, largest));
}

void expect_later(const NamedTable& table, std::size_t row, const std::vector<double>& t) {
  if (row == 0 || t[row] - t[row - 1] >= shortest_s) return;
  throw InputError(fmt::format(
      "{}: t = {} must be later than {} in the row before, by {:g} s or more; sort the rows by time and remove duplicates",
      table.where(row), t[row], t[row - 1], shortest_s));
}

}  // namespace

PathSamples read_path(const std::filesystem::path& file) {
  const NamedTable table(file);
  refuse_unknown(table);
  const std::size_t t = table.column("t"), x = table.column("x"), y = table.column("y");
  const auto z = table.find("z"), heading = table.find("heading");
  PathSamples samples;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    samples.t.push_back(within(table, row, t, latest_s));
    expect_later(table, row, samples.t);
    samples.position.emplace_back(within(table, row, x, farthest_m), within(table, row, y, farthest_m),
                                  z ? within(table, row, *z, farthest_m) : 0.0);
    if (heading) samples.heading.push_back(within(table, row, *heading, farthest_m));
  }
  if (samples.t.size() >= 2) return samples;
  throw InputError(fmt::format("{}: a path needs two rows or more; for a fixed position use a point path",
                               table.where(0)));
}

}  // namespace incognita
