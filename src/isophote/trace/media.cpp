#include "isophote/trace/media.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "isophote/core/hash.h"
#include "isophote/sampling/few_choice.h"
#include "isophote/scene/density_grid.h"
#include "isophote/trace/density_walk.h"
#include "isophote/trace/medium_pieces.h"

namespace isophote {
namespace {

/// A stream of numbers for walks whose length nobody knows beforehand.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(hash(seed)) {}
  float next() { return unit_float(static_cast<std::uint32_t>(mix_bits(state_ += 0x9e3779b97f4a7c15ull) >> 32)); }
  /// Exponentially distributed with mean 1.
  float next_depth() { return depth(next()); }
  static float depth(float u) { return -std::log1p(-u); }

 private:
  std::uint64_t state_;
};

/// The next place, in one medium along a ray, at which the medium may turn out to be met.
struct Flight {
  MediumSpan span;
  float rate = 0;   // of tentative collisions per length, at density 1
  float bound = 0;  // on density, there
};

}  // namespace

struct Media::Impl {
  std::span<const Medium> media;
  MediumBounds bounds;
  std::vector<float> emission_rates;  // of tentative collisions per length, at density 1: at least
  Box box;                            // about all bounds

  explicit Impl(std::span<const Medium> all) : media(all), bounds(all) {
    for (const Medium& m : media) {
      emission_rates.push_back(is_black(m.emission) ? 0 : emission_rate(m));
      const Box about = box_about(m);
      box.extend(about.lower), box.extend(about.upper);
    }
  }

  /// What emits is met about four times along its diagonal, if it were as dense as anywhere.
  static float emission_rate(const Medium& medium) {
    const float density = largest_density(medium);
    return density > 0 ? 4 / (box_about(medium).diagonal() * density) : 0;
  }

  /// The point of a piece at a share of it, chosen with the piece's weight over `total` per its size.
  RayPoint point_in(const Ray& ray, const MediumPiece& piece, float share, float total) const {
    const float distance = piece.near + std::clamp(share, 0.0f, 1.0f) * piece.size;
    const Medium& medium = media[piece.medium];
    const Vec3 p = ray.origin + ray.direction * distance;
    const float density = density_at(medium, p);
    return {distance,
            piece.size * total / piece.weight,
            {p, medium.g, piece.medium, {}},
            medium.scattering * density,
            medium.emission * density};
  }

  /// The rate of tentative collisions per length, at density 1, where channels have this throughput: the highest
  /// extinction's, but no more than some times that of a channel which is not black yet, or flights would never end.
  float rate_for(std::uint32_t medium, const Rgb& throughput) const {
    constexpr float smooth = 32;  // weights are the smoother the higher the rate
    const Rgb extinction = media[medium].extinction();
    float lit = 0;
    for (int c = 0; c < 3; ++c)
      if (throughput[c] > 0) lit = std::max(lit, extinction[c]);
    return std::max(emission_rates[medium], std::min(max_component(extinction), smooth * lit));
  }

  /// Moves on to the next tentative collision; false: there is none before the span's end.
  bool fly_on(const Ray& ray, float depth, float rate, Flight& flight) const {
    if (!(rate > 0)) return false;
    flight.rate = rate;
    const FlightEnd end = fly(media[flight.span.medium], ray, flight.span.near, flight.span.far, depth / rate);
    flight.span.near = end.distance, flight.bound = end.bound;
    return end.distance < infinity;
  }
};

Media::Media(const Scene& scene) : impl_(std::make_unique<const Impl>(scene.media)) {}
Media::~Media() = default;
Media::Media(Media&&) noexcept = default;

std::uint32_t Media::holding(const Vec3& p) const {
  std::uint32_t bits = 0;
  constexpr float short_way = 1e-30f;
  const Ray ray{p, {0.6f, 0.64f, 0.48f}, 0, short_way};
  impl_->bounds.visit_spans(ray, [&](const MediumSpan& span) { bits |= 1u << span.medium; });
  return bits;
}

Box Media::bounds() const { return impl_->box; }

Ray Media::within(const Ray& ray) const {
  Ray part{ray.origin, ray.direction, ray.far, ray.near};
  impl_->bounds.visit_spans(ray, [&](const MediumSpan& span) {
    part.near = std::min(part.near, span.near), part.far = std::max(part.far, span.far);
  });
  return part;
}

float Media::anisotropy(std::uint32_t media) const {
  float most = 0;
  for (std::size_t i = 0; i < impl_->media.size(); ++i)
    if (media >> i & 1) most = std::max(most, std::abs(impl_->media[i].g));
  return most;
}

