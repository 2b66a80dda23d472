#include "incognita/live/access.hpp"

#include <algorithm>
#include <random>

namespace incognita {
namespace {

/// "localhost" of "localhost:8321", "::1" of "[::1]:8321".
std::string_view host_name(std::string_view host) {
  if (host.starts_with('[')) {
    const auto end = host.find(']');
    return end == std::string_view::npos ? std::string_view{} : host.substr(1, end - 1);
  }
  return host.substr(0, host.find(':'));
}

/// In a time that does not depend on where the two differ.
bool same_secret(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return difference == 0;
}

std::string quoted(std::string_view text) { return "\"" + std::string(text.substr(0, 100)) + "\""; }

}  // namespace

bool is_loopback(std::string_view address) {
  const bool digits = address.find_first_not_of("0123456789.") == std::string_view::npos;
  return address == "localhost" || address == "::1" || (digits && address.starts_with("127."));
}

std::string random_token() {
  constexpr char digits[] = "0123456789abcdef";
  std::random_device random;
  std::string token;
  while (token.size() < 32)
    for (unsigned bits = random(), i = 0; i < 8; ++i, bits >>= 4) token.push_back(digits[bits & 15u]);
  return token;
}

std::string refusal_of(const AccessRequest& request, const AccessRules& rules) {
  if (rules.token.empty() && !is_loopback(host_name(request.host)))
    return "the host " + quoted(request.host) + " is not this machine";
  const auto& allowed = rules.allowed_origins;
  const bool own = request.origin == (request.encrypted ? "https://" : "http://") + std::string(request.host);
  if (!request.origin.empty() && !own &&
      std::find(allowed.begin(), allowed.end(), request.origin) == allowed.end())
    return "a page of " + quoted(request.origin) + " may not connect; allow it with --allow-origin";
  // A browser sends no Origin with what another page embeds, such as <img src="http://localhost:8321/api/...">
  if (request.origin.empty() && (request.site == "cross-site" || request.site == "same-site"))
    return "a page of another site asked for it";
  if (!rules.token.empty() && !same_secret(request.token, rules.token))
    return request.token.empty() ? "the token of the printed address is missing" : "the token is wrong";
  return "";
}

}  // namespace incognita
