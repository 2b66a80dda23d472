#include "incognita/app/view/laboratory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

/// Only names of figures: no folder, nothing hidden, and nothing that a shell or a page could misread.
bool is_plain_name(const std::string& name) {
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '-' || c == '_';
  });
}

/// Empty if the page may not read a file of that name.
const char* content_type_of(const std::string& name) {
  static const std::string figures = "figures/";
  if (name == "claims.json" || name == "campaign.json") return "application/json";
  if (name == "runs.csv") return "text/csv; charset=utf-8";
  if (!name.starts_with(figures) || !is_plain_name(name.substr(figures.size()))) return "";
  if (name.ends_with(".svg")) return "image/svg+xml";
  return name.ends_with(".csv") ? "text/csv; charset=utf-8" : "";
}

bool is_within(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

Laboratory::Kind kind_of(const fs::path& folder) {
  const bool claims = file_exists(folder / "claims.json");
  const bool campaign = file_exists(folder / "campaign.json");
  if (claims != campaign) return claims ? Laboratory::Kind::claims : Laboratory::Kind::campaign;
  throw InputError(fmt::format(
      "{} has {} claims.json (written by `incognita reproduce`) {} campaign.json (written by `incognita campaign`): "
      "give the folder that one of these commands wrote with --out",
      folder.string(), claims ? "both" : "neither", claims ? "and" : "nor"));
}

fs::path existing_folder(const fs::path& folder) {
  std::error_code error;
  const fs::path real = fs::canonical(folder, error);
  if (error || !fs::is_directory(real))
    throw InputError(
        fmt::format("{} is not a folder{}{}: give the folder that `incognita reproduce` or "
                    "`incognita campaign` wrote with --out",
                    folder.string(), error ? ": " : "", error ? error.message() : ""));
  return real;
}

}  // namespace

Laboratory::Laboratory(const fs::path& folder, std::size_t largest_file)
    : folder_(existing_folder(folder)), largest_file_(largest_file), kind_(kind_of(folder_)) {}

std::optional<ServedFile> Laboratory::file(const std::string& name) const {
  const std::string type = content_type_of(name);
  if (type.empty()) return std::nullopt;
  std::error_code error;
  const fs::path path = fs::canonical(folder_ / name, error);
  if (error || !is_within(path, folder_) || !fs::is_regular_file(path, error)) return std::nullopt;
  return ServedFile{type, read_file(path, largest_file_)};
}

}  // namespace incognita
