#pragma once

#include <cstdint>

#include "isophote/derivatives/gather.h"
#include "support/polygon_irradiance.h"

namespace isophote::bench {

/// The plane z = 0 under an endless dim ceiling with a bright square in it; between them, at different heights, two
/// black squares whose shadows overlap. Irradiance is known in closed form, and its derivatives by finite differences
/// of that.
class OccludedPlane {
 public:
  static constexpr double size = 4;  ///< of the part that matters: [0, size] x [0, size]

  double irradiance(double x, double y) const;

  struct Derivatives {
    double gx, gy, hxx, hxy, hyy;
  };
  Derivatives derivatives(double x, double y) const;

  /// What a record at (x, y) sees.
  HemisphereGather gather(double x, double y, Strata strata, std::uint64_t key) const;

 private:
  /// About the point (x, y, height), its sides turned by an angle: no two squares' are parallel, for where the edge of
  /// a shadow fell along another edge, the gradient would jump.
  struct Square {
    double x, y, side, turn, height;

    test::Polygon corners() const;
    bool contains(double px, double py) const;
  };

  static constexpr double ceiling = 3, dim = 0.1, bright = 1;
  Square emitter_{2, 2, 1.6, 0, ceiling}, low_{1.5, 1.5, 0.9, 0.35, 0.8}, high_{2.4, 2.4, 0.8, 0.9, 1.7};
};

}  // namespace isophote::bench
