#include "io/render/image.h"

#include <zlib.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "io/render/pixel_font.h"

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

// PNG, second edition (ISO/IEC 15948), 7.1: numbers are big-endian.
std::string BigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFF);
  return bytes;
}

// Ibid. 5.3: length, type, data, and a checksum of type and data.
std::string Chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const uLong checksum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), body.size());
  return BigEndian(static_cast<std::uint32_t>(data.size())) + body +
         BigEndian(static_cast<std::uint32_t>(checksum));
}

// Ibid. 9.4: the neighbour (left, above, above left) nearest to their plane.
int Paeth(int left, int above, int corner) {
  const int plane = left + above - corner;
  const int to_left = std::abs(plane - left), to_above = std::abs(plane - above);
  const int to_corner = std::abs(plane - corner);
  if (to_left <= to_above && to_left <= to_corner) return left;
  return to_above <= to_corner ? above : corner;
}

// The rows as differences from their Paeth prediction, each behind its filter type.
std::string FilteredRows(const Image& image) {
  constexpr char kPaethFilter = 4;
  const int row_bytes = 3 * image.width;
  std::string filtered;
  filtered.reserve(static_cast<size_t>(image.height) * (row_bytes + 1));
  for (int y = 0; y < image.height; ++y) {
    const unsigned char* row = image.At(0, y);
    const unsigned char* above = y > 0 ? image.At(0, y - 1) : nullptr;
    filtered += kPaethFilter;
    for (int i = 0; i < row_bytes; ++i) {
      const int prediction =
          Paeth(i >= 3 ? row[i - 3] : 0, above ? above[i] : 0, i >= 3 && above ? above[i - 3] : 0);
      filtered += static_cast<char>(row[i] - prediction);
    }
  }
  return filtered;
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
  const auto is_ink = [&](int dx, int dy) {
    const int column = dx / scale % (kGlyphWidth + 1), row = dy / scale;
    if (column >= kGlyphWidth) return false;
    return (GlyphOf(text[dx / scale / (kGlyphWidth + 1)])[row] >> (kGlyphWidth - 1 - column) & 1) !=
           0;
  };
  const int width = LabelWidth(text, scale), height = kGlyphHeight * scale;
  for (int dy = std::max(0, -y); dy < std::min(height, image->height - y); ++dy) {
    for (int dx = std::max(0, -x); dx < std::min(width, image->width - x); ++dx) {
      if (!is_ink(dx, dy)) continue;
      for (int c = 0; c < 3; ++c) image->At(x + dx, y + dy)[c] = ByteOf(colour[c]);
    }
  }
}

int LabelWidth(const std::string& text, int scale) {
  if (text.empty()) return 0;
  return (static_cast<int>(text.size()) * (kGlyphWidth + 1) - 1) * scale;
}

std::string EncodePng(const Image& image) {
  const std::string rows = FilteredRows(image);
  uLongf size = compressBound(rows.size());
  std::string packed(size, '\0');
  const int status =
      compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(rows.data()), rows.size(), /*level=*/6);
  assert(status == Z_OK);  // the only other outcomes are no memory and no room
  static_cast<void>(status);
  packed.resize(size);
  // 8 bits, colour type 2 (RGB), the only compression and filter methods, not interlaced.
  const std::string header =
      BigEndian(image.width) + BigEndian(image.height) + std::string("\x08\x02\x00\x00\x00", 5);
  return std::string("\x89PNG\r\n\x1a\n", 8) + Chunk("IHDR", header) + Chunk("IDAT", packed) +
         Chunk("IEND", "");
}

}  // namespace retarget::io
