#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace isophote {

/// Nodes in [-1, 1] and weights that sum to 2 of Gauss's rule, exact for polynomials of degree 2 n - 1.
template <int n>
struct GaussRule {
  std::array<double, n> nodes, weights;

  /// Newton's iteration on Legendre's polynomial.
  GaussRule() {
    for (int i = 0; i < n; ++i) {
      double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
      for (int turn = 0; turn < 100; ++turn) {
        double before = 1, here = x;
        for (int l = 2; l <= n; ++l) {
          const double next = ((2 * l - 1) * x * here - (l - 1) * before) / l;
          before = here, here = next;
        }
        slope = n * (x * here - before) / (x * x - 1);
        const double step = here / slope;
        x -= step;
        if (std::abs(step) < 1e-15) break;
      }
      nodes[i] = x, weights[i] = 2 / ((1 - x * x) * slope * slope);
    }
  }

  /// The integral of f over [a, b].
  template <class F>
  void integrate(double a, double b, F&& f) const {
    for (int i = 0; i < n; ++i) f((a + b) / 2 + (b - a) / 2 * nodes[i], weights[i] * (b - a) / 2);
  }

  static const GaussRule& get() {
    static const GaussRule rule;
    return rule;
  }
};

}  // namespace isophote
