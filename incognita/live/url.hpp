// The target of an HTTP request, "/api/config?scenario=room", taken apart.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace incognita {

struct RequestTarget {
  std::string path;
  std::vector<std::pair<std::string, std::string>> query;
};

/// Percent-decoded. None for a target that does not begin with "/", contains an invalid escape or a zero byte.
std::optional<RequestTarget> parse_target(std::string_view target);

}  // namespace incognita
