#include "incognita/app/commands/page_options.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "incognita/app/console/print_message.hpp"
#include "incognita/app/console/qr_code.hpp"
#include "incognita/live/certificate.hpp"
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
  command
      .add_option("--view-address", options.address,
                  "Address to listen at; 0.0.0.0: all of this machine [127.0.0.1]")
      ->type_name("ADDRESS");
  command
      .add_option("--allow-origin", options.allowed_origins,
                  "Let a viewer on that site connect, e.g. https://app.foxglove.dev")
      ->type_name("ORIGIN")
      ->allow_extra_args(false);
  command.add_flag("--https", options.https,
                   "Encrypt the page: other devices give their camera to encrypted pages only");
  command.add_flag("--phone", options.phone,
                   "Serve the page to a phone: encrypted, at all addresses, with a QR code to open it");
}

namespace {

std::string listened_address(const PageOptions& options) {
  const std::string address = options.address.value_or(options.phone ? "0.0.0.0" : "127.0.0.1");
  return address == "localhost" ? "127.0.0.1" : address;
}

void encrypt(ServerSettings& settings) {
  const Certificate certificate = certificate_in(certificate_folder(), own_addresses());
  settings.certificate = certificate.file, settings.certificate_key = certificate.key;
  if (certificate.is_new)
    print_message(
        "view: a certificate for this machine was made, {}: a browser warns of it on each device, since no authority signed it\n",
        certificate.file.string());
}

}  // namespace

ServerSettings server_settings(const PageOptions& options) {
  ServerSettings settings;
  settings.address = listened_address(options);
  settings.port = options.port.empty() ? 0 : port_of(options.port);
  settings.access.allowed_origins = options.allowed_origins;
  if (!is_loopback(settings.address)) settings.access.token = random_token();
  if (options.https || options.phone) encrypt(settings);
  return settings;
}

std::string hint_for_other_machines(const PageOptions& options, const std::string& address) {
  const std::string all = listened_address(options);
  if (all != "0.0.0.0" && all != "::") return "";
  const std::string written = all == "::" ? "[::]" : all;
  const std::vector<std::string> own = own_addresses();
  if (own.empty()) return "this machine has no address in a network: connect it to that of the phone\n";
  std::string lines;
  for (const std::string& one : own) {
    std::string there = address;
    there.replace(there.find(written), written.size(), one);
    lines += fmt::format("on another device open {}\n", there);
    if (isatty(STDERR_FILENO) && &one == &own.front()) lines += qr_code(there);
  }
  return lines;
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
