#include "isophote/derivatives/marco_2018.h"

#include <algorithm>

#include "isophote/core/check.h"
#include "isophote/derivatives/layer_mesh.h"
#include "isophote/derivatives/moving_walls.h"
#include "isophote/derivatives/solid_angle.h"

namespace isophote {
namespace {

/// What edges have to know of a triangle beside them: its light per solid angle, weighed, and the gradient of that in
/// luminance.
struct Triangle {
  Rgbd light;
  Vec3d slope;
};

/// The light of a layer's triangles: sum of light times solid angle. What changes light is added triangle by triangle,
/// what changes the solid angle edge by edge.
class LayerSum {
 public:
  LayerSum(const Lobe& lobe, int layer, WeighedCurvature& sum) : lobe_(lobe), layer_(layer), sum_(sum) {}

  Triangle triangle(const LayerVertex& a, const LayerVertex& b, const LayerVertex& c) const;
  void edge(const LayerVertex& a, const LayerVertex& b, const Triangle& left, const Triangle& right) const;

 private:
  /// The first shell's curvature grows without bounds with the depth's inverse; `add_ball` has it whole.
  bool curved() const { return layer_ != 1; }

  const Lobe& lobe_;
  int layer_;
  WeighedCurvature& sum_;
};

Triangle LayerSum::triangle(const LayerVertex& a, const LayerVertex& b, const LayerVertex& c) const {
  constexpr double far = 0.85;
  const double farthest = std::max({a.depth, b.depth, c.depth});
  Rgbd light;
  Vec3d middle;
  Gradient<Rgbd> emitted;
  int count = 0, lit = 0;
  for (const LayerVertex* v : {&a, &b, &c}) {
    if (v->depth < far * farthest) continue;
    light += v->radiance, middle += v->position(), ++count;
    lit += !is_black(v->radiance);
    add(emitted, v->emitted, 1);
  }
  if (lit == 0) return {};
  middle = middle / count;
  const double r = length(middle);
  const Vec3d w = middle / r, logarithmic = luminance_of(emitted) / luminance(light);
  const LobeFactor lobe(lobe_, w, r);
  light = light * (lobe.value / count);
  Gradient<Rgbd> slope;
  add(slope, emitted, lobe.value / count);
  add(slope, lobe.gradient, light);
  const Triangle t{light, luminance_of(slope)};
  const double angle = solid_angle(a.position(), b.position(), c.position()), bright = luminance(light);
  add(sum_.gradient, slope, angle);
  if (!curved()) return t;
  Sym3d curvature = Sym3d::outer(t.slope / bright, 1) + lobe.hessian + log_hessian(w, r, logarithmic, layer_ == 0);
  if (layer_ > 0) {
    // A triangle's solid angle changes with its tilt too; that of a place in a medium does not.
    curvature += Sym3d::across(w) * (1 / (r * r));
    if (lit == 3) curvature += turning_hessian(w, r, {a.direction, b.direction, c.direction}, {a.turn, b.turn, c.turn});
  }
  sum_.hessian += curvature * (bright * angle);
  return t;
}

void LayerSum::edge(const LayerVertex& a, const LayerVertex& b, const Triangle& left, const Triangle& right) const {
  if (left.light == right.light && left.slope == right.slope) return;
  const SolidAngleEdge e(a.position(), b.position());
  const Rgbd step = left.light - right.light;
  add(sum_.gradient, e.gradient, step);
  if (curved())
    sum_.hessian += e.hessian * luminance(step) + Sym3d::symmetric_outer(left.slope - right.slope, e.gradient, 1);
}

/// The source at the end of the first shell, where the second begins, per depth, in luminance; none where a surface is
/// nearer.
struct BallSurface {
  double depth = 0, radiance = 0;
  Vec3d log_gradient;

  BallSurface(const SphereGather& gather, std::size_t sample) : depth(static_cast<double>(gather.shell_ends[0])) {
    const double end = static_cast<double>(std::min(gather.shell_ends[1], gather.samples[sample].distance));
    if (!(end > depth)) return;
    const Vec3d w(gather.samples[sample].direction);
    const GatherLayer* layers = &gather.layers[sample * static_cast<std::size_t>(gather.shells + 1)];
    const GatherLayer &inner = layers[1], &outer = layers[2];
    const double inside = luminance(Rgbd(inner.radiance)) / depth;
    const double outside = luminance(Rgbd(outer.radiance)) / (end - depth);
    const double share = (depth - static_cast<double>(inner.depth)) / static_cast<double>(outer.depth - inner.depth);
    radiance = inside + (outside - inside) * share;
    const GatherLayer& lit = outside > 0 ? outer : inner;
    const double light = luminance(Rgbd(lit.radiance));
    if (!(light > 0)) return;
    log_gradient = luminance_of(times(lit.log_gradient, Rgbd(lit.radiance))) / light;
    // Sources turn by the inverse of distance.
    const Vec3d turned = across(w, log_gradient);
    log_gradient += turned * (static_cast<double>(lit.depth) / depth - 1);
  }
};

/// What a medium within the first shell adds: to the gradient, the source at the record; to the Hessian, by the theorem
/// of Gauss, what crosses the shell's end. But for terms that vanish with its radius.
void add_ball(const SphereGather& gather, const Lobe& lobe, WeighedCurvature& sum) {
  for (std::size_t i = 0; i < gather.samples.size(); ++i) {
    const Vec3d w(gather.samples[i].direction);
    const double first = gather.shell_ends.empty() ? 1 : static_cast<double>(gather.shell_ends[0]);
    const LobeFactor factor(lobe, w, first);
    const double weight = cell_size(gather) * factor.value;
    add(sum.gradient, w, Rgbd(gather.sources[i]) * -weight);
    if (gather.shells < 2) continue;
    const BallSurface s(gather, i);
    const Vec3d change = factor.gradient + s.log_gradient + w * (2 / s.depth);
    sum.hessian += Sym3d::symmetric_outer(change, w, -weight * s.radiance / 2);
  }
}

}  // namespace

WeighedCurvature weigh_triangles(const SphereGather& gather, VolumePart part, const Lobe& lobe) {
  WeighedCurvature sum;
  LayerMesh<Triangle> mesh(gather);
  const LayerRange range(gather, part);
  for (int l = range.first; l < range.last; ++l) {
    if (!mesh.set_vertices(l)) continue;
    const LayerSum layer(lobe, l, sum);
    mesh.set_triangles([&](const auto& a, const auto& b, const auto& c) { return layer.triangle(a, b, c); });
    mesh.for_each_edge([&](const auto& a, const auto& b, const Triangle& left, const Triangle& right) {
      layer.edge(a, b, left, right);
    });
  }
  if (part == VolumePart::media) add_ball(gather, lobe, sum);
  return sum;
}

VolumeJet marco_2018(const SphereGather& gather, VolumePart part, int order) {
  ISOPHOTE_CHECK(order, >, 0);
  VolumeJet jet = moving_walls(gather, part, order);
  const WeighedCurvature mean = weigh_triangles(gather, part);
  // The first harmonic is 1 / sqrt(4 pi) everywhere.
  const double to_coefficient = std::sqrt(4 * std::numbers::pi);
  jet.translational.x[0] = Rgb(mean.gradient.x * to_coefficient);
  jet.translational.y[0] = Rgb(mean.gradient.y * to_coefficient);
  jet.translational.z[0] = Rgb(mean.gradient.z * to_coefficient);
  jet.hessian = Sym3(mean.hessian);
  return jet;
}

}  // namespace isophote
