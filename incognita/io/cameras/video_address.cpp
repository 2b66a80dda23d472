#include "incognita/io/cameras/video_address.hpp"

#include <algorithm>
#include <cctype>
#include <regex>

namespace incognita {
namespace {

/// Whether it is like "host:554", "[::1]:554" or "host". Otherwise it is a user, and the begin of a password that has a / ? or # in it.
bool is_host(const std::string& authority) {
  if (authority.starts_with('[')) return true;
  const std::size_t colon = authority.find(':');
  return colon == std::string::npos ||
         std::all_of(authority.begin() + static_cast<std::ptrdiff_t>(colon) + 1, authority.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string without_user_password(const std::string& address) {
  const std::size_t user = address.find("://") + 3;
  const std::string authority = address.substr(user, address.find_first_of("/?#", user) - user);
  std::size_t host = authority.rfind('@');
  if (host == std::string::npos && !is_host(authority)) host = address.substr(user).rfind('@');
  const std::size_t colon = address.find(':', user);
  if (host == std::string::npos || colon > user + host) return address;
  return address.substr(0, colon) + ":***" + address.substr(user + host);
}

/// That of "/user=me&password=secret&channel=1" and of "/user=me_password=secret_channel=1.sdp".
std::string without_named_password(const std::string& address) {
  static const std::regex named("(pass|password|passwd|pwd)=.*?(?=&|_[a-z]+=|$)",
                                std::regex::ECMAScript | std::regex::icase);
  return std::regex_replace(address, named, "$1=***");
}

}  // namespace

bool is_device(const std::string& source) { return source.starts_with("/dev/"); }

bool is_address(const std::string& source) { return source.find("://") != std::string::npos; }

std::string without_password(const std::string& source) {
  return is_address(source) ? without_named_password(without_user_password(source)) : source;
}

}  // namespace incognita
