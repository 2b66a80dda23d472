// Formats error messages that contain numbers.
#pragma once

#include <sstream>
#include <string>

namespace incognita {

template <class... Parts>
std::string format_message(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

}  // namespace incognita
