#include "incognita/io/cameras/video_address.hpp"

namespace incognita {

bool is_device(const std::string& source) { return source.starts_with("/dev/"); }

bool is_address(const std::string& source) { return source.find("://") != std::string::npos; }

std::string without_password(const std::string& source) {
  if (!is_address(source)) return source;
  const std::size_t user = source.find("://") + 3;
  const std::size_t host = source.substr(0, source.find_first_of("/?#", user)).rfind('@');
  const std::size_t colon = source.find(':', user);
  if (host == std::string::npos || host < user || colon > host) return source;
  return source.substr(0, colon) + ":***" + source.substr(host);
}

}  // namespace incognita