std::optional<MediumPoint> Media::collide(const Ray& ray, Sampler& sampler, Rgb& throughput, Rgb& emission) const {
  thread_local std::vector<Flight> flights;
  flights.clear();
  // The first free flight takes a number of the sampler, whose samples are stratified.
  float depth = Numbers::depth(sampler.next());
  Numbers numbers(sampler.next_bits());
  impl_->bounds.visit_spans(ray, [&](const MediumSpan& span) {
    Flight flight{span};
    if (impl_->fly_on(ray, depth, impl_->rate_for(span.medium, throughput), flight)) flights.push_back(flight);
    depth = numbers.next_depth();
  });
  while (!flights.empty()) {
    const auto at = std::min_element(flights.begin(), flights.end(),
                                     [](const Flight& a, const Flight& b) { return a.span.near < b.span.near; });
    const Medium& medium = impl_->media[at->span.medium];
    const Vec3 p = ray.origin + ray.direction * at->span.near;
    // Shares of tentative collisions here that scatter and that are none; the rest absorbs.
    const float share = std::min(1.0f, density_at(medium, p) / at->bound), rate = at->rate;
    const Rgb scatters = medium.scattering * (share / rate);
    const Rgb none = max(Rgb(1.0f) - medium.extinction() * (share / rate), Rgb{});
    emission += throughput * medium.emission * (share / rate);
    const float scattered = mean(throughput * scatters), passed = mean(throughput * none);
    if (!(scattered + passed > 0)) {
      throughput = {};
      return std::nullopt;
    }
    const float chance = scattered / (scattered + passed);
    if (numbers.next() < chance) {
      throughput *= scatters / chance;
      return MediumPoint{p, medium.g, at->span.medium, {}};
    }
    throughput *= none / (1 - chance);
    if (!impl_->fly_on(ray, numbers.next_depth(), impl_->rate_for(at->span.medium, throughput), *at)) flights.erase(at);
  }
  return std::nullopt;
}

Rgb Media::transmittance(const Ray& ray, std::uint32_t seed) const {
  Rgb passed(1.0f);
  Numbers numbers(seed);
  impl_->bounds.visit_spans(ray, [&](const MediumSpan& span) {
    const Medium& medium = impl_->media[span.medium];
    const Rgb extinction = medium.extinction();
    if (!std::holds_alternative<GridDensity>(medium.density)) {
      passed *= exp(extinction * -static_cast<float>(columns(medium, ray, span.near, span.far).density));
      return;
    }
    const float rate = max_component(extinction);
    for (Flight flight{span}; impl_->fly_on(ray, numbers.next_depth(), rate, flight);) {
      const float density = density_at(medium, ray.origin + ray.direction * flight.span.near);
      passed *= max(Rgb(1.0f) - extinction * (std::min(1.0f, density / flight.bound) / rate), Rgb{});
      if (is_black(passed)) return;
    }
  });
  return passed;
}

// With y at distance r along w, log T = -sigma_t c for a column c of density, and
//   grad c = -density(x) w + P int_0^r (1 - s/r) grad density ds,   P across w;
// a bound of normal n that the ray leaves at s adds -(1 - s/r) density P n / (n.w), one where it enters the opposite.
void Media::along(const Ray& ray, std::span<const float> depths, std::span<Passage> passages) const {
  std::fill(passages.begin(), passages.end(), Passage{});
  const Vec3d w(ray.direction);
  const auto add = [&](const Medium& medium, std::size_t i, const Columns& sum, const Vec3d& bound_moves, float here) {
    const double inverse = 1 / static_cast<double>(depths[i]);
    const Vec3d across = sum.gradient - sum.gradient_moment * inverse + bound_moves;
    const Vec3d slope = w * static_cast<double>(here) - (across - w * dot(w, across));
    const Rgb sigma = medium.extinction();
    Passage& p = passages[i];
    p.transmittance *= exp(sigma * -static_cast<float>(sum.density));
    p.log_gradient.x += sigma * static_cast<float>(slope.x);
    p.log_gradient.y += sigma * static_cast<float>(slope.y);
    p.log_gradient.z += sigma * static_cast<float>(slope.z);
  };
  impl_->bounds.visit_spans(ray, [&](const MediumSpan& span) {
    const Medium& medium = impl_->media[span.medium];
    const float here = span.near > ray.near ? 0 : density_at(medium, ray.origin);
    Columns sum;
    float from = span.near;
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const float to = std::min(span.far, depths[i]);
      if (to > from) sum += columns(medium, ray, from, to), from = to;
      if (!(depths[i] > span.near)) continue;
      const double inverse = 1 / static_cast<double>(depths[i]);
      const auto moved = [&](const Vec3& normal, float s) {
        const double along_w = dot(Vec3d(normal), w);
        const double density = density_at(medium, ray.origin + ray.direction * s);
        return Vec3d(normal) * (along_w != 0 ? (1 - s * inverse) * density / along_w : 0.0);
      };
      Vec3d bounds;
      if (span.near > ray.near) bounds += moved(span.near_normal, span.near);
      if (depths[i] > span.far) bounds -= moved(span.far_normal, span.far);
      add(medium, i, sum, bounds, here);
    }
  });
}

