#include "incognita/app/view/page_files.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "incognita/io/formats/embedded.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {

std::span<const EmbeddedFile> embedded_page();       // files of web/
std::span<const EmbeddedFile> embedded_libraries();  // three.js and d3, as files of vendor/

namespace {

std::string content_type(std::string_view name) {
  const auto ends = [&](std::string_view with) { return name.ends_with(with); };
  if (ends(".html")) return "text/html; charset=utf-8";
  if (ends(".css")) return "text/css; charset=utf-8";
  if (ends(".js")) return "text/javascript; charset=utf-8";
  if (ends(".svg")) return "image/svg+xml";
  if (ends(".json")) return "application/json";
  return "application/octet-stream";
}

using Answers = std::map<std::string, HttpAnswer, std::less<>>;

Answers all_answers() {
  Answers answers;
  const auto add = [&](const EmbeddedFile& file, const std::string& folder) {
    answers["/" + folder + std::string(file.name)] = {200, content_type(file.name),
                                                      std::make_shared<const std::string>(file.bytes)};
  };
  for (const EmbeddedFile& file : embedded_page()) add(file, "");
  for (const EmbeddedFile& file : embedded_libraries()) add(file, "vendor/");
  return answers;
}

}  // namespace

std::optional<HttpAnswer> page_file(std::string_view path) {
  static const Answers answers = all_answers();
  const auto found = answers.find(path == "/" ? "/index.html" : path);
  return found == answers.end() ? std::nullopt : std::optional(found->second);
}

std::optional<HttpAnswer> page_file(std::string_view path, const std::filesystem::path& certificate) {
  if (path != "/certificate.crt" || certificate.empty()) return page_file(path);
  constexpr std::size_t largest = 1u << 16;
  return HttpAnswer{200,
                    "application/x-x509-ca-cert",
                    std::make_shared<const std::string>(read_file(certificate, largest)),
                    {}};
}

void check_page_is_complete() {
  if (embedded_libraries().size() < 3)
    throw InputError(
        "this program was built without its page: apt-get install libjs-three node-d3, then build again");
}

}  // namespace incognita
