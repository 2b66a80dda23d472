#include "incognita/record/files/tum.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include "incognita/math/time_stamp.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/number.hpp"

namespace incognita {
namespace {

constexpr std::size_t max_line_bytes = 64 * 1024;
constexpr std::size_t shown_bytes = 40;

/// A line of a file and its position, for messages.
struct Line {
  const std::filesystem::path& file;
  int number = 0;
  std::string text;

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("{}:{}: {}", file.string(), number, why));
  }
};

/// Printable form of arbitrary input, for messages.
std::string shown(std::string_view word) {
  std::string text;
  for (const char c : word.substr(0, shown_bytes)) text += c >= ' ' && c <= '~' ? c : '?';
  return word.size() > shown_bytes ? text + "..." : text;
}

/// Reads a bounded number of bytes: a file without line breaks could be endless.
bool next_line(std::istream& in, Line& line) {
  constexpr int end = std::char_traits<char>::eof();
  line.text.clear();
  int c = in.rdbuf()->sbumpc();
  if (c == end) return false;
  ++line.number;
  for (; c != end && c != '\n'; c = in.rdbuf()->sbumpc()) {
    if (line.text.size() == max_line_bytes)
      line.refuse(fmt::format("a line of more than {} bytes; is this a text file?", max_line_bytes));
    line.text.push_back(static_cast<char>(c));
  }
  if (line.number == 1 && line.text.starts_with("\xEF\xBB\xBF")) line.text.erase(0, 3);
  return true;
}

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> found;
  constexpr std::string_view separators = " \t\r,;";
  for (std::size_t i = text.find_first_not_of(separators); i != std::string_view::npos;) {
    const std::size_t end = text.find_first_of(separators, i);
    found.push_back(text.substr(i, end == std::string_view::npos ? end : end - i));
    i = end == std::string_view::npos ? end : text.find_first_not_of(separators, end);
  }
  return found;
}

double finite_number(const Line& line, std::string_view word) {
  const auto value = parse_number(word);
  if (!value) line.refuse(fmt::format("`{}` is not a number", shown(word)));
  if (!std::isfinite(*value))
    line.refuse(fmt::format("`{}` is not a finite number; leave such rows out", shown(word)));
  return *value;
}

double seconds_of(const Line& line, std::string_view word) {
  if (const auto t = seconds_from_nanoseconds(word)) return *t;
  line.refuse(fmt::format("`{}` is not a time stamp in whole nanoseconds", shown(word)));
}

Eigen::Vector4d unit_quaternion(const Line& line, const Eigen::Vector4d& q) {
  const double length = q.norm();
  if (std::abs(length - 1) > 0.01)
    line.refuse(fmt::format("the quaternion has length {:.6g}, not 1; the columns must be {}", length,
                            "t x y z qx qy qz qw (TUM), or EuRoC's with its #timestamp header"));
  return q / length;
}

StampedPose tum_pose(const Line& line, std::span<const std::string_view> cells) {
  if (cells.size() != 8)
    line.refuse(fmt::format("{} columns, 8 are needed: t x y z qx qy qz qw", cells.size()));
  double v[8];
  for (std::size_t i = 0; i < 8; ++i) v[i] = finite_number(line, cells[i]);
  return {v[0], {v[1], v[2], v[3]}, unit_quaternion(line, {v[7], v[4], v[5], v[6]})};
}

StampedPose euroc_pose(const Line& line, std::span<const std::string_view> cells) {
  if (cells.size() < 8)
    line.refuse(fmt::format("{} columns, at least 8 are needed: timestamp x y z qw qx qy qz", cells.size()));
  double v[8];
  for (std::size_t i = 1; i < 8; ++i) v[i] = finite_number(line, cells[i]);
  return {seconds_of(line, cells[0]), {v[1], v[2], v[3]}, unit_quaternion(line, {v[4], v[5], v[6], v[7]})};
}

/// The kind of a line with column names.
enum class Header { none, tum, euroc };

/// The order of the named quaternion components decides: TUM's `# timestamp tx ty tz qx qy qz qw` has w last,
/// EuRoC's `#timestamp [ns],p_RS_R_x [m],...,q_RS_w [],q_RS_x []...` has w first. Either may be separated by commas.
Header header_of(std::string_view text) {
  const std::size_t first = text.find_first_not_of("# \t");
  if (first == std::string_view::npos || !text.substr(first).starts_with("timestamp")) return Header::none;
  const std::size_t x = text.find("qx"), w = text.find("qw"), none = std::string_view::npos;
  if (x != none && w != none) return x < w ? Header::tum : Header::euroc;
  if (text.find("tx") != none) return Header::tum;
  return text.find(',') == none ? Header::none : Header::euroc;
}

std::ifstream open_text(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) throw InputError(path.string() + ": is a folder, not a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path.string() + ": cannot be read; is the name right?");
  return in;
}

}  // namespace

Trajectory read_trajectory(const std::filesystem::path& path) {
  std::ifstream in = open_text(path);
  Trajectory trajectory;
  bool euroc = false, oriented = true;
  for (Line line{path, 0, {}}; next_line(in, line);) {
    if (const Header header = header_of(line.text); trajectory.empty() && header != Header::none) {
      euroc = header == Header::euroc;
      continue;
    }
    const auto cells = words(line.text);
    if (!cells.empty() && cells.front().starts_with('#'))
      oriented = oriented && line.text.find("orientation is not known") == std::string::npos;
    if (cells.empty() || cells.front().starts_with('#')) continue;
    trajectory.push_back(euroc ? euroc_pose(line, cells) : tum_pose(line, cells));
  }
  if (trajectory.empty())
    throw InputError(path.string() + ": no pose in it; rows of t x y z qx qy qz qw are needed");
  for (StampedPose& pose : trajectory) pose.oriented = oriented;
  return trajectory;
}

std::vector<StampedCovariance> read_covariances(const std::filesystem::path& path) {
  std::ifstream in = open_text(path);
  std::vector<StampedCovariance> covariances;
  for (Line line{path, 0, {}}; next_line(in, line);) {
    const auto cells = words(line.text);
    if (cells.empty() || cells.front().starts_with('#') || (line.number == 1 && cells.front() == "t"))
      continue;
    if (cells.size() != 37)
      line.refuse(fmt::format("{} columns, 37 are needed: t and a 6x6 covariance, row by row", cells.size()));
    StampedCovariance row;
    row.t = finite_number(line, cells[0]);
    for (int i = 0; i < 36; ++i) row.covariance(i / 6, i % 6) = finite_number(line, cells[i + 1]);
    covariances.push_back(row);
  }
  return covariances;
}

}  // namespace incognita
