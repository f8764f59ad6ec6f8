#include "isophote/harmonics/rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "isophote/harmonics/quadrature.h"

namespace isophote {
namespace {

constexpr int order = most_order, count = harmonics_count(order);
constexpr double half_turn = std::numbers::pi;

std::vector<double> random_coefficients() {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<double> all(count);
  for (double& c : all) c = normal(random);
  return all;
}

double value(Basis basis, const std::vector<double>& coefficients, const Vec3d& w) {
  std::vector<double> values(count);
  evaluate_harmonics(basis, order, w, values);
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += coefficients[i] * values[i];
  return sum;
}

const Vec3d directions[] = {normalize(Vec3d{0.2, -0.5, 0.8}), normalize(Vec3d{-0.9, 0.1, 0.1}), {0, 0, 1}};
const Vec3d axes[] = {normalize(Vec3d{0.3, 0.2, 0.9}), normalize(Vec3d{-0.7, 0.6, -0.4}), {1, 0, 0}, {0, 0, 1}};

TEST(Rotation, AboutThePoleIsExact) {
  const std::vector<double> f = random_coefficients();
  constexpr double angle = 0.7;
  for (const Basis basis : {Basis::spherical, Basis::hemispherical}) {
    std::vector<double> g = f;
    rotate_about_pole(order, angle, std::span(g));
    for (const Vec3d& w : directions) {
      const Vec3d before{w.x * std::cos(angle) + w.y * std::sin(angle), w.y * std::cos(angle) - w.x * std::sin(angle),
                         w.z};
      EXPECT_NEAR(value(basis, g, w), value(basis, f, before), 1e-5);
    }
  }
}

TEST(Rotation, TurnsTheFunction) {
  const std::vector<double> f = random_coefficients();
  for (const Vec3d& axis : axes) {
    const Framed frame(axis);
    std::vector<double> g(count);
    HarmonicRotation(order, frame).apply<double>(f, g);
    for (const Vec3d& w : directions)
      EXPECT_NEAR(value(Basis::spherical, g, w), value(Basis::spherical, f, frame.to_local(w)), 1e-5);
  }
}

// Against direct projection: element (m, n) of a band is the integral of Y_lm(w) Y_ln(R^-1 w).
TEST(Rotation, IsThatOfProjection) {
  constexpr int small = 10, few = harmonics_count(small), azimuths = 32;
  const Framed frame(axes[1]);
  const HarmonicRotation rotation(small, frame);
  std::vector<double> matrix(few * few), here(few), before(few);
  GaussRule<20>::get().integrate(-1, 1, [&](double z, double weight) {
    for (int k = 0; k < azimuths; ++k) {
      const double r = std::sqrt(1 - z * z), phi = 2 * half_turn * k / azimuths;
      const Vec3d w{r * std::cos(phi), r * std::sin(phi), z};
      evaluate_harmonics(Basis::spherical, small, w, here);
      evaluate_harmonics(Basis::spherical, small, frame.to_local(w), before);
      for (int i = 0; i < few; ++i)
        for (int j = 0; j < few; ++j) matrix[i * few + j] += here[i] * before[j] * weight * 2 * half_turn / azimuths;
    }
  });
  for (int l = 0; l < small; ++l)
    for (int m = -l; m <= l; ++m)
      for (int n = -l; n <= l; ++n)
        EXPECT_NEAR(rotation.at(l, m, n), matrix[harmonic_index(l, m) * few + harmonic_index(l, n)], 1e-12);
}

TEST(Rotation, ThereAndBackAgain) {
  const std::vector<double> f = random_coefficients();
  const Framed frame(axes[0]);
  const Framed back(Vec3d{frame.u.x, frame.v.x, frame.n.x}, {frame.u.y, frame.v.y, frame.n.y},
                    {frame.u.z, frame.v.z, frame.n.z});
  std::vector<double> there(count), again(count);
  HarmonicRotation(order, frame).apply<double>(f, there);
  HarmonicRotation(order, back).apply<double>(there, again);
  for (int i = 0; i < count; ++i) EXPECT_NEAR(again[i], f[i], 2e-6);  // matrices are applied in single precision
}

TEST(Rotation, AzimuthsAreTransportedAlongTheShortestTurn) {
  const Vec3 n = normalize(Vec3{0.1f, 0.3f, 0.9f}), other = normalize(Vec3{0.2f, 0.1f, 0.95f});
  const Frame from(n);
  // The turn's own axis stays where it is: its azimuth grows by the angle.
  const Vec3 axis = normalize(cross(n, other));
  const Frame to(other);
  const auto azimuth = [&](const Frame& f) { return std::atan2(dot(axis, f.v), dot(axis, f.u)); };
  const float grown = azimuth(to) - azimuth(from), angle = transport_angle(from, to);
  EXPECT_NEAR(std::cos(angle), std::cos(grown), 1e-6);
  EXPECT_NEAR(std::sin(angle), std::sin(grown), 1e-6);
  EXPECT_NEAR(transport_angle(from, from), 0, 1e-7);
  // About one normal it is the angle between the frames.
  const Frame turned(from.u * 0.8f + from.v * 0.6f, from.v * 0.8f - from.u * 0.6f, n);
  EXPECT_NEAR(transport_angle(from, turned), -std::atan2(0.6f, 0.8f), 1e-6);
}

}  // namespace
}  // namespace isophote
