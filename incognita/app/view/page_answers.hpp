// Answers of the page's interface: docs/live-page.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "incognita/live/server.hpp"

namespace incognita {

HttpAnswer json_answer(std::string json);
/// {"error": "..."}
HttpAnswer error_answer(int status, const std::string& why);

/// "/api/runs/0/frames/12" -> {"runs", "0", "frames", "12"}; empty unless the path begins with "/api/".
std::vector<std::string> api_path(const std::string& path);
/// A number of at most nine digits; none for anything else.
std::optional<std::size_t> index_of(const std::string& digits);

}  // namespace incognita
