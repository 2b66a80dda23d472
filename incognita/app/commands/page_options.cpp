#include "incognita/app/commands/page_options.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

std::uint16_t port_of(const std::string& text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc{} || end != text.data() + text.size())
    throw InputError(fmt::format("port {}: must be 1 to 65535, or 0 for any free one", text));
  return port;
}

bool has_desktop() { return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr; }

}  // namespace

void add_access_options(CLI::App& command, PageOptions& options) {
  command.add_option("--view-address", options.address, "Address to listen at; 0.0.0.0: all of this machine")
      ->capture_default_str()
      ->type_name("ADDRESS");
  command
      .add_option("--allow-origin", options.allowed_origins,
                  "Let a viewer on that site connect, e.g. https://app.foxglove.dev")
      ->type_name("ORIGIN")
      ->allow_extra_args(false);
}

ServerSettings server_settings(const PageOptions& options) {
  ServerSettings settings;
  settings.address = options.address == "localhost" ? "127.0.0.1" : options.address;
  settings.port = options.port.empty() ? 0 : port_of(options.port);
  settings.access.allowed_origins = options.allowed_origins;
  if (!is_loopback(settings.address)) settings.access.token = random_token();
  return settings;
}

std::string hint_for_other_machines(const PageOptions& options) {
  if (options.address != "0.0.0.0" && options.address != "::") return "";
  return fmt::format("on another machine, open it with this one's name or address in place of {}\n",
                     options.address);
}

void open_in_browser(const std::string& address) {
  if (!has_desktop()) return;
  const pid_t child = fork();
  if (child == 0) {
    if (fork() == 0) {  // an orphan: nobody has to wait for the browser
      setsid();         // Ctrl-C ends this program, not the browser
      std::signal(SIGPIPE, SIG_DFL);
      std::freopen("/dev/null", "w", stdout);
      std::freopen("/dev/null", "w", stderr);
      execlp("xdg-open", "xdg-open", address.c_str(), static_cast<char*>(nullptr));
    }
    _exit(0);
  }
  if (child > 0) waitpid(child, nullptr, 0);
}

}  // namespace incognita
