#pragma once

#include <array>
#include <cmath>

#include "isophote/core/rgb.h"

namespace isophote {

/// Weighted least squares for the six coefficients of a parabola over a plane, in three channels alike.
class ParabolaFit {
 public:
  static constexpr int unknowns = 6;
  using Row = std::array<double, unknowns>;

  /// An equation row . coefficients = value.
  void add(const Row& row, const Rgbd& value, double weight) {
    for (int i = 0; i < unknowns; ++i) {
      for (int k = 0; k <= i; ++k) matrix_[i][k] += weight * row[i] * row[k];
      right_[i] += value * (weight * row[i]);
    }
  }

  /// By Cholesky's factors; false where the equations do not decide.
  bool solve() {
    if (!factor()) return false;
    for (int i = 0; i < unknowns; ++i) {
      for (int m = 0; m < i; ++m) right_[i] -= right_[m] * matrix_[i][m];
      right_[i] = right_[i] / matrix_[i][i];
    }
    for (int i = unknowns - 1; i >= 0; --i) {
      for (int m = i + 1; m < unknowns; ++m) right_[i] -= right_[m] * matrix_[m][i];
      right_[i] = right_[i] / matrix_[i][i];
    }
    return true;
  }

  /// Once solved: a coefficient, and the variance of the first.
  const Rgbd& operator[](int i) const { return right_[i]; }
  double variance() const {
    Row column{};
    double sum = 0;
    for (int i = 0; i < unknowns; ++i) {
      column[i] = i == 0 ? 1 : 0;
      for (int m = 0; m < i; ++m) column[i] -= column[m] * matrix_[i][m];
      column[i] /= matrix_[i][i];
      sum += column[i] * column[i];
    }
    return sum;
  }

 private:
  bool factor() {
    for (int i = 0; i < unknowns; ++i)
      for (int k = 0; k <= i; ++k) {
        double sum = matrix_[i][k];
        for (int m = 0; m < k; ++m) sum -= matrix_[i][m] * matrix_[k][m];
        if (k == i && !(sum > 0)) return false;
        matrix_[i][k] = k < i ? sum / matrix_[k][k] : std::sqrt(sum);
      }
    return true;
  }

  std::array<Row, unknowns> matrix_{};  // the lower half; Cholesky's factor once solved
  std::array<Rgbd, unknowns> right_{};
};

}  // namespace isophote
