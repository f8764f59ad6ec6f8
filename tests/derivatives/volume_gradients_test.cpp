// Radiance in media and its gradients, in a room whose radiance is known: of surfaces, and of the shaft of the sun.
#include <gtest/gtest.h>

#include "isophote/derivatives/jarosz_2008a.h"
#include "isophote/derivatives/moving_walls.h"
#include "support/known_media.h"

namespace isophote::test {
namespace {

struct Grid {
  SphereStrata strata;
  int shells;
  double value_of_surfaces, value_of_media;  ///< their relative error at most
};
constexpr Grid coarse{{32, 64}, 24, 0.002, 0.015}, fine{{128, 256}, 48, 0.0003, 0.004};

using Estimate = WeighedRadiance (*)(const SphereGather&, VolumePart, const PhaseWeight&);
constexpr Estimate fixed_places = [](const SphereGather& g, VolumePart part, const PhaseWeight& weight) {
  return weigh_fixed_places(g, part, weight)[0];
};
template <WallDistance distance>
constexpr Estimate walls = [](const SphereGather& g, VolumePart part, const PhaseWeight& weight) {
  return weigh_moving_walls(g, part, weight, distance)[0];
};
constexpr Estimate minimum = walls<WallDistance::minimum>, refined = walls<WallDistance::refined>;

struct Errors {
  double surfaces, media;
};
Errors errors(Known known, const SphereGather& gather, Estimate estimate) {
  const KnownPlace& p = known_places[known];
  const auto error = [&](VolumePart part) {
    return relative_error(in_room(estimate(gather, part, {{p.g}}).gradient), p.known(part).gradient);
  };
  return {error(VolumePart::surfaces), error(VolumePart::media)};
}

struct Case {
  Known known;
  Errors fixed_places, minimum, refined;  ///< of the independent program
};

void expect_errors(const Grid& grid, std::initializer_list<Case> cases) {
  for (const Case& c : cases) {
    const KnownPlace& p = known_places[c.known];
    const SphereGather gather = gather_sphere(p.room(), p.at, grid.strata, grid.shells);
    for (const VolumePart part : both_parts)
      EXPECT_NEAR(fixed_places(gather, part, {{p.g}}).value.r / p.known(part).value, 1,
                  part == VolumePart::surfaces ? grid.value_of_surfaces : grid.value_of_media)
          << p.name;
    const Errors f = errors(c.known, gather, fixed_places), m = errors(c.known, gather, minimum),
                 r = errors(c.known, gather, refined);
    std::printf(
        "  %-22s %3dx%dx%d: surfaces / media: fixed places %5.2f / %5.2f%%, walls %5.2f / %5.2f%%, refined "
        "%5.2f / %5.2f%%\n",
        p.name, grid.strata.polar, grid.strata.azimuthal, grid.shells, 100 * f.surfaces, 100 * f.media,
        100 * m.surfaces, 100 * m.media, 100 * r.surfaces, 100 * r.media);
    const auto near = [&](double is, double was) { EXPECT_NEAR(is, was, 0.15 * was + 0.002) << p.name; };
    near(f.surfaces, c.fixed_places.surfaces), near(f.media, c.fixed_places.media);
    near(m.surfaces, c.minimum.surfaces), near(m.media, c.minimum.media);
    EXPECT_LT(r.surfaces, 1.3 * c.refined.surfaces) << p.name;
    EXPECT_LT(r.media, 2.1 * c.refined.media) << p.name;
  }
}

TEST(VolumeGradients, ConvergeWithWallsAndOnlyWithWalls) {
  expect_errors(coarse, {{P1, {0.033, 0.019}, {0.019, 0.008}, {0.0038, 0.008}},
                         {P1_lobe, {0.0074, 0.020}, {0.015, 0.013}, {0.0017, 0.013}},
                         {P1_fog, {0.032, 0.018}, {0.015, 0.012}, {0.0021, 0.012}},
                         {P1_blob_lobe, {0.0072, 0.017}, {0.012, 0.007}, {0.0010, 0.007}},
                         {P4, {0.90, 0.12}, {0.10, 0.020}, {0.057, 0.020}},
                         {P2, {0.17, 0.031}, {0.019, 0.011}, {0.0088, 0.010}},
                         {P2_fog_lobe, {0.012, 0.015}, {0.0076, 0.011}, {0.0008, 0.011}}});
  expect_errors(fine, {{P1, {0.033, 0.017}, {0.0055, 0.0018}, {0.0005, 0.0018}},
                       {P1_blob_lobe, {0.0026, 0.012}, {0.0034, 0.0007}, {0.0001, 0.0007}},
                       {P4, {0.89, 0.12}, {0.023, 0.004}, {0.008, 0.004}},
                       {P4_lobe, {0.56, 0.14}, {0.007, 0.005}, {0.003, 0.005}},
                       {P2_fog_lobe, {0.015, 0.013}, {0.0022, 0.0038}, {0.0003, 0.0038}}});
}

TEST(VolumeGradients, AreAsGoodWithJitteredSamples) {
  const struct {
    Known known;
    Errors fixed_places, minimum, refined;  ///< of the independent program
  } rows[] = {{P4, {0.89, 0.117}, {0.13, 0.024}, {0.090, 0.024}},
              {P1, {0.038, 0.022}, {0.032, 0.012}, {0.0083, 0.012}}};
  constexpr int seeds = 8;
  for (const auto& row : rows) {
    const KnownPlace& p = known_places[row.known];
    Errors f{}, m{}, r{};
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
      const SphereGather gather = gather_sphere(p.room(), p.at, coarse.strata, coarse.shells, seed);
      const auto add = [&](Errors& squares, Estimate estimate) {
        const Errors e = errors(row.known, gather, estimate);
        squares.surfaces += e.surfaces * e.surfaces / seeds, squares.media += e.media * e.media / seeds;
      };
      add(f, fixed_places), add(m, minimum), add(r, refined);
    }
    for (Errors* e : {&f, &m, &r}) *e = {std::sqrt(e->surfaces), std::sqrt(e->media)};
    std::printf(
        "  %s, jittered: surfaces / media: fixed places %.2f / %.2f%%, walls %.2f / %.2f%%, refined %.2f / %.2f%%\n",
        p.name, 100 * f.surfaces, 100 * f.media, 100 * m.surfaces, 100 * m.media, 100 * r.surfaces, 100 * r.media);
    EXPECT_NEAR(f.surfaces, row.fixed_places.surfaces, 0.15 * row.fixed_places.surfaces);
    EXPECT_LT(f.media, 1.3 * row.fixed_places.media);
    EXPECT_LT(m.surfaces, 1.3 * row.minimum.surfaces);
    EXPECT_LT(m.media, 1.3 * row.minimum.media);
    EXPECT_LT(r.surfaces, 1.3 * row.refined.surfaces);
    EXPECT_LT(r.media, 2 * row.refined.media);
  }
}

}  // namespace
}  // namespace isophote::test
