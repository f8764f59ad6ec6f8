#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "isophote/cache/catalogue.h"

namespace isophote {

/// What places have been found to see, by their keys, for builds that ask for the same places again and again: under
/// other thresholds, by other methods. A place's random numbers follow from its key alone, so that its first gather is
/// as good as any later one; each of the estimators is evaluated on it at once. Only for builds of one scene whose
/// gathers are alike and read no cache (Method::secondary). Any thread may ask.
class JetMemo {
 public:
  explicit JetMemo(std::vector<const Estimator*> estimators);

  /// What `estimator`, one of those of the constructor, says of the place `key`; `gather` is called where the place is
  /// new.
  Jet<Rgb> jet(const Estimator& estimator, std::uint64_t key, const std::function<const HemisphereGather&()>& gather);

 private:
  /// Places share locks by their keys, so that threads rarely meet.
  struct Shard {
    std::mutex lock;
    std::unordered_map<std::uint64_t, std::vector<Jet<Rgb>>> jets;  ///< in the order of `estimators_`
  };

  std::vector<const Estimator*> estimators_;
  std::array<Shard, 64> shards_;
};

}  // namespace isophote
