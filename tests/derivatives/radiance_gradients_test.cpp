// Incident radiance and its gradients, coefficient by coefficient, in the room whose radiance is known.
#include <gtest/gtest.h>

#include <functional>

#include "isophote/derivatives/krivanek_2005a.h"
#include "isophote/derivatives/krivanek_2005b.h"
#include "isophote/derivatives/ward_heckbert_1992.h"
#include "support/analytic_room.h"
#include "support/imagined_gather.h"

namespace isophote::test {
namespace {

using Walls = AnalyticRoom::Walls;
using Estimate = std::function<RadianceJet(const HemisphereGather&, Basis, int)>;

const Estimate unaware = [](const HemisphereGather& gather, Basis basis, int bands) {
  return krivanek_2005a(gather, basis, bands);
};
const Estimate stratified = krivanek_2005b;
constexpr int order = 4, count = harmonics_count(order);

struct Known {
  std::vector<double> value, along_x, along_y;
};

/// What the coefficients are at a place of the floor, and their gradients, by differences.
Known known(const AnalyticRoom& room, const FloorPoint& p, Basis basis) {
  const auto coefficient = [&](double x, double y, int i) {
    std::vector<double> values(count);
    return room.integral(x, y, [&](const Vec3d& w) {
      evaluate_harmonics(basis, order, w, values);
      return values[i];
    });
  };
  Known k;
  for (int i = 0; i < count; ++i) {
    k.value.push_back(coefficient(p.x, p.y, i));
    k.along_x.push_back(central_difference([&](double h) { return coefficient(p.x + h, p.y, i); }, 1e-2));
    k.along_y.push_back(central_difference([&](double h) { return coefficient(p.x, p.y + h, i); }, 1e-2));
  }
  return k;
}

/// Root mean square over seeds of the error of all coefficients together, relative to all together.
struct Errors {
  double value = 0, gradient = 0;
};
Errors errors(const AnalyticRoom& room, const FloorPoint& p, Basis basis, const Known& k, Strata strata,
              const Estimate& estimate) {
  constexpr int seeds = 6;
  double value = 0, gradient = 0, all_values = 0, all_gradients = 0;
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    const RadianceJet jet = estimate(gather_floor(room, p.x, p.y, strata, seed), basis, order);
    for (int i = 0; i < count; ++i) {
      value += std::pow(jet.value[i].r - k.value[i], 2), all_values += k.value[i] * k.value[i];
      gradient +=
          std::pow(jet.translational.x[i].r - k.along_x[i], 2) + std::pow(jet.translational.y[i].r - k.along_y[i], 2);
      all_gradients += k.along_x[i] * k.along_x[i] + k.along_y[i] * k.along_y[i];
    }
  }
  return {std::sqrt(value / all_values), std::sqrt(gradient / all_gradients)};
}

struct Case {
  bool rectangle;
  int point;
  Errors coarse, fine;  ///< at most, with 16 x 50 and 64 x 200 strata
};

void expect_below(const char* name, std::initializer_list<Case> cases, const Estimate& estimate) {
  for (const Basis basis : {Basis::hemispherical, Basis::spherical})
    for (const Case& c : cases) {
      const AnalyticRoom room(Walls::smooth, c.rectangle);
      const FloorPoint& p = floor_points[c.point];
      const Known k = known(room, p, basis);
      const Errors coarse = errors(room, p, basis, k, {16, 50}, estimate),
                   fine = errors(room, p, basis, k, {64, 200}, estimate);
      std::printf("  %s, %s, %s: rms error of values / gradients %.2f / %.1f%%, at 64x200 %.2f / %.1f%%\n", name,
                  basis == Basis::spherical ? "spherical" : "hemispherical", p.name, 100 * coarse.value,
                  100 * coarse.gradient, 100 * fine.value, 100 * fine.gradient);
      EXPECT_LT(coarse.value, c.coarse.value);
      EXPECT_LT(coarse.gradient, c.coarse.gradient);
      EXPECT_LT(fine.value, c.fine.value);
      EXPECT_LT(fine.gradient, c.fine.gradient);
    }
}

TEST(RadianceGradients, StratifiedOnesConverge) {
  expect_below("krivanek2005b",
               {{false, 0, {0.016, 0.16}, {0.003, 0.04}},
                {true, 0, {0.016, 0.16}, {0.003, 0.04}},
                {true, 1, {0.025, 0.16}, {0.003, 0.02}}},
               stratified);
}

TEST(RadianceGradients, UnawareOnesConvergeWhereNothingHides) {
  expect_below("krivanek2005a", {{false, 0, {0.016, 0.16}, {0.003, 0.04}}}, unaware);
}

// Behind an occluder they stay wrong, whatever the number of rays.
TEST(RadianceGradients, UnawareOnesAreUnawareOfOcclusion) {
  const AnalyticRoom room(Walls::smooth, true);
  for (const int point : {1, 2}) {
    const FloorPoint& p = floor_points[point];
    const Known k = known(room, p, Basis::hemispherical);
    const Errors fine = errors(room, p, Basis::hemispherical, k, {64, 200}, unaware);
    std::printf("  krivanek2005a behind an occluder, %s: %.1f%%\n", p.name, 100 * fine.gradient);
    EXPECT_GT(fine.gradient, 0.2);
  }
}

// A cosine is the spherical harmonic (1, 0), of which the stratified gradient is Ward's and Heckbert's.
TEST(RadianceGradients, OfTheCosineIsThatOfIrradiance) {
  const double cosine = std::sqrt(4 * std::numbers::pi / 3);
  const HemisphereGather gather = gather_floor(AnalyticRoom(Walls::smooth, true), 1.9, 1.45, {32, 100}, 3);
  const Jet<Rgb> irradiance = ward_heckbert_1992(gather, RotationWeights::exact);
  const RadianceJet radiance = krivanek_2005b(gather, Basis::spherical, 2);
  const int i = harmonic_index(1, 0);
  EXPECT_NEAR(cosine * radiance.value[i].r, irradiance.value.r, 1e-6);
  EXPECT_NEAR(cosine * radiance.translational.x[i].r, irradiance.translational.x.r, 1e-3);
  EXPECT_NEAR(cosine * radiance.translational.y[i].r, irradiance.translational.y.r, 1e-3);
}

/// The gradient of all coefficients together in a round furnace of radius 1, where all but the constant function's
/// value vanish with any strata, for cells are integrated exactly.
double furnace_gradient(Strata strata, const Estimate& estimate, int bands) {
  HemisphereGather gather = imagine(strata, [](int, int) { return seen(2); });
  for (GatherSample& s : gather.samples) s.normal = -s.direction;
  const RadianceJet jet = estimate(gather, Basis::hemispherical, bands);
  double squares = 0;
  for (std::size_t i = 0; i < jet.value.size(); ++i) {
    EXPECT_NEAR(jet.value[i].r, i == 0 ? 2 * std::sqrt(2 * std::numbers::pi) : 0, 1e-6);
    squares += std::pow(jet.translational.x[i].r, 2) + std::pow(jet.translational.y[i].r, 2);
  }
  return std::sqrt(squares);
}

TEST(RadianceGradients, StratifiedOnesVanishInAFurnace) {
  for (const Strata strata : {Strata{1, 3}, Strata{8, 25}}) EXPECT_EQ(furnace_gradient(strata, stratified, 10), 0);
}

// A piece is taken to lie all over as it does at its sample. That is wrong most along the horizon, where functions
// begin as roots of the cosine: with n rings, the height of the last of which is n^-1/2, by the order of n^-7/4.
TEST(RadianceGradients, UnawareOnesVanishInAFurnaceAsStrataShrink) {
  constexpr int bands = 3;  // of more, strata as coarse as the first would miss the waves
  double coarser = furnace_gradient({8, 25}, unaware, bands);
  for (const int finer : {2, 4, 8}) {
    const double now = furnace_gradient({8 * finer, 25 * finer}, unaware, bands);
    std::printf("  krivanek2005a in a furnace, %dx%d: %.2g, %.2f times less\n", 8 * finer, 25 * finer, now,
                coarser / now);
    EXPECT_NEAR(coarser / now, std::pow(2, 1.75), 0.1);
    coarser = now;
  }
}

}  // namespace
}  // namespace isophote::test
