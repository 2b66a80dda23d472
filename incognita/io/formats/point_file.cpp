#include "incognita/io/formats/point_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "incognita/io/formats/named_table.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr double farthest_point_m = 1e6;

double coordinate(const NamedTable& table, std::size_t row, std::size_t column) {
  const double value = table.finite(row, column);
  if (std::abs(value) <= farthest_point_m) return value;
  throw InputError(fmt::format("{}: `{}` is {}, and may be {:g} m at most", table.where(row),
                               table.columns()[column], value, farthest_point_m));
}

}  // namespace

std::map<std::int64_t, Eigen::Vector3d> read_points(const std::filesystem::path& file) {
  const NamedTable table(file);
  const std::size_t id = table.column("id"), x = table.column("x"), y = table.column("y");
  const auto z = table.find("z");
  std::map<std::int64_t, Eigen::Vector3d> points;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.empty(row, id)) throw InputError(table.where(row) + ": a landmark needs an id");
    const std::int64_t identity = table.identity(row, id);
    const Eigen::Vector3d position(coordinate(table, row, x), coordinate(table, row, y),
                                   z ? coordinate(table, row, *z) : 0.0);
    if (!points.emplace(identity, position).second)
      throw InputError(fmt::format("{}: landmark {} occurs twice", table.where(row), identity));
  }
  return points;
}

}  // namespace incognita
