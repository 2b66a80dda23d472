// The options of the page, common to `run` and `view`.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "incognita/live/server.hpp"

namespace incognita {

struct PageOptions {
  std::string port;                                   ///< empty: any free one
  std::optional<std::string> address = std::nullopt;  ///< none: this machine only, with `phone` all
  std::vector<std::string> allowed_origins;
  bool https = false;  ///< encrypted
  bool phone = false;  ///< the same at all addresses, with a QR code
};

/// --view-address, --allow-origin, --https and --phone.
void add_access_options(CLI::App& command, PageOptions& options);

/// With a random token unless only this machine can connect. Makes the certificate if there is none yet, which is said. Throws
/// InputError for a wrong port, and for a certificate that cannot be written.
ServerSettings server_settings(const PageOptions& options);

/// The addresses of the page for other machines, and on a terminal the first of them as a QR code; nothing if the page is for this
/// machine or the address can be used as it is. `address`: as the server names it.
std::string hint_for_other_machines(const PageOptions& options, const std::string& address);

/// Opens the address in the browser of a desktop; does nothing elsewhere.
void open_in_browser(const std::string& address);

}  // namespace incognita
