#include "incognita/math/time_stamp.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>

namespace incognita {

std::optional<double> seconds_from_nanoseconds(std::string_view text) {
  const char* end = text.data() + text.size();
  // Nanoseconds since 1970 need 61 bits, more than a double's mantissa: split before the conversion to double
  std::int64_t ns = 0;
  const auto [stopped, error] = std::from_chars(text.data(), end, ns);
  const std::string_view rest(stopped, static_cast<std::size_t>(end - stopped));
  const bool only_zeros = rest.starts_with('.') && rest.find_first_not_of('0', 1) == std::string_view::npos;
  if (error == std::errc{} && (rest.empty() || only_zeros))
    return static_cast<double>(ns / 1'000'000'000) + static_cast<double>(ns % 1'000'000'000) * 1e-9;
  double written = 0;
  const auto [written_end, no_number] = std::from_chars(text.data(), end, written);
  const bool whole = no_number == std::errc{} && written_end == end && std::isfinite(written) &&
                     written == std::floor(written);
  return whole ? std::optional(written * 1e-9) : std::nullopt;
}

}  // namespace incognita
