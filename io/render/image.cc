#include "io/render/image.h"

#include <png.h>
#include <stb/stb_easy_font.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

namespace retarget::io {
namespace {

unsigned char ByteOf(double component) {
  return static_cast<unsigned char>(std::lround(255.0 * std::clamp(component, 0.0, 1.0)));
}

void Paste(const Image& part, int left, int top, Image* whole) {
  for (int y = 0; y < part.height; ++y) {
    std::copy_n(part.At(0, y), 3 * part.width, whole->At(left, top + y));
  }
}

// A rectangle of a glyph in dots, as stb_easy_font makes them: four corners of x, y, z and colour.
struct Quad {
  float corner[4][4];
};
constexpr int kMostQuadsOfAGlyph = 16;

// The font knows printable ASCII alone and does not check.
std::string Printable(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

}  // namespace

double LinearFromSrgb(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double SrgbFromLinear(double c) {
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}

Image BlankImage(int width, int height, const Vec3& colour) {
  assert(width > 0 && height > 0);
  Image image{width, height, std::vector<unsigned char>(3 * static_cast<size_t>(width) * height)};
  for (size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = ByteOf(colour[i % 3]);
  return image;
}

Image TileImages(const std::vector<std::vector<Image>>& rows, int gap) {
  std::vector<int> heights, widths;
  for (const std::vector<Image>& row : rows) {
    heights.push_back(0);
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (size_t i = 0; i < row.size(); ++i) {
      heights.back() = std::max(heights.back(), row[i].height);
      widths[i] = std::max(widths[i], row[i].width);
    }
  }
  int width = -gap, height = -gap;
  for (const int w : widths) width += w + gap;
  for (const int h : heights) height += h + gap;
  Image sheet = BlankImage(width, height, Vec3::Ones());
  int top = 0;
  for (size_t r = 0; r < rows.size(); ++r) {
    int left = 0;
    for (size_t i = 0; i < rows[r].size(); ++i) {
      Paste(rows[r][i], left, top, &sheet);
      left += widths[i] + gap;
    }
    top += heights[r] + gap;
  }
  return sheet;
}

void DrawLabel(Image* image, int x, int y, const std::string& text, int scale, const Vec3& colour) {
  std::string printable = Printable(text);
  std::vector<Quad> quads(kMostQuadsOfAGlyph * printable.size());
  quads.resize(
      static_cast<size_t>(stb_easy_font_print(0, 0, printable.data(), nullptr, quads.data(),
                                              static_cast<int>(quads.size() * sizeof(Quad)))));
  for (const Quad& quad : quads) {
    const auto pixel = [&](int corner, int axis) {
      return scale * static_cast<int>(quad.corner[corner][axis]) + (axis == 0 ? x : y);
    };
    for (int py = std::max(0, pixel(0, 1)); py < std::min(image->height, pixel(2, 1)); ++py) {
      for (int px = std::max(0, pixel(0, 0)); px < std::min(image->width, pixel(2, 0)); ++px) {
        for (int c = 0; c < 3; ++c) image->At(px, py)[c] = ByteOf(colour[c]);
      }
    }
  }
}

int LabelWidth(const std::string& text, int scale) {
  if (text.empty()) return 0;
  return (stb_easy_font_width(Printable(text).data()) - 1) * scale;  // no gap behind the last
}

std::string EncodePng(const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
  png_alloc_size_t size = bytes.size();
  const int written = png_image_write_to_memory(&header, bytes.data(), &size, /*convert_to_8bit=*/0,
                                                image.rgb.data(), /*row_stride=*/0, nullptr);
  if (written == 0) throw std::runtime_error(std::string("PNG: ") + header.message);
  bytes.resize(size);
  return bytes;
}

}  // namespace retarget::io
