// The options of the page, common to `run` and `view`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "incognita/live/server.hpp"

namespace incognita {

struct PageOptions {
  std::string port;  ///< empty: any free one
  std::string address = "127.0.0.1";
  std::vector<std::string> allowed_origins;
};

/// --view-address and --allow-origin.
void add_access_options(CLI::App& command, PageOptions& options);

/// With a random token unless only this machine can connect. Throws InputError for a wrong port.
ServerSettings server_settings(const PageOptions& options);

/// A line, or nothing if the page is for this machine or the address can be used as it is.
std::string hint_for_other_machines(const PageOptions& options);

/// Opens the address in the browser of a desktop; does nothing elsewhere.
void open_in_browser(const std::string& address);

}  // namespace incognita
