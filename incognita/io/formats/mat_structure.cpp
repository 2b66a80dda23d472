#include "incognita/io/formats/mat_structure.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

// Constants of the format, see MathWorks' "MAT-File Format".
enum Type : std::uint32_t { int8 = 1, int32 = 5, uint32 = 6, matrix = 14, compressed = 15 };
enum Class : std::uint32_t { characters = 4, first_number = 6, last_number = 15 };
constexpr std::size_t header_size = 128;
constexpr std::size_t version_at = 124;
constexpr std::uint16_t level_5 = 0x0100;
constexpr std::uint32_t complex_bit = 0x0800;

/// Bytes per number of a type; 0 for a non-numeric type.
std::size_t width(std::uint32_t type) {
  constexpr std::size_t widths[] = {0, 1, 1, 2, 2, 4, 4, 4, 0, 8, 0, 0, 8, 8};
  return type < std::size(widths) ? widths[type] : 0;
}

struct Element {
  std::uint32_t type = 0;
  std::string_view data;
};

/// Successive elements, each with a tag and data.
class Elements {
 public:
  Elements(std::string_view bytes, bool swapped) : rest_(bytes), swapped_(swapped) {}

  bool at_end() const { return rest_.empty(); }

  std::uint32_t word(std::string_view bytes, std::size_t i) const {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + 4 * i, sizeof value);
    return swapped_ ? __builtin_bswap32(value) : value;
  }

  /// nullopt if the tag or its data exceed the end.
  std::optional<Element> next(bool padded) {
    if (rest_.size() < 8) return std::nullopt;
    const std::uint32_t first = word(rest_, 0);
    if (first >> 16 != 0) return take_small(first);
    const std::size_t size = word(rest_, 1), aligned = padded ? (size + 7) / 8 * 8 : size;
    if (aligned > rest_.size() - 8) return std::nullopt;
    const Element element{first, rest_.substr(8, size)};
    rest_.remove_prefix(8 + aligned);
    return element;
  }

 private:
  /// Small element: up to four bytes of data within the eight bytes of the tag.
  std::optional<Element> take_small(std::uint32_t first) {
    const std::size_t size = first >> 16;
    if (size > 4) return std::nullopt;
    const Element element{first & 0xffff, rest_.substr(4, size)};
    rest_.remove_prefix(8);
    return element;
  }

  std::string_view rest_;
  bool swapped_;
};

/// Number of elements of a matrix with these dimensions; nullopt on overflow.
std::optional<std::size_t> count(const Elements& elements, std::string_view dimensions) {
  std::size_t product = 1;
  for (std::size_t i = 0; i < dimensions.size() / 4; ++i) {
    const std::size_t size = elements.word(dimensions, i);
    if (size != 0 && product > std::numeric_limits<std::uint32_t>::max() / size) return std::nullopt;
    product *= size;
  }
  return product;
}

bool holds(const std::optional<Element>& element, std::size_t numbers) {
  return element && width(element->type) > 0 && element->data.size() == numbers * width(element->type);
}

/// The problem of a variable; empty if it is valid.
std::string wrong_in_matrix(std::string_view bytes, bool swapped) {
  Elements parts(bytes, swapped);
  const auto flags = parts.next(true), dimensions = parts.next(true), name = parts.next(true);
  if (!flags || flags->type != uint32 || flags->data.size() != 8) return "has no valid flags";
  if (!dimensions || dimensions->type != int32 || dimensions->data.size() < 8 ||
      dimensions->data.size() % 4 != 0) {
    return "has no valid dimensions";
  }
  if (!name || name->type != int8) return "has no valid name";
  const std::uint32_t kind = parts.word(flags->data, 0) & 0xff;
  if (kind == characters) return "";
  if (kind < first_number || kind > last_number) {
    return fmt::format("`{}` is not a numeric matrix (class {}); save the file without it",
                       name->data.substr(0, 63), kind);
  }
  const auto numbers = count(parts, dimensions->data);
  const bool is_complex = parts.word(flags->data, 0) & complex_bit;
  bool whole = numbers && holds(parts.next(true), *numbers);
  if (whole && is_complex) whole = holds(parts.next(true), *numbers);
  return whole ? "" : fmt::format("`{}` has fewer numbers than its size requires", name->data.substr(0, 63));
}

/// Whether the file has the opposite byte order; throws unless it is a level-5 file.
bool check_header(std::string_view bytes, const std::string& file) {
  std::uint16_t version = 0;
  const std::string_view order = bytes.size() < header_size ? "" : bytes.substr(version_at + 2, 2);
  if (order == "IM" || order == "MI") std::memcpy(&version, bytes.data() + version_at, sizeof version);
  const bool swapped = (order == "IM") != (std::endian::native == std::endian::little);
  if (swapped) version = __builtin_bswap16(version);
  if (version == level_5) return swapped;
  throw InputError(file + ": is not a MAT file of level 5; MATLAB and Octave write one with save -v6 or -v7");
}

}  // namespace

void check_mat_structure(std::string_view bytes, const std::string& file) {
  const bool swapped = check_header(bytes, file);
  Elements variables(bytes.substr(header_size), swapped);
  for (int number = 1; !variables.at_end(); ++number) {
    const auto variable = variables.next(false);
    if (!variable)
      throw InputError(fmt::format("{}: is truncated in variable {}; copy it again", file, number));
    std::string wrong;
    if (variable->type == matrix) wrong = wrong_in_matrix(variable->data, swapped);
    if (variable->type != matrix && variable->type != compressed) wrong = "has an unknown type";
    if (wrong.empty()) continue;
    throw InputError(fmt::format("{}: is damaged or not supported: variable {} {}", file, number, wrong));
  }
}

}  // namespace incognita
