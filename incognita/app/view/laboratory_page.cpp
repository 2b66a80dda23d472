#include "incognita/app/view/laboratory_page.hpp"

#include <utility>

#include "incognita/app/console/print_message.hpp"
#include "incognita/app/view/page_answers.hpp"
#include "incognita/app/view/page_files.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::string_view files = "/files/";

/// The page of that kind of results; the token goes with it.
HttpAnswer redirected(const std::string& kind, const HttpRequest& request) {
  HttpAnswer answer;
  answer.status = 302;
  answer.location = "/laboratory/" + kind + ".html";
  if (const auto token = request.parameter("token"); !token.empty())
    if (token.find_first_not_of("0123456789abcdef") == std::string_view::npos)
      answer.location += "?token=" + std::string(token);
  return answer;
}

}  // namespace

bool is_laboratory(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "claims.json") || std::filesystem::exists(folder / "campaign.json");
}

LaboratoryPage::LaboratoryPage(const std::filesystem::path& folder, ServerSettings settings)
    : laboratory_(folder) {
  check_page_is_complete();
  ServerHandlers handlers;
  handlers.public_answer = [this, certificate = settings.certificate](const HttpRequest& request) {
    return request.path == "/" ? redirected(laboratory_.kind_name(), request)
                               : page_file(request.path, certificate);
  };
  handlers.answer = [this](const HttpRequest& request) { return answer(request); };
  handlers.log = [](const std::string& line) { print_message("view: {}\n", line); };
  server_ = std::make_unique<Server>(std::move(settings), std::move(handlers));
}

HttpAnswer LaboratoryPage::answer(const HttpRequest& request) const {
  if (!request.path.starts_with(files)) return error_answer(404, "there is no such page");
  try {
    auto file = laboratory_.file(request.path.substr(files.size()));
    if (!file) return error_answer(404, "there is no such file of results");
    return {200, file->content_type, std::make_shared<const std::string>(std::move(file->bytes))};
  } catch (const InputError& error) {
    return error_answer(500, error.what());
  }
}

}  // namespace incognita
