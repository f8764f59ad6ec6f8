#pragma once

#include <algorithm>
#include <cmath>

#include "isophote/core/ray.h"
#include "isophote/core/vec.h"

/// The GGX microfacet distribution [Walter 2007] with Smith's height-correlated masking and shadowing [Heitz 2014].
/// Directions are local, z along the normal, on the upper side; `alpha` is the roughness squared.
namespace isophote::ggx {

/// Density of microfacet normals: D(h) cos(h) integrates to 1 over the hemisphere.
template <class T>
T distribution(const Vec3T<T>& h, T alpha) {
  // Written with the components across the normal, which do not cancel near the peak of a nearly smooth surface.
  const T a2 = alpha * alpha, e = (h.x * h.x + h.y * h.y) / a2 + h.z * h.z;
  return T(1) / (T(pi) * a2 * e * e);
}

/// Smith's Lambda.
template <class T>
T lambda(const Vec3T<T>& w, T alpha) {
  const T tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}
template <class T>
T masking(const Vec3T<T>& w, T alpha) {
  return 1 / (1 + lambda(w, alpha));
}
template <class T>
T masking_shadowing(const Vec3T<T>& o, const Vec3T<T>& i, T alpha) {
  return 1 / (1 + lambda(o, alpha) + lambda(i, alpha));
}

/// A microfacet normal visible from `o`, with density G1(o) max(0, o.h) D(h) / o.z in solid angle [Heitz 2018].
template <class T>
Vec3T<T> sample_visible_normal(const Vec3T<T>& o, T alpha, T u1, T u2) {
  const Vec3T<T> stretched = normalize(Vec3T<T>{alpha * o.x, alpha * o.y, o.z});
  const T across = stretched.x * stretched.x + stretched.y * stretched.y;
  const Vec3T<T> t1 = across > 0 ? Vec3T<T>{-stretched.y, stretched.x, 0} / std::sqrt(across) : Vec3T<T>{1, 0, 0};
  const Vec3T<T> t2 = cross(stretched, t1);
  const T r = std::sqrt(u1), phi = 2 * T(pi) * u2, p1 = r * std::cos(phi), s = (1 + stretched.z) / 2;
  const T p2 = (1 - s) * std::sqrt(std::max(T(0), 1 - p1 * p1)) + s * r * std::sin(phi);
  const Vec3T<T> h = t1 * p1 + t2 * p2 + stretched * std::sqrt(std::max(T(0), 1 - p1 * p1 - p2 * p2));
  return normalize(Vec3T<T>{alpha * h.x, alpha * h.y, std::max(T(0), h.z)});
}
inline Vec3 sample_visible_normal(const Vec3& o, float alpha, Vec2 u) {
  return sample_visible_normal(o, alpha, u.x, u.y);
}

/// Directional albedo of the lobe under Schlick's Fresnel term: f0 * .f0 + f90 * .f90. From a table, to about 1e-3 but
/// at the most grazing angles.
struct SplitSum {
  float f0 = 0, f90 = 0;
};
SplitSum split_sum(float cos_o, float alpha);

}  // namespace isophote::ggx
