#include "isophote/validity/limit_extrapolation.h"

#include <algorithm>

#include "isophote/validity/gradient_radius.h"

namespace isophote {
namespace {

/// A channel that is next to nothing beside the others may change by more than itself: nobody sees it.
constexpr float least_channel = 0.05f;

Rgb squares(const Coefficients& all) {
  Rgb sum;
  for (const Rgb& c : all) sum += c * c;
  return sum;
}
/// Of the most that a gradient brings each to within a footprint: with d.(shape d) = 1, (g.d)^2 is at most
/// g.(shape^-1 g).
Rgb squares(const Gradient<Coefficients>& g, const Footprint& footprint) {
  const Sym3d reach = inverse(Sym3d(footprint.shape));
  Rgbd sum;
  for (std::size_t i = 0; i < g.x.size(); ++i)
    for (int c = 0; c < 3; ++c) sum[c] += quadratic_form(reach, Vec3d(Vec3{g.x[i][c], g.y[i][c], g.z[i][c]}));
  return Rgb(sum);
}
Rgb root(const Rgb& c) { return {std::sqrt(c.r), std::sqrt(c.g), std::sqrt(c.b)}; }

}  // namespace

void limit_extrapolation(Record& record, float natural_radius) {
  const auto& g = record.jet.translational;
  const Rgb& value = record.jet.value;
  const float radius = record.footprint.radius;
  const float least = least_channel * luminance(value);
  float scale = std::min(1.0f, natural_radius / radius);
  for (int c = 0; c < 3; ++c) {
    const float change = length(Vec3{g.x[c], g.y[c], g.z[c]}) * radius, room = std::max(value[c], least);
    if (change > room) scale = std::min(scale, room / change);
  }
  record.gradient_scale = scale;
  const float l = luminance(value), bend = norm(record.jet.hessian) * radius * radius / 2;
  constexpr float most_bend = 0.25f;  // of the value: beyond, a parabola says little
  const float left = bend > most_bend * l ? most_bend * l / bend : 1.0f;
  record.curvature_scale = std::min(scale * scale, left) * Record::whole_curvature(value);
}

void limit_extrapolation(RadianceRecord& record, float natural_radius) {
  const float radius = record.footprint.radius, change = radius / gradient_radius(record.jet);
  record.gradient_scale = std::min({1.0f, natural_radius / radius, change > 1 ? 1 / change : 1});
}

void limit_extrapolation(VolumeRecord& record) {
  const Rgb value = root(squares(record.jet.value)), change = root(squares(record.jet.translational, record.footprint));
  const float least = least_channel * luminance(value);
  record.gradient_scale = 1;
  for (int c = 0; c < 3; ++c) {
    const float room = std::max(value[c], least);
    if (change[c] > room) record.gradient_scale = std::min(record.gradient_scale, room / change[c]);
  }
}

}  // namespace isophote
