// What both estimators of edges are made of, against closed forms known beforehand (finite differences agree to 1e-10).
#include "isophote/derivatives/edge.h"

#include <gtest/gtest.h>

#include <vector>

#include "isophote/derivatives/lambert_sum.h"

namespace isophote::test {
namespace {

struct KnownDerivatives {
  const char* name;
  Vec3d x;
  std::vector<Vec3d> corners;  // of a polygon of radiance 1, counter-clockwise seen from above
  double gx, gy, gz, xx, xy, yy;
};
const KnownDerivatives polygons[] = {
    {"square overhead",
     {0.3, -0.2, 0},
     {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
     -0.414851968608,
     0.267292664068,
     1.467146217812,
     -1.435884297798,
     -0.072378257435,
     -1.364646682658},
    {"wall",
     {0.2, 0.1, 0},
     {{1, -1, 0.1}, {1, 1, 0.1}, {1, 1, 2}, {1, -1, 2}},
     0.726971515731,
     -0.053900412262,
     0.079727980511,
     0.647744396670,
     -0.045030087279,
     -0.542184647367},
    {"triangle",
     {0, 0, 0},
     {{1, 0.2, 0.8}, {0.3, 1.1, 1.5}, {-0.6, -0.4, 1.1}},
     0.090876697676,
     0.427757706226,
     0.625744248879,
     -0.813714422519,
     0.401003769819,
     -0.875355631511},
};
constexpr double tolerance = 1e-10;

TEST(LambertSum, OfPolygonsAndOfOneEdge) {
  for (const KnownDerivatives& p : polygons) {
    LambertSum sum;
    for (std::size_t i = 0; i < p.corners.size(); ++i)
      sum.add(p.corners[i] - p.x, p.corners[(i + 1) % p.corners.size()] - p.x, Rgbd(1), {});
    EXPECT_NEAR(sum.gradient.u.r, p.gx, tolerance) << p.name;
    EXPECT_NEAR(sum.gradient.v.r, p.gy, tolerance) << p.name;
    EXPECT_NEAR(sum.hessian.uu, p.xx, tolerance) << p.name;
    EXPECT_NEAR(sum.hessian.uv, p.xy, tolerance) << p.name;
    EXPECT_NEAR(sum.hessian.vv, p.yy, tolerance) << p.name;
  }
  LambertSum edge;
  edge.add({1, 0.2, 0.8}, {0.3, 1.1, 1.5}, Rgbd(1), {});
  EXPECT_NEAR(edge.gradient.u.r, -0.039043105881, tolerance);
  EXPECT_NEAR(edge.gradient.v.r, -0.036713061466, tolerance);
  EXPECT_NEAR(edge.hessian.uu, -0.235801584893, tolerance);
  EXPECT_NEAR(edge.hessian.uv, -0.062544138887, tolerance);
  EXPECT_NEAR(edge.hessian.vv, -0.257055790045, tolerance);
}

// Round a closed outline what the edges sweep adds up to the same, with the component along the normal too.
TEST(EdgeMoments, SweptRoundPolygons) {
  for (const KnownDerivatives& p : polygons) {
    Vec3d gradient;
    double xx = 0, xy = 0, yy = 0;
    for (std::size_t i = 0; i < p.corners.size(); ++i) {
      const Vec3d a = p.corners[i] - p.x, b = p.corners[(i + 1) % p.corners.size()] - p.x;
      Edge e;
      ASSERT_TRUE(e.set(a, b, std::atan2(length(cross(a, b)), dot(a, b))));
      const EdgeMoments s(e);  // e.c points into the polygon
      gradient += e.c * ((s.s20 * e.m.z + s.s11 * e.t.z) / e.h);
      const Vec3d q = e.m * (s.s40 * e.m.z + s.s31 * e.t.z) + e.t * (s.s31 * e.m.z + s.s22 * e.t.z);
      const double second = 2 / (e.h * e.h);
      xx += second * 2 * e.c.x * q.x, xy += second * (e.c.x * q.y + e.c.y * q.x), yy += second * 2 * e.c.y * q.y;
    }
    EXPECT_NEAR(gradient.x, p.gx, tolerance) << p.name;
    EXPECT_NEAR(gradient.y, p.gy, tolerance) << p.name;
    EXPECT_NEAR(gradient.z, p.gz, tolerance) << p.name;
    EXPECT_NEAR(xx, p.xx, tolerance) << p.name;
    EXPECT_NEAR(xy, p.xy, tolerance) << p.name;
    EXPECT_NEAR(yy, p.yy, tolerance) << p.name;
  }
}

}  // namespace
}  // namespace isophote::test
