#include "isophote/scene/environment.h"

#include <algorithm>
#include <cmath>

#include "isophote/core/ray.h"

namespace isophote {
namespace {

/// Luminance of each texel's mean over its area under bilinear interpolation, which is the binomial filter (1 6 1)/8
/// along each axis: a texel is never black where something shines into it from the next one.
std::vector<float> mean_luminance(const RgbImage& image) {
  const int width = image.width, height = image.height;
  const auto across = [&](int x, int y) {
    const Rgb sum = image.at((x + width - 1) % width, y) + image.at(x, y) * 6.0f + image.at((x + 1) % width, y);
    return luminance(sum) / 8;
  };
  std::vector<float> result(image.pixels.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float sum = across(x, std::max(0, y - 1)) + 6 * across(x, y) + across(x, std::min(height - 1, y + 1));
      result[static_cast<std::size_t>(y) * width + x] = sum / 8;
    }
  return result;
}

/// Solid angle of a texel of row y.
double solid_angle(int y, int width, int height) {
  const double step = 3.14159265358979323846 / height;
  return (std::cos(y * step) - std::cos((y + 1) * step)) * 2 * 3.14159265358979323846 / width;
}

/// Solid angle of an area element of the unit square, over its area.
float stretch(Vec2 point) { return 2 * pi * pi * std::sin(pi * std::min(point.y, 1 - point.y)); }

}  // namespace

Environment::Environment(const EnvironmentMap& map) : map_(map) {
  if (empty()) return;
  const int width = map.radiance.width, height = map.radiance.height;
  std::vector<float> weight = mean_luminance(map.radiance);
  double power = 0;
  for (std::size_t i = 0; i < weight.size(); ++i)
    power += weight[i] * solid_angle(static_cast<int>(i / width), width, height);
  const double threshold = peak_ratio * power / (4 * 3.14159265358979323846);
  for (std::size_t i = 0; i < weight.size(); ++i) {
    const double mean = weight[i];
    const double share = mean * solid_angle(static_cast<int>(i / width), width, height);
    if (mean > threshold) {
      peaks_.push_back({static_cast<std::uint32_t>(i), share});
      weight[i] = 0;
    } else {
      rest_power_ += share;
      weight[i] = static_cast<float>(share);
    }
  }
  if (rest_power_ > 0) rest_ = Distribution2D(weight, width, height);
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
  const float x = point.x * static_cast<float>(image.width) - 0.5f,
              y = point.y * static_cast<float>(image.height) - 0.5f;
  const float left = std::floor(x), top = std::floor(y), fx = x - left, fy = y - top;
  const int x0 = (static_cast<int>(left) + image.width) % image.width, x1 = (x0 + 1) % image.width;
  const int y0 = std::clamp(static_cast<int>(top), 0, image.height - 1);
  const int y1 = std::clamp(static_cast<int>(top) + 1, 0, image.height - 1);
  return (image.at(x0, y0) * (1 - fx) + image.at(x1, y0) * fx) * (1 - fy) +
         (image.at(x0, y1) * (1 - fx) + image.at(x1, y1) * fx) * fy;
}

std::optional<std::uint32_t> Environment::peak_at(Vec2 point) const {
  if (peaks_.empty()) return std::nullopt;
  const int width = map_.radiance.width, height = map_.radiance.height;
  const int x = std::clamp(static_cast<int>(point.x * static_cast<float>(width)), 0, width - 1);
  const int y = std::clamp(static_cast<int>(point.y * static_cast<float>(height)), 0, height - 1);
  const auto texel = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width) + static_cast<std::uint32_t>(x);
  const auto found =
      std::lower_bound(peaks_.begin(), peaks_.end(), texel, [](const Peak& p, std::uint32_t t) { return p.texel < t; });
  if (found == peaks_.end() || found->texel != texel) return std::nullopt;
  return static_cast<std::uint32_t>(found - peaks_.begin());
}

Vec2 Environment::sample_peak(std::uint32_t peak, Vec2 u) const {
  const int width = map_.radiance.width, height = map_.radiance.height;
  const std::uint32_t texel = peaks_[peak].texel;
  return {(static_cast<float>(texel % width) + u.x) / static_cast<float>(width),
          (static_cast<float>(texel / width) + u.y) / static_cast<float>(height)};
}

float Environment::peak_pdf(Vec2 point) const {
  return static_cast<float>(map_.radiance.width) * static_cast<float>(map_.radiance.height) / stretch(point);
}

float Environment::rest_pdf(Vec2 point) const { return rest_.empty() ? 0.0f : rest_.pdf(point) / stretch(point); }

}  // namespace isophote
