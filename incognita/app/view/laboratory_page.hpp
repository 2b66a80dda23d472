// The page of a program that shows the results of `reproduce` or `campaign`.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "incognita/app/view/laboratory.hpp"
#include "incognita/live/server.hpp"

namespace incognita {

/// Whether the folder was written by `reproduce` or `campaign`.
bool is_laboratory(const std::filesystem::path& folder);

class LaboratoryPage {
 public:
  /// Throws InputError as Laboratory does, or if the server cannot listen.
  LaboratoryPage(const std::filesystem::path& folder, ServerSettings settings);

  std::string address() const { return server_->address(); }

 private:
  HttpAnswer answer(const HttpRequest& request) const;

  Laboratory laboratory_;
  std::unique_ptr<Server> server_;
};

}  // namespace incognita
