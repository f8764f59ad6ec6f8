#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numbers>

#include "isophote/core/sym3.h"

namespace isophote {

/// How much a record counts as the error t at the query grows from 0 to 1. `ward` is 1/t - 1 [Ward, Rubinstein, Clear
/// 1988, shifted to reach 0 at the rim, so that nothing pops]; `tent` is 1 - t; `tabellion` is a tent over the larger
/// of the two parts of t, of which that of the normals reaches 1 at ten degrees [Tabellion, Lamorlette 2004]; `smooth`
/// is 3 d^2 - 2 d^3 of d = 1 - t, whose slope vanishes at the rim and at the record [Jarosz 2008a].
enum class Falloff : std::uint8_t { ward, tent, tabellion, smooth };

/// Where a record may be used. A record at x_i with normal n_i serves a query (x, n) whose error
///   t = sqrt(q . shape q) + normal_scale * |n - n_i| / sqrt(2),   q = x - x_i
/// (or the larger of the two, if the falloff says so) is under 1. Lookup reads nothing else, so it needs to know no
/// method.
struct Footprint {
  Sym3 shape;
  float normal_scale = 0;
  float radius = 0;    ///< the longest semi-axis of the region where t < 1 for equal normals
  float unscaled = 0;  ///< the radius before the wanted error and pixel limits shaped it; neighbours limit this one
  float smallest = 0;  ///< bounds that `radius` keeps when it is changed
  float largest = std::numeric_limits<float>::infinity();
  Falloff falloff = Falloff::ward;
  std::uint8_t order = 0;  ///< 0: the value alone; 1: extrapolated by its gradients; 2: and by its Hessian
  /// Of records in media: extrapolated and averaged in the value's logarithm, in which what decays exponentially is
  /// linear [Jarosz 2008a].
  bool logarithmic = false;

  /// A round footprint on surfaces.
  static Footprint disk(float radius, float normal_scale) {
    Footprint f;
    f.shape = Sym3::scaled_identity(1 / (radius * radius));
    f.normal_scale = normal_scale;
    f.radius = radius;
    return f;
  }

  /// A round footprint in media, where there are no normals.
  static Footprint ball(float radius) {
    Footprint f = disk(radius, 0);
    f.unscaled = radius;
    f.falloff = Falloff::smooth;
    return f;
  }

  /// t from its two parts: by the way from the record, and by the turn of the normal.
  float combine(float away, float turned) const {
    return falloff == Falloff::tabellion ? std::max(away, turned) : away + turned;
  }

  /// Another falloff than the metric's, with what belongs to it.
  void set_falloff(Falloff wanted) {
    falloff = wanted;
    if (falloff == Falloff::tabellion) normal_scale = 1 / std::sqrt(1 - std::cos(std::numbers::pi_v<float> / 18));
  }

  /// Has the region end at `height` along the unit vector n, which is one of its axes; across it stays as it is.
  void flatten(const Vec3& n, float height) {
    shape = shape + Sym3::outer(n, 1 / (height * height) - quadratic_form(shape, n));
  }

  /// Scales the region so that its radius is `wanted`, or the nearest of its bounds.
  void resize(float wanted) {
    wanted = std::max(smallest, std::min(largest, wanted));
    const float ratio = radius / wanted;
    shape = shape * (ratio * ratio);
    radius = wanted;
  }
};

/// Of the scene's diagonal: what is left of a radius where everything would shrink it to nothing, as in a black corner.
inline constexpr float smallest_radius = 1e-5f;

/// What a few places of the picture say of all, in the mean over visible points: for metrics that aim at a mean error.
struct Pilot {
  bool known = false;    ///< there was a survey
  float error_rate = 0;  ///< error for unit threshold, 1/length: see total_error.h
  float irradiance = 0;  ///< luminance
  float noise_rate = 0;  ///< of rays that adapt: see adaptive_rays.h

  bool operator==(const Pilot&) const = default;
};

/// How a record is seen when its footprint is decided.
struct View {
  float pixel = 0;        ///< length that a pixel spans at the record, along the path through mirrors and glass
  float picture = 0;      ///< length that the picture's height spans there
  float scene_scale = 1;  ///< diagonal of the scene's bounds
  Vec3 normal{0, 0, 1};   ///< of the record, unit
  Pilot pilot{};
};

}  // namespace isophote
