// An address that a phone can read from the terminal.
#pragma once

#include <string>

namespace incognita {

/// The text as a QR code of half blocks, dark on bright whatever the colors of the terminal, with its quiet zone; lines end
/// in a newline. Empty for a text that is too long for a code (some 2900 bytes).
std::string qr_code(const std::string& text);

}  // namespace incognita
