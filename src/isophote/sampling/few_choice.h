#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "isophote/core/check.h"
#include "isophote/sampling/distribution.h"

namespace isophote {

/// Chooses among a few indices by weights that are found anew for each choice, with a tenth of it to all of positive
/// weight alike. Walks the weights, and keeps no memory but its own.
class FewChoice {
 public:
  static constexpr std::size_t most = 32;

  /// weight(i), not negative, for i in [0, count), at most `most`.
  template <class Weight>
  FewChoice(std::size_t count, const Weight& weight) : count_(static_cast<std::uint32_t>(count)) {
    ISOPHOTE_CHECK(count, <=, most);
    for (std::uint32_t i = 0; i < count_; ++i) weights_[i] = weight(i);
    sum_ = share_alike(std::span(weights_).first(count));
  }

  /// Is every weight 0, or their sum not finite?
  bool empty() const { return !(sum_ > 0 && std::isfinite(sum_)); }
  /// An index of positive weight, for u in [0, 1]. Not on an empty one.
  std::uint32_t sample(float u) const {
    const float wanted = u * sum_;
    float sum = 0;
    std::uint32_t chosen = 0;
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (!(weights_[i] > 0)) continue;
      chosen = i;
      if (wanted < (sum += weights_[i])) break;
    }
    return chosen;
  }
  /// With which `sample` gives the index for a uniform u. Not on an empty one.
  float chance(std::uint32_t i) const { return weights_[i] / sum_; }

 private:
  std::array<float, most> weights_;  // of the first count_
  float sum_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace isophote