std::optional<Media::Scatterer> Media::scatterer(const Vec3& p, float u) const {
  const std::uint32_t held = holding(p);
  std::array<float, FewChoice::most> densities{};
  const FewChoice choice(impl_->media.size(), [&](std::uint32_t i) {
    if (held >> i & 1) densities[i] = density_at(impl_->media[i], p);
    return mean(impl_->media[i].scattering) * densities[i];
  });
  if (choice.empty()) return std::nullopt;
  const std::uint32_t chosen = choice.sample(u);
  const Medium& medium = impl_->media[chosen];
  return Scatterer{{p, medium.g, chosen, {}}, medium.scattering * (densities[chosen] / choice.chance(chosen))};
}

Rgb Media::extinction(const Vec3& p) const {
  Rgb sum;
  const std::uint32_t held = holding(p);
  for (std::size_t i = 0; i < impl_->media.size(); ++i)
    if (held >> i & 1) sum += impl_->media[i].extinction() * density_at(impl_->media[i], p);
  return sum;
}

Rgb Media::emission(const Vec3& p) const {
  Rgb sum;
  const std::uint32_t held = holding(p);
  for (std::size_t i = 0; i < impl_->media.size(); ++i)
    if (held >> i & 1 && !is_black(impl_->media[i].emission))
      sum += impl_->media[i].emission * density_at(impl_->media[i], p);
  return sum;
}

std::span<const Media::RayPoint> Media::sample_points(const Ray& ray, int count, Sampler& sampler) const {
  constexpr int pieces = 16;  // of a span
  thread_local std::vector<MediumPiece> along;
  thread_local std::vector<RayPoint> points;
  along.clear(), points.clear();
  impl_->bounds.visit_spans(ray,
                            [&](const MediumSpan& span) { cut(impl_->media[span.medium], ray, span, pieces, along); });
  const float total = weigh(along);
  if (!(total > 0)) return points;
  const float shift = sampler.next();
  float before = 0;
  auto piece = along.begin();
  for (int i = 0; i < count; ++i) {
    const float at = total * (static_cast<float>(i) + shift) / static_cast<float>(count);
    while (std::next(piece) != along.end() && at >= before + piece->weight) before += (piece++)->weight;
    if (piece->weight > 0)
      points.push_back(impl_->point_in(ray, *piece, (at - before) / piece->weight, total / static_cast<float>(count)));
  }
  return points;
}

std::span<const Media::RayPoint> Media::sample_parts(const Ray& ray, std::span<const float> ends,
                                                     Sampler& sampler) const {
  constexpr int pieces = 4;  // of a span's piece in each part
  thread_local std::vector<std::vector<MediumPiece>> parts;
  thread_local std::vector<RayPoint> points;
  if (parts.size() < ends.size()) parts.resize(ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) parts[i].clear();
  impl_->bounds.visit_spans(ray, [&](const MediumSpan& span) {
    float from = span.near;
    for (std::size_t i = 0; i < ends.size() && from < span.far; ++i) {
      const float to = std::min(span.far, ends[i]);
      if (!(from < to)) continue;
      cut(impl_->media[span.medium], ray, {from, to, span.medium}, pieces, parts[i]);
      from = to;
    }
  });
  points.assign(ends.size(), {});
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const float total = weigh(parts[i]);
    if (!(total > 0)) continue;
    const float at = total * sampler.next();
    float before = 0;
    auto piece = parts[i].begin();
    while (std::next(piece) != parts[i].end() && at >= before + piece->weight) before += (piece++)->weight;
    if (piece->weight > 0) points[i] = impl_->point_in(ray, *piece, (at - before) / piece->weight, total);
  }
  return points;
}

}  // namespace isophote
