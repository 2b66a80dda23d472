#include "incognita/app/view/page_answers.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

namespace incognita {

HttpAnswer json_answer(std::string json) {
  return {200, "application/json", std::make_shared<const std::string>(std::move(json))};
}

HttpAnswer error_answer(int status, const std::string& why) {
  const nlohmann::json json{{"error", why}};
  return {status, "application/json",
          std::make_shared<const std::string>(
              json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))};
}

std::vector<std::string> api_path(const std::string& path) {
  constexpr std::string_view root = "/api/";
  std::vector<std::string> parts;
  if (!path.starts_with(root)) return parts;
  std::istringstream rest(path.substr(root.size()));
  for (std::string part; std::getline(rest, part, '/');) parts.push_back(part);
  return parts;
}

std::optional<std::size_t> index_of(const std::string& digits) {
  if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  return std::stoul(digits);
}

}  // namespace incognita
