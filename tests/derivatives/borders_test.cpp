// What the gradients make of the edges of the hemisphere: sky, the record's own surface, the horizon.
#include <gtest/gtest.h>

#include "isophote/derivatives/schwarzhaupt_2012.h"
#include "isophote/derivatives/swept_edges.h"
#include "isophote/derivatives/ward_heckbert_1992.h"
#include "support/imagined_gather.h"

namespace isophote::test {
namespace {

Vec3d channel(const Gradient<Rgb>& g, int c = 0) { return {g.x[c], g.y[c], g.z[c]}; }

// A wall between a surface and the sky moves as the surface does; between two pieces of sky nothing moves.
TEST(WardHeckbert, OpenSky) {
  const Strata strata{16, 50};
  const auto half = [&](float other_distance) {
    return ward_heckbert_1992(
        imagine(strata, [&](int, int k) { return k < 25 ? seen(1, other_distance) : seen(0, 2); }),
        RotationWeights::exact);
  };
  const Jet<Rgb> sky = half(infinity), near = half(2);
  EXPECT_EQ(channel(sky.translational), channel(near.translational));
  EXPECT_GT(length(channel(sky.translational)), 0);
  EXPECT_FLOAT_EQ(sky.distances.harmonic_mean, 4);

  const Jet<Rgb> open = ward_heckbert_1992(
      imagine(strata, [&](int j, int k) { return seen(static_cast<float>(j + k), infinity); }), RotationWeights::exact);
  EXPECT_EQ(channel(open.translational), Vec3d());
  EXPECT_GT(length(channel(open.rotational)), 0);
  EXPECT_TRUE(is_finite(channel(open.rotational)));
  EXPECT_EQ(open.distances.harmonic_mean, infinity);
}

struct EdgeAware {
  const char* name;
  Jet<Rgb> (*estimate)(const HemisphereGather&);
};
const EdgeAware edge_aware[] = {
    {"Ward-Heckbert", [](const HemisphereGather& g) { return ward_heckbert_1992(g, RotationWeights::exact); }},
    {"harmonic",
     [](const HemisphereGather& g) { return ward_heckbert_1992(g, RotationWeights::exact, WallDistance::harmonic); }},
    {"triangulated", [](const HemisphereGather& g) { return schwarzhaupt_2012(g, Horizon::closed); }},
    {"swept", swept_edges},
};

// Where the interpolated normal leans over the surface itself, the directions under that surface see nothing; their rim
// goes with the record and moves nothing.
TEST(Borders, TheSurfaceItselfIsNoEdge) {
  GatherSample own = seen(0, infinity);
  own.surface = GatherSample::own_surface;
  HemisphereGather gather = imagine({16, 50}, [&](int j, int k) { return j > 10 && k < 20 ? own : seen(1, 2); });
  for (GatherSample& s : gather.samples) s.normal = -s.direction;
  for (const EdgeAware& e : edge_aware) {
    EXPECT_EQ(channel(e.estimate(gather).translational), Vec3d()) << e.name;
    EXPECT_EQ(e.estimate(gather).hessian, Sym3{}) << e.name;
  }
}

// However varied, the sky moves with the record, in any unit of length.
TEST(Borders, AnOpenSkyHasNoDerivatives) {
  const HemisphereGather gather =
      imagine({16, 50}, [&](int j, int k) { return seen(static_cast<float>(1 + j * k % 7), infinity); });
  for (const EdgeAware& e : edge_aware) {
    EXPECT_EQ(channel(e.estimate(gather).translational), Vec3d()) << e.name;
    EXPECT_EQ(e.estimate(gather).hessian, Sym3{}) << e.name;
  }
}

TEST(WardHeckbert, IsFiniteForEveryCountOfRings) {
  for (int m = 1; m <= 200; ++m) {
    const HemisphereGather gather =
        imagine({m, 4}, [](int j, int k) { return seen(static_cast<float>(j % 3 + k), 1.0f); });
    const Jet<Rgb> jet = ward_heckbert_1992(gather, RotationWeights::exact);
    EXPECT_TRUE(is_finite(channel(jet.translational)) && is_finite(channel(jet.rotational)));
  }
}

}  // namespace
}  // namespace isophote::test
