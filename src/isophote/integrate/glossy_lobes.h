#pragma once

#include <vector>

#include "isophote/cache/lobe.h"
#include "isophote/core/rgb.h"
#include "isophote/harmonics/basis.h"
#include "isophote/scene/bsdf.h"

namespace isophote {

/// The glossy lobe of the material model (bsdf.h) in a basis: GGX under Schlick's Fresnel term is f0 times one function
/// plus f90 times another, whose coefficients are tabulated over roughness and the cosine of the viewer.
class GlossyLobes {
 public:
  explicit GlossyLobes(Basis basis);

  /// Of alpha there are tables from here to 1.
  static constexpr float least_alpha = 0.15f;

  /// The lobe at `alpha` seen from `cos_o`, with reflectances `f0` and `f90`. lobe.order says how many bands.
  void set(Lobe& lobe, float alpha, float cos_o, const Rgb& f0, const Rgb& f90) const;

  /// What the first `order` bands miss of the lobe (of f0 = 1, f90 = 0), relative, in the root of the mean square: of
  /// all orders, by [order].
  class Truncation;
  Truncation truncation(float alpha, float cos_o) const;

 private:
  struct Node {
    std::array<float, polar_count(most_order)> by_f0, by_f90;
  };
  /// Four nodes and what each counts for.
  struct Place {
    std::array<int, 4> at;
    std::array<float, 4> weights;
    Place(float alpha, float cos_o);
  };

  std::vector<Node> nodes_;
  std::vector<float> truncation_;  // of the nodes, an order after the other
};

class GlossyLobes::Truncation {
 public:
  float operator[](int order) const;

 private:
  friend class GlossyLobes;
  Truncation(const GlossyLobes& lobes, const Place& place) : lobes_(&lobes), place_(place) {}

  const GlossyLobes* lobes_;
  Place place_;
};

/// The tables of a basis, made when first asked for.
const GlossyLobes& glossy_lobes(Basis basis);

/// The lobe of a surface towards a viewer, as records with other normals need it (RadianceCache::reflect): for another
/// elevation, but reflecting as much light as at the surface's own; windowed, where asked.
class SurfaceLobe {
 public:
  SurfaceLobe(const GlossyLobes& lobes, const Bsdf& bsdf, const Vec3& wo, bool window)
      : lobes_(lobes), bsdf_(bsdf), albedo_(specular_albedo(bsdf, dot(wo, bsdf.frame.n))), window_(window) {}

  void operator()(Lobe& lobe, float cosine) const;

 private:
  const GlossyLobes& lobes_;
  const Bsdf& bsdf_;
  Rgb albedo_;
  bool window_;
};

}  // namespace isophote
