#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "comparison/occluded_plane.h"
#include "comparison/plane_figures.h"
#include "isophote/cache/catalogue.h"
#include "isophote/image/false_colour.h"
#include "isophote/image/png.h"

namespace isophote::bench {
namespace {

constexpr int side = 96;  // pixels of a picture
constexpr double greatest_gradient = 0.8, greatest_curvature = 2;
/// As many rays as the literature shows, in strata about as wide as long.
constexpr Strata ray_counts[] = {{5, 20}, {17, 68}, {33, 132}};

using Derivatives = OccludedPlane::Derivatives;
using Field = std::vector<Derivatives>;

double coordinate(std::size_t pixel) { return OccludedPlane::size * (static_cast<double>(pixel) + 0.5) / side; }

template <class At>
Field field(const ParallelFor& parallel, const At& at) {
  Field all(side * side);
  parallel(all.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) all[i] = at(coordinate(i % side), coordinate(i / side), i);
  });
  return all;
}

Derivatives of_jet(const Jet<Rgb>& jet) {
  const auto& g = jet.translational;
  return {luminance(g.x), luminance(g.y), jet.hessian.xx, jet.hessian.xy, jet.hessian.yy};
}

/// Blue under 0, red above, white at 0.
Rgb signed_colour(double t) {
  const auto s = static_cast<float>(std::clamp(std::abs(t), 0.0, 1.0));
  const Rgb pale(1.0f), deep = t < 0 ? Rgb(0.01f, 0.05f, 0.4f) : Rgb(0.4f, 0.01f, 0.02f);
  return pale * (1 - s) + deep * s;
}

double gradient_size(const Derivatives& d) { return std::hypot(d.gx, d.gy); }
double hessian_size(const Derivatives& d) { return std::sqrt(d.hxx * d.hxx + 2 * d.hxy * d.hxy + d.hyy * d.hyy); }

Rgb gradient_colour(const Derivatives& d) {
  return false_colour(static_cast<float>(std::min(1.0, gradient_size(d) / greatest_gradient)));
}
/// The greater (sign 1) or the lesser (-1) eigenvalue, drawn by the root of its size: small ones matter too.
Rgb eigenvalue_colour(const Derivatives& d, int sign) {
  const double value = (d.hxx + d.hyy) / 2 + sign * std::hypot((d.hxx - d.hyy) / 2, d.hxy);
  return signed_colour(std::copysign(std::sqrt(std::abs(value) / greatest_curvature), value));
}

void draw(const std::string& path, const Field& field, const auto& colour) {
  RgbImage image(side, side);
  for (std::size_t i = 0; i < field.size(); ++i) image.pixels[i] = colour(field[i]);
  write_png(path, image, 0);
}

void draw_field(const std::string& stem, const Field& field, bool has_hessian) {
  draw(stem + "-gradient.png", field, gradient_colour);
  if (!has_hessian) return;
  draw(stem + "-greater.png", field, [](const Derivatives& d) { return eigenvalue_colour(d, 1); });
  draw(stem + "-lesser.png", field, [](const Derivatives& d) { return eigenvalue_colour(d, -1); });
}

struct Errors {
  double rms = 0;     ///< over the plane, relative to the truth's own root mean square
  double median = 0;  ///< of what each place is off by, relative to the truth there
};

/// `size` is of a gradient or a Hessian.
Errors errors(const Field& field, const Field& exact, const auto& size) {
  double off = 0, all = 0;
  std::vector<double> relative;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const Derivatives &a = field[i], &b = exact[i];
    const double here = size({a.gx - b.gx, a.gy - b.gy, a.hxx - b.hxx, a.hxy - b.hxy, a.hyy - b.hyy}), truth = size(b);
    off += here * here, all += truth * truth;
    relative.push_back(here / truth);
  }
  std::nth_element(relative.begin(), relative.begin() + relative.size() / 2, relative.end());
  return {std::sqrt(off / all), relative[relative.size() / 2]};
}

std::string json(const Errors& e) { return fmt::format("{{\"rms\": {}, \"median\": {}}}", e.rms, e.median); }

}  // namespace

void draw_derivatives(const std::string& folder, const ParallelFor& parallel) {
  const OccludedPlane plane;
  const Field exact = field(parallel, [&](double x, double y, std::size_t) { return plane.derivatives(x, y); });
  draw_field(folder + "/exact", exact, true);
  for (const char* name :
       {"ward-heckbert-exact", "surface-area-hessian", "triangulated-open", "triangulated", "swept-edges"}) {
    const Estimator& estimator = find_estimator(name);
    for (const Strata& strata : ray_counts) {
      const Field estimated = field(parallel, [&](double x, double y, std::size_t i) {
        return of_jet(estimator.estimate(plane.gather(x, y, strata, i)));
      });
      draw_field(fmt::format("{}/{}-{}", folder, name, strata.size()), estimated, estimator.order > 1);
      fmt::print("{{\"estimator\": \"{}\", \"rays\": {}, \"gradient\": {}, \"hessian\": {}}}\n", name, strata.size(),
                 json(errors(estimated, exact, gradient_size)),
                 estimator.order > 1 ? json(errors(estimated, exact, hessian_size)) : "null");
      std::fflush(stdout);
    }
  }
}

}  // namespace isophote::bench
