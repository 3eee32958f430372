// Pictures in memory: contact sheets, labels, PNG.
#pragma once

#include <string>
#include <vector>

#include "model/geometry/types.h"

namespace retarget::io {

struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  // [height x width x 3] sRGB, rows from the top

  unsigned char* At(int x, int y) { return &rgb[3 * (static_cast<size_t>(y) * width + x)]; }
  const unsigned char* At(int x, int y) const {
    return &rgb[3 * (static_cast<size_t>(y) * width + x)];
  }
};

// One component in [0, 1] from screen to light and back (IEC 61966-2-1).
double LinearFromSrgb(double c);
double SrgbFromLinear(double c);

// A picture of one colour (sRGB, components in [0, 1]).
Image BlankImage(int width, int height, const Vec3& colour);

// A contact sheet: rows of pictures, `gap` white pixels between them and none at the border. A
// column is as wide and a row as high as its largest picture; rows may differ in length.
Image TileImages(const std::vector<std::vector<Image>>& rows, int gap = 8);

// Writes `text` with its upper left corner at pixel (x, y), `scale` pixels per dot; capitals are 7
// dots high. What is not printable ASCII becomes "?"; what lies outside of the picture is left out.
void DrawLabel(Image* image, int x, int y, const std::string& text, int scale = 2,
               const Vec3& colour = Vec3(0.15, 0.15, 0.17));

// Width of such a label in pixels.
int LabelWidth(const std::string& text, int scale = 2);

// The bytes of a PNG file (8 bits, sRGB). Throws std::runtime_error where there is no memory for
// it.
std::string EncodePng(const Image& image);

}  // namespace retarget::io
