#include "isophote/integrate/film.h"

#include <algorithm>
#include <numeric>

namespace isophote {

Film::Film(int width, int height)
    : width_(width), height_(height), sums_(static_cast<std::size_t>(width) * height), samples_(height) {}

void Film::add(int x, int y, const PixelSample& sample) {
  PixelSample& sum = sums_[static_cast<std::size_t>(y) * width_ + x];
  sum.direct += sample.direct;
  sum.indirect += sample.indirect;
  sum.irradiance += sample.irradiance;
  sum.albedo += sample.albedo;
  sum.normal += sample.normal;
  sum.depth += sample.depth;
  sum.alpha += sample.alpha;
}

std::uint64_t Film::samples() const {
  return std::accumulate(samples_.begin(), samples_.end(), std::uint64_t{0}) * static_cast<std::uint64_t>(width_);
}

RgbImage Film::mean(Rgb PixelSample::*layer) const {
  RgbImage image(width_, height_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const PixelSample& sum = sums_[static_cast<std::size_t>(y) * width_ + x];
      image.at(x, y) = sum.*layer / static_cast<float>(std::max(1, samples_[y]));
    }
  return image;
}

RgbImage Film::color() const {
  RgbImage sum = mean(&PixelSample::direct);
  const RgbImage rest = mean(&PixelSample::indirect);
  for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += rest.pixels[i];
  return sum;
}

ExrFile Film::exr() const {
  RgbImage normal(width_, height_);
  std::vector<float> alpha(sums_.size()), depth(sums_.size());
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const PixelSample& sum = sums_[i];
    const auto samples = static_cast<float>(std::max(1, samples_[i / width_]));
    normal.pixels[i] = Rgb(sum.normal.x, sum.normal.y, sum.normal.z) / samples;
    alpha[i] = sum.alpha / samples;
    depth[i] = sum.alpha > 0 ? sum.depth / sum.alpha : 0;
  }
  ExrFile file;
  file.width = width_, file.height = height_;
  file.add_rgb("", color());
  file.add("A", std::move(alpha));
  file.add_rgb("direct", mean(&PixelSample::direct));
  file.add_rgb("indirect", mean(&PixelSample::indirect));
  file.add_rgb("irradiance", irradiance());
  file.add_rgb("albedo", mean(&PixelSample::albedo));
  file.add_rgb("normal", normal, "XYZ");
  file.add("depth.Z", std::move(depth));
  return file;
}

}  // namespace isophote
