#include "incognita/io/formats/files.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "incognita/io/formats/embedded.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

/// Null for paths outside of the built-in files, e.g. with `../`.
const EmbeddedFile* find_embedded(const std::filesystem::path& path) {
  const std::filesystem::path within = path.native().substr(embedded_root.size() + 1);
  const std::string name = within.lexically_normal().string();
  for (const EmbeddedFile& file : embedded_files()) {
    if (file.name == name) return &file;
  }
  return nullptr;
}

}  // namespace

bool is_embedded(const std::filesystem::path& path) {
  return path.native().size() > embedded_root.size() && path.native().starts_with(embedded_root) &&
         path.native()[embedded_root.size()] == '/';
}

std::string shown(const std::filesystem::path& path) {
  return is_embedded(path) ? path.native().substr(embedded_root.size() + 1) : path.native();
}

bool file_exists(const std::filesystem::path& path) {
  if (is_embedded(path)) return find_embedded(path) != nullptr;
  std::error_code ignored;  // a file without permission counts as missing
  return std::filesystem::is_regular_file(path, ignored);
}

std::string read_file(const std::filesystem::path& path, std::size_t largest) {
  if (is_embedded(path)) {
    if (const EmbeddedFile* file = find_embedded(path)) return std::string(file->bytes);
    throw InputError(fmt::format("{}: there is no such built-in file", shown(path)));
  }
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw InputError(fmt::format("{}: is a folder, not a file", path.native()));
  }
  if (const auto type = std::filesystem::status(path, error).type();
      type != std::filesystem::file_type::regular && type != std::filesystem::file_type::not_found)
    throw InputError(fmt::format("{}: is no regular file; a pipe or device is not read", path.native()));
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: cannot be read: {}", path.native(), std::strerror(errno)));
  std::string content;
  char buffer[1 << 16];
  while (file.read(buffer, sizeof buffer) || file.gcount() > 0) {
    content.append(buffer, static_cast<std::size_t>(file.gcount()));
    if (content.size() > largest) {
      throw InputError(fmt::format("{}: is larger than the {} bytes allowed", path.native(), largest));
    }
  }
  if (file.bad())
    throw InputError(fmt::format("{}: reading failed before the end of the file", path.native()));
  return content;
}

std::vector<std::string> embedded_scenarios() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : embedded_files()) {
    const std::filesystem::path path(file.name);
    if (!path.has_parent_path() && path.extension() == ".toml") names.push_back(path.stem().string());
  }
  return names;
}

}  // namespace incognita
