#include "isophote/image/false_colour.h"

#include <algorithm>
#include <cmath>

#include "isophote/core/check.h"
#include "isophote/core/ray.h"

namespace isophote {
namespace {

/// Linear sRGB of an OKLab colour given by lightness, chroma and hue (radians) [Ottosson 2020].
Rgb oklch(float lightness, float chroma, float hue) {
  const float a = chroma * std::cos(hue), b = chroma * std::sin(hue);
  const auto cube = [](float x) { return x * x * x; };
  const float l = cube(lightness + 0.3963377774f * a + 0.2158037573f * b);
  const float m = cube(lightness - 0.1055613458f * a - 0.0638541728f * b);
  const float s = cube(lightness - 0.0894841775f * a - 1.2914855480f * b);
  return {4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s,
          -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s,
          -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s};
}

}  // namespace

Rgb false_colour(float t) {
  // Lightness rises evenly while the hue runs from violet through blue and green to yellow; the chroma is about what
  // the display's gamut holds all along this way.
  const float x = std::clamp(t, 0.0f, 1.0f);
  const float degrees = 310 - 200 * x;
  const float chroma = 0.088f + 0.07f * x * x * x;
  const Rgb c = oklch(0.22f + 0.72f * x, chroma, degrees * (pi / 180));
  return {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)};
}

Rgb ColourScale::operator()(float value) const {
  if (!logarithmic) return false_colour((value - low) / (high - low));
  return false_colour(value > low ? std::log(value / low) / std::log(high / low) : 0);
}

ColourScale colour_scale(std::vector<float> values, bool logarithmic) {
  values.erase(std::remove_if(values.begin(), values.end(), [](float v) { return !(v > 0); }), values.end());
  if (values.empty()) return {1, 2, logarithmic};
  std::sort(values.begin(), values.end());
  const std::size_t outside = values.size() / 50;
  const float low = logarithmic ? values[outside] : 0;
  return {low, std::max(values[values.size() - 1 - outside], low * 1.001f), logarithmic};
}

RgbImage error_picture(const RgbImage& image, const RgbImage& reference, float range) {
  ISOPHOTE_CHECK(image.width, ==, reference.width);
  ISOPHOTE_CHECK(image.height, ==, reference.height);
  double sum = 0;
  for (const Rgb& c : reference.pixels) sum += luminance(c);
  const double full = range * sum / static_cast<double>(reference.pixels.size());

  RgbImage picture(image.width, image.height);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const double difference = static_cast<double>(luminance(image.pixels[i])) - luminance(reference.pixels[i]);
    const float t = difference == 0 ? 0.0f : static_cast<float>(std::clamp(difference / full, -1.0, 1.0));
    const float fade = 1 - std::abs(t);
    picture.pixels[i] = t > 0 ? Rgb{1, fade, fade} : Rgb{fade, fade, 1};
  }
  return picture;
}

}  // namespace isophote
