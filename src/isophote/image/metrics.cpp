#include "isophote/image/metrics.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "isophote/core/error.h"
#include "isophote/image/png.h"
#include "isophote/image/srgb.h"

namespace isophote {
namespace {

constexpr int block = 8;

void require_comparable(const RgbImage& image, const RgbImage& reference) {
  const auto size = [](const RgbImage& i) { return std::to_string(i.width) + "x" + std::to_string(i.height); };
  if (image.width != reference.width || image.height != reference.height)
    throw UserError("the picture is " + size(image) + " and the reference " + size(reference));
  if (image.pixels.empty()) throw UserError("the pictures are empty");
  const auto require_finite = [](const RgbImage& i, const char* what) {
    for (int y = 0; y < i.height; ++y)
      for (int x = 0; x < i.width; ++x)
        if (!is_finite(i.at(x, y)))
          throw UserError(std::string("pixel (") + std::to_string(x) + ", " + std::to_string(y) + ") of the " + what +
                          " is not finite");
  };
  require_finite(image, "picture");
  require_finite(reference, "reference");
}

double square(double x) { return x * x; }
double root(double x) { return std::sqrt(std::max(0.0, x)); }
double relative(double value, double scale) { return value == 0 ? 0 : value / scale; }

/// A rectangle of doubles, row by row.
using Plane = Image<double>;

/// A Gaussian of sigma 1.5 over 11 values, or over the most (an odd number) that fit into `length`; its sum is 1.
std::vector<double> gaussian(int length) {
  const int radius = std::min(5, (length - 1) / 2);
  std::vector<double> weights;
  double sum = 0;
  for (int i = -radius; i <= radius; ++i) sum += weights.emplace_back(std::exp(-0.5 * square(i / 1.5)));
  for (double& w : weights) w /= sum;
  return weights;
}

/// Window means at all places where the window lies within `plane`.
Plane window_means(const Plane& plane) {
  const auto across = gaussian(plane.width), down = gaussian(plane.height);
  const int nx = static_cast<int>(across.size()), ny = static_cast<int>(down.size());
  Plane rows(plane.width - nx + 1, plane.height);
  for (int y = 0; y < rows.height; ++y)
    for (int x = 0; x < rows.width; ++x)
      for (int i = 0; i < nx; ++i) rows.at(x, y) += across[i] * plane.at(x + i, y);
  Plane means(rows.width, plane.height - ny + 1);
  for (int y = 0; y < means.height; ++y)
    for (int i = 0; i < ny; ++i)
      for (int x = 0; x < means.width; ++x) means.at(x, y) += down[i] * rows.at(x, y + i);
  return means;
}

Plane product(const Plane& a, const Plane& b) {
  Plane c = a;
  for (std::size_t i = 0; i < c.pixels.size(); ++i) c.pixels[i] *= b.pixels[i];
  return c;
}

Plane displayed(const RgbImage& image, float exposure) {
  Plane plane(image.width, image.height);
  const float scale = std::exp2(exposure);
  for (std::size_t i = 0; i < plane.pixels.size(); ++i)
    plane.pixels[i] = srgb_encode(luminance(image.pixels[i]) * scale);
  return plane;
}

/// [Wang 2004]
double structural_similarity(const Plane& a, const Plane& b) {
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  const Plane mean_a = window_means(a), mean_b = window_means(b);
  const Plane mean_aa = window_means(product(a, a)), mean_bb = window_means(product(b, b));
  const Plane mean_ab = window_means(product(a, b));
  double sum = 0;
  for (std::size_t i = 0; i < mean_a.pixels.size(); ++i) {
    const double ma = mean_a.pixels[i], mb = mean_b.pixels[i];
    const double var_a = mean_aa.pixels[i] - ma * ma, var_b = mean_bb.pixels[i] - mb * mb;
    const double covariance = mean_ab.pixels[i] - ma * mb;
    sum += (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (var_a + var_b + c2));
  }
  return sum / static_cast<double>(mean_a.pixels.size());
}

double block_rms(const RgbImage& image, const RgbImage& other, const RgbImage& reference, const RgbImage& second) {
  const RgbImage a = block_average(image, block), o = block_average(other, block);
  const RgbImage b = block_average(reference, block), c = block_average(second, block);
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    sum += luminance(Rgbd(a.pixels[i]) - Rgbd(b.pixels[i])) * luminance(Rgbd(o.pixels[i]) - Rgbd(c.pixels[i]));
  return root(sum / static_cast<double>(a.pixels.size()));
}

RgbImage mean_image(const RgbImage& a, const RgbImage& b) {
  RgbImage mean = a;
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] = (a.pixels[i] + b.pixels[i]) * 0.5f;
  return mean;
}

}  // namespace

Difference compare(const RgbImage& image, const RgbImage& reference) { return compare(image, reference, reference); }

Difference compare(const RgbImage& image, const RgbImage& reference, const RgbImage& second) {
  return compare(image, image, reference, second);
}

Difference compare(const RgbImage& image, const RgbImage& other, const RgbImage& reference, const RgbImage& second) {
  require_comparable(image, reference);
  require_comparable(other, reference);
  require_comparable(image, second);
  const RgbImage both = mean_image(reference, second);
  const double pixels = static_cast<double>(image.pixels.size());
  double squares = 0, all_channels = 0, luminance_sum = 0, reference_luminance_sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Rgbd a(image.pixels[i]), o(other.pixels[i]);
    const Rgbd to_first = a - Rgbd(reference.pixels[i]), to_second = o - Rgbd(second.pixels[i]);
    const Rgbd product = to_first * to_second, b(both.pixels[i]);
    squares += product.r + product.g + product.b;
    all_channels += mean(b);
    luminance_sum += luminance(a);
    reference_luminance_sum += luminance(b);
  }
  const double mean_reference = reference_luminance_sum / pixels;

  double relative_squares = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double a = luminance(Rgbd(image.pixels[i])), o = luminance(Rgbd(other.pixels[i]));
    const double b = luminance(Rgbd(both.pixels[i]));
    const double product = (a - luminance(Rgbd(reference.pixels[i]))) * (o - luminance(Rgbd(second.pixels[i])));
    relative_squares += relative(product, square(b) + square(0.01 * mean_reference));
  }

  Difference d;
  d.rmse = root(squares / (3 * pixels));
  d.relative_rmse = relative(d.rmse, all_channels / pixels);
  d.relative_mse = std::max(0.0, relative_squares / pixels);
  d.bias = relative(luminance_sum - reference_luminance_sum, reference_luminance_sum);
  d.block_error = relative(block_rms(image, other, reference, second), mean_reference);
  const float exposure = auto_exposure(both);
  d.ssim = structural_similarity(displayed(image, exposure), displayed(both, exposure));
  return d;
}

RgbImage block_average(const RgbImage& image, int n) {
  RgbImage result((image.width + n - 1) / n, (image.height + n - 1) / n);
  for (int by = 0; by < result.height; ++by)
    for (int bx = 0; bx < result.width; ++bx) {
      const int x1 = std::min((bx + 1) * n, image.width), y1 = std::min((by + 1) * n, image.height);
      Rgbd sum;
      for (int y = by * n; y < y1; ++y)
        for (int x = bx * n; x < x1; ++x) sum += Rgbd(image.at(x, y));
      result.at(bx, by) = Rgb(sum / static_cast<double>((x1 - bx * n) * (y1 - by * n)));
    }
  return result;
}

}  // namespace isophote
