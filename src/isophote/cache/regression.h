#pragma once

#include <array>
#include <cstdint>

#include "isophote/cache/record_neighbours.h"

namespace isophote {

/// Fits each record's value and gradient to what its neighbours say of it: a weighted least-squares parabola through
/// their values and gradients, where each counts by its own noise and by what a parabola leaves out at its distance.
/// What a record's few rays have by chance, many neighbours have not. docs/theory.md derives it.
class Regression {
 public:
  /// How much of what a parabola leaves out counts as error: less smooths more.
  static constexpr std::array<double, 5> distrusts{4, 8, 16, 32, 64};
  using Risks = std::array<double, distrusts.size()>;

  /// Of all records as they are, which must stay so while this is used.
  explicit Regression(const RecordCache& cache);

  /// An estimate, unbiased if the noise is known, of the squared relative error of the value after a fit with each of
  /// `distrusts`: how far it moved, less the noise it had, plus twice the noise that it keeps [Stein 1981]. All 0 where
  /// there are too few neighbours. Any thread may ask.
  Risks risks(std::uint32_t id, OpenTest open) const;

  /// The record with its value, translational gradient and standard error after the fit. No channel moves by more than
  /// three standard errors of the neighbourhood's luminance, or, of what is brighter than that, as many relative to it.
  /// Neighbours that `open` finds hidden are left out. Any thread may ask.
  Record fitted(std::uint32_t id, double distrust, OpenTest open) const;

 private:
  RecordNeighbours<Record> neighbours_;
};

}  // namespace isophote
