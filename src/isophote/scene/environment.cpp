#include "isophote/scene/environment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace isophote {
namespace {

/// Luminance of each texel's mean over its area under bilinear interpolation, which is the binomial filter (1 6 1)/8
/// along each axis: a texel is never black where something shines into it from the next one. Finite and not negative,
/// whatever the picture holds.
std::vector<float> mean_luminance(const RgbImage& image) {
  const int width = image.width, height = image.height;
  const auto at = [&](int x, int y) {
    const double value = luminance(Rgbd(image.at(x, y)));
    return value > 0 ? std::min<double>(value, std::numeric_limits<float>::max()) : 0.0;
  };
  const auto across = [&](int x, int y) {
    return (at((x + width - 1) % width, y) + 6 * at(x, y) + at((x + 1) % width, y)) / 8;
  };
  std::vector<float> result(image.pixels.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double sum = across(x, std::max(0, y - 1)) + 6 * across(x, y) + across(x, std::min(height - 1, y + 1));
      result[static_cast<std::size_t>(y) * width + x] = static_cast<float>(sum / 8);
    }
  return result;
}

/// Solid angle of a texel of row y.
double solid_angle(int y, int width, int height) {
  const double step = std::numbers::pi / height;
  return (std::cos(y * step) - std::cos((y + 1) * step)) * 2 * std::numbers::pi / width;
}

}  // namespace

Environment::Environment(const EnvironmentMap& map) : map_(map) {
  if (empty()) return;
  const int width = map.radiance.width, height = map.radiance.height;
  const std::vector<float> mean = mean_luminance(map.radiance);
  std::vector<double> angle(height);
  for (int y = 0; y < height; ++y) angle[y] = solid_angle(y, width, height);
  const auto for_each_texel = [&](const auto& visit) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) visit(x, y, static_cast<std::size_t>(y) * width + x);
  };

  double power = 0;
  for_each_texel([&](int, int y, std::size_t i) { power += mean[i] * angle[y]; });
  const double threshold = peak_ratio * power / (4 * std::numbers::pi);
  double bright_power = 0, bright_angle = 0;
  for_each_texel([&](int, int y, std::size_t i) {
    if (mean[i] > threshold) bright_power += mean[i] * angle[y], bright_angle += angle[y];
  });

  std::vector<float> share(mean.size());  // of 1, as powers may be beyond all floats
  if (bright_power > 0) {
    // What is faint beside the sun lights what the sun does not reach: a tenth is uniform.
    constexpr double alike = 0.1;
    for_each_texel([&](int, int y, std::size_t i) {
      if (mean[i] > threshold)
        share[i] =
            static_cast<float>((1 - alike) * mean[i] * angle[y] / bright_power + alike * angle[y] / bright_angle);
    });
    peaks_ = Distribution2D(share, width, height);
  }
  for_each_texel([&](int x, int y, std::size_t i) {
    // A texel too small for the distribution of peaks is left to the rest, so that no peak is without its density.
    const bool peak = !peaks_.empty() && peaks_.probability(x, y) > 0;
    (peak ? peak_power_ : rest_power_) += mean[i] * angle[y];
    share[i] = peak ? 0 : mean[i];
  });
  if (!(rest_power_ > 0)) return;
  for_each_texel([&](int, int y, std::size_t i) { share[i] = static_cast<float>(share[i] * angle[y] / rest_power_); });
  rest_ = Distribution2D(share, width, height);
}

Vec2 Environment::point(const Vec3& direction) const {
  const float turn = (std::atan2(direction.x, -direction.z) + map_.rotation) / (2 * pi) + 0.5f;
  return {std::min(turn - std::floor(turn), 0x1.fffffep-1f),
          std::atan2(std::hypot(direction.x, direction.z), direction.y) / pi};
}

Vec3 Environment::direction(Vec2 point) const {
  const float azimuth = 2 * pi * (point.x - 0.5f) - map_.rotation, theta = pi * point.y,
              s = std::sin(pi * std::min(point.y, 1 - point.y));
  return {s * std::sin(azimuth), std::cos(theta), -s * std::cos(azimuth)};
}

Rgb Environment::radiance(Vec2 point) const {
  const RgbImage& image = map_.radiance;
  const float x = std::max(0.0f, point.x) * static_cast<float>(image.width) - 0.5f,
              y = std::max(0.0f, point.y) * static_cast<float>(image.height) - 0.5f;
  const float left = std::floor(x), top = std::floor(y), fx = x - left, fy = y - top;
  const int x0 = (static_cast<int>(left) + image.width) % image.width, x1 = (x0 + 1) % image.width;
  const int y0 = std::clamp(static_cast<int>(top), 0, image.height - 1);
  const int y1 = std::clamp(static_cast<int>(top) + 1, 0, image.height - 1);
  return (image.at(x0, y0) * (1 - fx) + image.at(x1, y0) * fx) * (1 - fy) +
         (image.at(x0, y1) * (1 - fx) + image.at(x1, y1) * fx) * fy;
}

}  // namespace isophote
