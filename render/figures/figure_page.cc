#include "render/figures/figure_page.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "planner/base/error.h"
#include "render/figures/figure_mark.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

/// Prints sharp at the size it has; journals ask for this many dots per inch and more.
constexpr double kPixelsPerPoint = 300.0 / 72.0;
/// Cairo's images end at 32767 pixels a side; half of it keeps the memory below a gigabyte.
constexpr double kLongestSide = 16000;
/// Every PDF has this date: files of the same figure are the same bytes.
constexpr char kPdfDate[] = "2000-01-01T00:00:00Z";

cairo_status_t Append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void Demand(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw EnvironmentError(std::string("the figure cannot be drawn: ") +
                         cairo_status_to_string(status));
}

/// Removes the page's name from an SVG: Cairo numbers its surfaces over the life of the process.
void RemoveSurfaceName(std::string& svg) {
  static constexpr std::string_view kBegin = "<g";
  static constexpr std::string_view kName = " id=\"surface";
  const std::size_t group = svg.find(std::string(kBegin) + std::string(kName));
  if (group == std::string::npos) return;
  const std::size_t name = group + kBegin.size();
  svg.erase(name, svg.find('>', name) - name);
}

}  // namespace

cairo_surface_t* FigurePage::MakeSurface(double width, double height) {
  assert(width > 0 && height > 0);
  switch (format_) {
    case FigureFormat::kSvg: {
      cairo_surface_t* svg =
          cairo_svg_surface_create_for_stream(Append, bytes_.get(), width, height);
      cairo_svg_surface_set_document_unit(svg, CAIRO_SVG_UNIT_PT);
      return svg;
    }
    case FigureFormat::kPdf: {
      cairo_surface_t* pdf =
          cairo_pdf_surface_create_for_stream(Append, bytes_.get(), width, height);
      cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_CREATE_DATE, kPdfDate);
      cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_CREATOR, kFigureMaker);
      return pdf;
    }
    case FigureFormat::kPng:
      break;
  }
  scale_ = std::min(kPixelsPerPoint, kLongestSide / std::max(width, height));
  const auto pixels = [&](double points) {
    return std::max(1, static_cast<int>(std::lround(points * scale_)));
  };
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels(width), pixels(height));
}

FigurePage::FigurePage(FigureFormat format, double width, double height, double magnification)
    : format_(format),
      bytes_(std::make_unique<std::string>()),
      surface_(MakeSurface(magnification * width, magnification * height)),
      context_(cairo_create(surface_.get())) {
  cairo_t* cr = context_.get();
  Demand(cairo_status(cr));
  cairo_scale(cr, scale_ * magnification, scale_ * magnification);
  cairo_set_source_rgb(cr, 1, 1, 1);
  cairo_paint(cr);
}

std::string FigurePage::Finish() {
  Demand(cairo_status(context_.get()));
  if (format_ == FigureFormat::kPng) {
    cairo_surface_flush(surface_.get());
    Demand(cairo_surface_write_to_png_stream(surface_.get(), Append, bytes_.get()));
  } else {
    cairo_show_page(context_.get());
    cairo_surface_finish(surface_.get());
    Demand(cairo_surface_status(surface_.get()));
  }
  if (format_ == FigureFormat::kSvg) RemoveSurfaceName(*bytes_);
  MarkFigure(format_, *bytes_);
  return std::move(*bytes_);
}

}  // namespace regrasp::render
