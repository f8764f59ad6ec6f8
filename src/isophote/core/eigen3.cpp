#include "isophote/core/eigen3.h"

#include <cmath>

namespace isophote {
namespace {

using Matrix = double[3][3];

/// Turns axes p and q so that the entry between them vanishes (Jacobi's rotation): a = J^T a J, and J onto the axes.
void annihilate(Matrix& a, std::array<Vec3d, 3>& axes, int p, int q) {
  if (a[p][q] == 0) return;
  const double cot = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = (cot < 0 ? -1 : 1) / (std::abs(cot) + std::hypot(cot, 1.0)), c = 1 / std::hypot(t, 1.0), s = t * c;
  const int r = 3 - p - q;
  a[p][p] -= t * a[p][q], a[q][q] += t * a[p][q];
  a[p][q] = a[q][p] = 0;
  const double rp = a[r][p], rq = a[r][q];
  a[r][p] = a[p][r] = c * rp - s * rq, a[r][q] = a[q][r] = s * rp + c * rq;
  const Vec3d u = axes[p], v = axes[q];
  axes[p] = u * c - v * s, axes[q] = u * s + v * c;
}

}  // namespace

Eigen3::Eigen3(const Sym3d& m) : axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}} {
  Matrix a = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
  // It converges quadratically: in five or six sweeps what is left is under the smallest doubles.
  constexpr int sweeps = 8;
  for (int i = 0; i < sweeps; ++i) annihilate(a, axes, 0, 1), annihilate(a, axes, 0, 2), annihilate(a, axes, 1, 2);
  values = {a[0][0], a[1][1], a[2][2]};
}

}  // namespace isophote
