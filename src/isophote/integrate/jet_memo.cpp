#include "isophote/integrate/jet_memo.h"

#include <algorithm>

#include "isophote/core/check.h"

namespace isophote {

JetMemo::JetMemo(std::vector<const Estimator*> estimators) : estimators_(std::move(estimators)) {}

Jet<Rgb> JetMemo::jet(const Estimator& estimator, std::uint64_t key,
                      const std::function<const HemisphereGather&()>& gather) {
  const auto index =
      static_cast<std::size_t>(std::find(estimators_.begin(), estimators_.end(), &estimator) - estimators_.begin());
  ISOPHOTE_CHECK(index, <, estimators_.size());
  Shard& shard = shards_[key % shards_.size()];
  {
    const std::lock_guard hold(shard.lock);
    if (const auto found = shard.jets.find(key); found != shard.jets.end()) return found->second[index];
  }
  // Without the lock: whoever asks for the same place meanwhile finds the same.
  const HemisphereGather& seen = gather();
  std::vector<Jet<Rgb>> jets;
  jets.reserve(estimators_.size());
  for (const Estimator* each : estimators_) jets.push_back(each->estimate(seen));
  const std::lock_guard hold(shard.lock);
  return shard.jets.try_emplace(key, std::move(jets)).first->second[index];
}

}  // namespace isophote
