// Who may use the server: checks of the Host, the Origin and the token of a request.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace incognita {

struct AccessRules {
  std::string token;  ///< empty: none is needed, only requests to this machine's own names pass
  std::vector<std::string> allowed_origins;  ///< besides the page's own, e.g. "https://app.foxglove.dev"
};

struct AccessRequest {
  std::string_view host;    ///< header Host, e.g. "localhost:8321"
  std::string_view origin;  ///< header Origin; empty where there is none: not a browser
  std::string_view token;   ///< parameter `token` of the address
  std::string_view site;    ///< header Sec-Fetch-Site, e.g. "same-origin"; empty where there is none
  bool encrypted = false;   ///< by https
};

/// Whether an address such as "127.0.0.1" or "::1" reaches this machine only.
bool is_loopback(std::string_view address);

/// 32 hexadecimal digits from the system's random numbers.
std::string random_token();

/// Why data are refused, or empty. Without a token, a name of another machine in Host is refused, since a page of that
/// name could have been sent here by its name server (DNS rebinding).
std::string refusal_of(const AccessRequest& request, const AccessRules& rules);

}  // namespace incognita
