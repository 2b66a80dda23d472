#include "incognita/io/targets/printed_target.hpp"

#include <cairo-pdf.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

namespace incognita {
namespace {

constexpr double points_per_mm = 72 / 25.4;  // of PDF
constexpr double outer_width_mm = 210, outer_height_mm = 148.5;

struct Rectangle {
  double left, top, width, height;  ///< mm from the center of the sheet, right and down
};
constexpr Rectangle outer{-outer_width_mm / 2, -outer_height_mm / 2, outer_width_mm, outer_height_mm};
/// At least 37 mm from the edges of the outer one: more than half a patch, whose pixels are 2 to 5 mm where a camera starts.
constexpr Rectangle inner{-68, -37, 76, 58};
constexpr double ruler_mm = 100, ruler_below_mm = 12;

/// Pixels of the patches, and of the picture: about those of a camera that starts.
constexpr double patch_px_per_mm = 0.5;
constexpr int printed_patch_px = 15;
constexpr double picture_px_per_mm = 0.33, picture_margin_mm = 15;

struct Destroy {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;
using Context = std::unique_ptr<cairo_t, Destroy>;

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("the target cannot be drawn: {}", cairo_status_to_string(status)));
}

void fill(cairo_t* c, const Rectangle& r, double gray) {
  cairo_set_source_rgb(c, gray, gray, gray);
  cairo_rectangle(c, r.left, r.top, r.width, r.height);
  cairo_fill(c);
}

/// A line of 100 mm with a tick every 10 mm, and what to do with it. The font is the one that cairo always has.
void draw_ruler(cairo_t* c, const Paper& paper) {
  const double y = outer_height_mm / 2 + ruler_below_mm;
  cairo_set_source_rgb(c, 0, 0, 0);
  cairo_set_line_width(c, 0.2);
  cairo_move_to(c, -ruler_mm / 2, y);
  cairo_line_to(c, ruler_mm / 2, y);
  for (int tick = 0; tick <= 10; ++tick) {
    const double x = -ruler_mm / 2 + 10 * tick, length = tick % 5 == 0 ? 3 : 1.5;
    cairo_move_to(c, x, y - length);
    cairo_line_to(c, x, y);
  }
  cairo_stroke(c);
  cairo_select_font_face(c, "@cairo:", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, 4);
  cairo_move_to(c, -ruler_mm / 2, y + 5.5);
  cairo_show_text(
      c, fmt::format("100 mm: measure it. Target of incognita, {}, printed at 100 %.", paper.name).c_str());
}

/// Unit: mm from the upper left corner of the paper.
void draw(cairo_t* c, const Paper& paper) {
  fill(c, {0, 0, paper.width_mm, paper.height_mm}, 1);
  cairo_translate(c, paper.width_mm / 2, paper.height_mm / 2);
  fill(c, outer, 0);
  fill(c, inner, 1);
  draw_ruler(c, paper);
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

/// Corners of the outer rectangle, then of the inner one; clockwise from the upper left.
std::vector<Eigen::Vector2d> corners_mm() {
  std::vector<Eigen::Vector2d> corners;
  for (const Rectangle& r : {outer, inner})
    for (const auto& [right, down] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      corners.emplace_back(r.left + right * r.width, r.top + down * r.height);
  return corners;
}

/// A part of the sheet: `first_mm` from the center of the sheet is the center of the first pixel.
Image part_of(const Paper& paper, const Eigen::Vector2d& first_mm, double px_per_mm, int width, int height) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  check(cairo_surface_status(surface.get()));
  const Context context(cairo_create(surface.get()));
  cairo_set_antialias(context.get(), CAIRO_ANTIALIAS_BEST);
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  cairo_paint(context.get());
  cairo_translate(context.get(), 0.5, 0.5);  // cairo's (0, 0) is the corner of the first pixel
  cairo_scale(context.get(), px_per_mm, px_per_mm);
  cairo_translate(context.get(), -first_mm.x() - paper.width_mm / 2, -first_mm.y() - paper.height_mm / 2);
  draw(context.get(), paper);
  check(cairo_status(context.get()));
  cairo_surface_flush(surface.get());
  Image image(width, height);
  const unsigned char* pixels = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) image(u, v) = pixels[v * stride + 4 * u];
  return image;
}

Image with_levels(Image image, int black, int white) {
  for (int v = 0; v < image.height(); ++v)
    for (int u = 0; u < image.width(); ++u)
      image(u, v) = static_cast<std::uint8_t>(black + (white - black) * image(u, v) / 255);
  return image;
}

}  // namespace

std::optional<Paper> paper_of(const std::string& word) {
  if (word == "a4") return Paper{"A4", 297, 210};
  if (word == "letter") return Paper{"Letter", 279.4, 215.9};
  return std::nullopt;
}

std::string target_pdf(const Paper& paper) {
  std::string pdf;
  {
    const Surface surface(cairo_pdf_surface_create_for_stream(append, &pdf, paper.width_mm * points_per_mm,
                                                              paper.height_mm * points_per_mm));
    check(cairo_surface_status(surface.get()));
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, "Target of incognita");
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "2007-01-01T00:00:00Z");
    const Context context(cairo_create(surface.get()));
    cairo_scale(context.get(), points_per_mm, points_per_mm);
    draw(context.get(), paper);
    cairo_show_page(context.get());
    check(cairo_status(context.get()));
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()));
  }
  return pdf;
}

Image target_sheet_image(const Paper& paper, double px_per_mm, int black, int white) {
  const Eigen::Vector2d first_mm(-paper.width_mm / 2 + 0.5 / px_per_mm,
                                 -paper.height_mm / 2 + 0.5 / px_per_mm);
  return with_levels(
      part_of(paper, first_mm, px_per_mm, static_cast<int>(std::lround(paper.width_mm * px_per_mm)),
              static_cast<int>(std::lround(paper.height_mm * px_per_mm))),
      black, white);
}

NewTarget printed_target(const Paper& paper) {
  NewTarget target;
  target.comment = fmt::format(
      "The sheet that `incognita target --print` makes for {} paper, printed at 100 %: a black rectangle of 210 x 148.5 mm with a\n"
      "white one in it. Its center is the origin of the world.",
      paper.name);
  const Eigen::Vector2d picture_first_mm(outer.left - picture_margin_mm, outer.top - picture_margin_mm);
  const int width = static_cast<int>(std::lround((outer.width + 2 * picture_margin_mm) * picture_px_per_mm)),
            height =
                static_cast<int>(std::lround((outer.height + 2 * picture_margin_mm) * picture_px_per_mm));
  target.picture = part_of(paper, picture_first_mm, picture_px_per_mm, width, height);
  for (const Eigen::Vector2d& at_mm : corners_mm()) {
    const Eigen::Vector2d first_mm = at_mm.array() - (printed_patch_px / 2) / patch_px_per_mm;
    target.corners.push_back({at_mm / 1000,
                              part_of(paper, first_mm, patch_px_per_mm, printed_patch_px, printed_patch_px),
                              (at_mm - picture_first_mm) * picture_px_per_mm});
  }
  return target;
}

}  // namespace incognita
