#include "isophote/scene/ggx.h"

#include <array>

namespace isophote::ggx {
namespace {

constexpr int nodes = 44;  // of the table along each axis

// Both axes are square roots: the albedo bends most at grazing angles and on smooth surfaces.
using Table = std::array<std::array<SplitSum, nodes>, nodes>;  // [sqrt(alpha)][sqrt(cos)]

/// Points of the disc from which visible normals are made, the half that mirrors the other: a Fibonacci lattice, for
/// the integrand breaks off where reflections pass under the horizon.
constexpr int lattice_points = 987, lattice_step = 610;
using Lattice = std::array<Vec2, lattice_points>;
Lattice make_lattice() {
  Lattice points;
  for (int i = 0; i < lattice_points; ++i)
    points[i] = {(static_cast<float>(i) + 0.5f) / lattice_points,
                 0.5f * static_cast<float>(i * lattice_step % lattice_points) / lattice_points - 0.25f};
  return points;
}

/// The average of Fresnel-weighted G2/G1 over visible normals, whose density turns the albedo into just that.
SplitSum integrate(const Lattice& lattice, float cos_o, float alpha) {
  const Vec3 o{std::sqrt(1 - cos_o * cos_o), 0, cos_o};
  const float g1 = masking(o, alpha);
  double f0 = 0, f90 = 0;
  for (const Vec2& u : lattice) {
    const Vec3 h = sample_visible_normal(o, alpha, u);
    const float oh = dot(o, h);
    const Vec3 i = h * (2 * oh) - o;
    if (!(i.z > 0)) continue;
    const float g = masking_shadowing(o, i, alpha) / g1, across = 1 - oh, squared = across * across;
    const float grazing = squared * squared * across;
    f0 += g * (1 - grazing);
    f90 += g * grazing;
  }
  return {static_cast<float>(f0 / lattice_points), static_cast<float>(f90 / lattice_points)};
}

Table make_table() {
  Table table;
  const Lattice lattice = make_lattice();
  for (int a = 0; a < nodes; ++a)
    for (int c = 0; c < nodes; ++c) {
      // Roughness and cosine 0 are limits, taken just beside.
      const float roughness = std::max(0.5f, static_cast<float>(a)) / (nodes - 1);
      const float root = std::max(0.02f, static_cast<float>(c)) / (nodes - 1);
      table[a][c] = integrate(lattice, root * root, roughness * roughness);
    }
  return table;
}

}  // namespace

SplitSum split_sum(float cos_o, float alpha) {
  static const Table table = make_table();
  const float a = std::sqrt(std::clamp(alpha, 0.0f, 1.0f)) * (nodes - 1),
              c = std::sqrt(std::clamp(cos_o, 0.0f, 1.0f)) * (nodes - 1);
  const int i = std::min(static_cast<int>(a), nodes - 2), j = std::min(static_cast<int>(c), nodes - 2);
  const float s = a - static_cast<float>(i), t = c - static_cast<float>(j);
  const auto blend = [&](float SplitSum::*part) {
    return (1 - s) * ((1 - t) * (table[i][j].*part) + t * (table[i][j + 1].*part)) +
           s * ((1 - t) * (table[i + 1][j].*part) + t * (table[i + 1][j + 1].*part));
  };
  return {blend(&SplitSum::f0), blend(&SplitSum::f90)};
}

}  // namespace isophote::ggx
