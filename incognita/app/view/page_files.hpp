// The files of the page, built into the program: web/ and the libraries that it uses.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "incognita/live/server.hpp"

namespace incognita {

/// The file of a request such as "/" or "/scene/scene.js"; none if there is no such file.
std::optional<HttpAnswer> page_file(std::string_view path);

/// The same, and the certificate of an encrypted page as "/certificate.crt": iPhones let such a page use WebSockets only once its
/// certificate was installed. `certificate`: empty without encryption.
std::optional<HttpAnswer> page_file(std::string_view path, const std::filesystem::path& certificate);

/// Throws InputError if the program was built without the libraries of the page; names their packages.
void check_page_is_complete();

}  // namespace incognita
