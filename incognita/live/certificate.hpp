// The certificate with which the page is served to other devices: made on first use, and signed by itself.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace incognita {

struct Certificate {
  std::filesystem::path file, key;  ///< PEM; the key is readable by its owner only
  bool is_new = false;              ///< browsers will ask whether to accept it
};

/// That in `folder`, if it is valid for a week, names all `addresses` (numerical IPv4 or IPv6) and fits the key; else a new one for
/// these and the name of this machine, valid for 820 days (phones refuse more than 825), with the key that is there if it
/// fits. As an authority it is constrained to these names (RFC 5280, 4.2.1.10), so that its key is of no use for other sites.
/// Throws InputError naming file and remedy if it can be neither read nor written, and for one of another issuer that does not
/// serve: that is never replaced.
Certificate certificate_in(const std::filesystem::path& folder, const std::vector<std::string>& addresses);

/// $XDG_CONFIG_HOME/incognita, else ~/.config/incognita. Throws InputError if neither variable is set.
std::filesystem::path certificate_folder();

/// The numerical IPv4 addresses of this machine but the loopback, in the order of its interfaces.
std::vector<std::string> own_addresses();

}  // namespace incognita
