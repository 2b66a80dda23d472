#include "incognita/app/console/qr_code.hpp"

#include <qrencode.h>

#include <memory>

namespace incognita {
namespace {

constexpr int quiet = 2;  // modules of border; 4 by the standard, but 2 suffice for phones
constexpr const char *dark_on_bright = "\x1b[30;107m", *usual = "\x1b[0m";

struct Free {
  void operator()(QRcode* code) const { QRcode_free(code); }
};

bool is_dark(const QRcode& code, int row, int column) {
  if (row < 0 || column < 0 || row >= code.width || column >= code.width) return false;
  return code.data[row * code.width + column] & 1;
}

}  // namespace

std::string qr_code(const std::string& text) {
  const std::unique_ptr<QRcode, Free> code(QRcode_encodeString(text.c_str(), 0, QR_ECLEVEL_L, QR_MODE_8, 1));
  if (!code) return "";
  std::string lines;
  for (int row = -quiet; row < code->width + quiet; row += 2) {
    lines += dark_on_bright;
    for (int column = -quiet; column < code->width + quiet; ++column) {
      const bool upper = is_dark(*code, row, column), lower = is_dark(*code, row + 1, column);
      lines += upper && lower ? "█" : upper ? "▀" : lower ? "▄" : " ";
    }
    lines += usual;
    lines += "\n";
  }
  return lines;
}

}  // namespace incognita
