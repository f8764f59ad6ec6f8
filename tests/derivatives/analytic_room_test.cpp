// The room that the derivatives are tested in, itself against values known beforehand to the digits given.
#include "support/analytic_room.h"

#include <gtest/gtest.h>

namespace isophote::test {
namespace {

constexpr Vec3d up{0, 0, 1};
using Walls = AnalyticRoom::Walls;

struct PolygonCase {
  Polygon polygon;
  Vec3d x;
  double irradiance;
  Vec3d gradient;
};

TEST(AnalyticRoom, LambertPolygons) {
  const PolygonCase cases[] = {
      {{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
       {0.3, -0.2, 0},
       1.651626343464,
       {-0.414851968608, 0.267292664068, 1.467146217812}},
      {{{1, -1, 0.1}, {1, 1, 0.1}, {1, 1, 2}, {1, -1, 2}},
       {0.2, 0.1, 0},
       0.721271460988,
       {0.726971515731, -0.053900412262, 0.079727980511}},
      {{{1, 0.2, 0.8}, {0.3, 1.1, 1.5}, {-0.6, -0.4, 1.1}},
       {0, 0, 0},
       0.493744730098,
       {0.090876697676, 0.427757706226, 0.625744248879}},
  };
  for (const PolygonCase& c : cases) {
    EXPECT_NEAR(lambert_integral(c.x, up, c.polygon), c.irradiance, 1e-12);
    EXPECT_NEAR(gauss_integral(c.x, up, c.polygon, [](const Vec3d&) { return 1.0; }), c.irradiance, 1e-12);
    for (int axis = 0; axis < 3; ++axis) {
      const auto moved = [&](double h) {
        Vec3d x = c.x;
        x[axis] += h;
        return lambert_integral(x, up, c.polygon);
      };
      EXPECT_NEAR(central_difference(moved, 1e-3), c.gradient[axis], 1e-9) << "axis " << axis;
    }
  }
}

TEST(AnalyticRoom, KnownIrradianceAndGradients) {
  const struct {
    Walls walls;
    bool rectangle;
    double irradiance[4], gradient[4][2];
  } rows[] = {
      {Walls::constant,
       false,
       {2.1919945554, 1.9059938627, 2.0842074433, 1.6728093267},
       {{-0.26845357, 0.01519756}, {-0.19694846, -0.18228988}, {-0.25358938, -0.13055802}, {-0.18501189, -0.25745498}}},
      {Walls::constant,
       true,
       {2.1209047733, 1.3429860021, 1.8040687713, 1.4182249183},
       {{-0.44437761, -0.12514205}, {-0.17127526, -0.18296331}, {-0.82394464, -0.25368712}, {0.14217830, 0.00070783}}},
      {Walls::smooth,
       false,
       {2.4641783461, 1.9752959618, 2.2252884194, 1.7222570177},
       {{-0.49848072, -0.15857032},
        {-0.25588382, -0.21736148},
        {-0.37572290, -0.26253987},
        {-0.18898691, -0.23833098}}},
      {Walls::smooth,
       true,
       {2.3837873572, 1.4173150979, 1.9510436812, 1.4560302465},
       {{-0.68797485, -0.29598643}, {-0.24994298, -0.26435470}, {-0.93287732, -0.32691458}, {0.14241986, 0.00433854}}},
  };
  for (const auto& row : rows) {
    const AnalyticRoom room(row.walls, row.rectangle);
    for (int i = 0; i < 4; ++i) {
      const FloorPoint& p = floor_points[i];
      SCOPED_TRACE(p.name);
      const Vec3d g = room.gradient(p.x, p.y);
      EXPECT_NEAR(room.irradiance(p.x, p.y), row.irradiance[i], 1e-8);
      EXPECT_NEAR(g.x, row.gradient[i][0], 1e-6);
      EXPECT_NEAR(g.y, row.gradient[i][1], 1e-6);
    }
  }
}

TEST(AnalyticRoom, KnownHessians) {
  const struct {
    Walls walls;
    bool rectangle;
    double hessian[4][3];  // xx, xy, yy
  } rows[] = {{Walls::constant,
               false,
               {{0.173994, -0.075478, -0.267732},
                {0.040751, -0.006467, -0.214166},
                {0.128143, -0.040101, -0.258933},
                {-0.020545, 0.041021, -0.177078}}},
              {Walls::constant,
               true,
               {{-0.160710, -0.460830, -0.373704},
                {1.462238, -0.008175, 1.343090},
                {-0.378163, -0.294826, 0.412784},
                {-0.130181, -0.421810, 0.009483}}},
              {Walls::smooth,
               false,
               {{0.428064, -0.056868, -0.222373},
                {0.075287, 0.105955, -0.179683},
                {0.254683, 0.106794, -0.233009},
                {0.014645, 0.060098, -0.195153}}},
              {Walls::smooth,
               true,
               {{0.131824, -0.426007, -0.251101},
                {1.510418, -0.041752, 1.387961},
                {-0.277978, -0.174089, 0.433899},
                {-0.039408, -0.383356, 0.046758}}}};
  constexpr double step = 2e-3;  // near P2 the gradient has a kink, where a shadow's corner passes an edge of the room
  for (const auto& row : rows) {
    const AnalyticRoom room(row.walls, row.rectangle);
    for (int i = 0; i < 4; ++i) {
      const FloorPoint& p = floor_points[i];
      SCOPED_TRACE(p.name);
      const auto gradient = [&](double x, double y) { return room.gradient(x, y); };
      EXPECT_NEAR(central_difference([&](double h) { return gradient(p.x + h, p.y).x; }, step), row.hessian[i][0],
                  1e-4);
      EXPECT_NEAR(central_difference([&](double h) { return gradient(p.x + h, p.y).y; }, step), row.hessian[i][1],
                  1e-4);
      EXPECT_NEAR(central_difference([&](double h) { return gradient(p.x, p.y + h).y; }, step), row.hessian[i][2],
                  1e-4);
    }
  }
}

TEST(AnalyticRoom, UniformWallsBehindADimRectangle) {
  const auto room = AnalyticRoom::uniform(1.0, 0.1);
  const FloorPoint& p = floor_points[1];
  const Vec3d g = room.gradient(p.x, p.y);
  EXPECT_NEAR(room.irradiance(p.x, p.y), 2.4378328278, 1e-8);
  EXPECT_NEAR(g.x, 0.03209149, 1e-6);
  EXPECT_NEAR(g.y, -0.00084179, 1e-6);
}

// Beyond the gradient irradiance is not smooth as the normal turns: the horizon dips into the black floor on one side
// and leaves the walls on the other. So differences approach the gradient only to first order; the known values are
// those of step 0.002.
TEST(AnalyticRoom, RotationalGradient) {
  const Vec3d known[] = {{0.484593, -1.025488, 0}, {0.551102, -0.657463, 0}};
  for (const Walls walls : {Walls::smooth, Walls::constant}) {
    const AnalyticRoom room(walls, true);
    for (int i = 0; i < 2; ++i) {
      const Vec3d x{floor_points[i].x, floor_points[i].y, 0};
      const auto differences = [&](double step) {
        return Vec3d{central_difference(
                         [&](double h) {
                           return room.irradiance(x, {0, -std::sin(h), std::cos(h)});
                         },
                         step),
                     central_difference(
                         [&](double h) {
                           return room.irradiance(x, {std::sin(h), 0, std::cos(h)});
                         },
                         step),
                     0};
      };
      const Vec3d exact = room.rotational_gradient(x.x, x.y);
      if (walls == Walls::smooth) {
        EXPECT_LT(length(differences(2e-3) - known[i]), 2e-6);
      }
      EXPECT_LT(length(differences(1e-5) - exact), 5e-6);
      EXPECT_NEAR(length(differences(2e-3) - exact) / length(differences(1e-3) - exact), 2, 0.02);
    }
  }
}

TEST(AnalyticRoom, FurnaceIsPi) {
  const auto room = AnalyticRoom::uniform(1.0, 1.0);
  for (const FloorPoint& p : floor_points) EXPECT_NEAR(room.irradiance(p.x, p.y), std::numbers::pi, 1e-14);
}

// The rays see the same room as the closed forms: a fine gather, jittered so that no corner of the room
// falls between two of its cells, agrees with the exact irradiance.
TEST(AnalyticRoom, RaysSeeWhatIsIntegrated) {
  for (const bool rectangle : {false, true}) {
    const AnalyticRoom room(Walls::smooth, rectangle);
    for (const FloorPoint& p : floor_points) {
      const HemisphereGather gather = gather_floor(room, p.x, p.y, {256, 800}, 1);
      double sum = 0;
      for (const GatherSample& sample : gather.samples) sum += sample.radiance.r;
      EXPECT_NEAR(sum * std::numbers::pi / gather.strata.size() / room.irradiance(p.x, p.y), 1, 5e-4) << p.name;
    }
  }
}

}  // namespace
}  // namespace isophote::test
