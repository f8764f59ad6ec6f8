#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace isophote {

/// The first candidates in order of which near(a, b) holds of no two, and a few more rather than leave threads idle;
/// takes them out of the list.
template <class Candidate, class Near>
std::vector<Candidate> pick_spread(std::vector<Candidate>& candidates, Near&& near) {
  // Records in a round: a constant, so that the picture does not depend on the machine. Large enough to keep many
  // threads busy.
  constexpr std::size_t batch_size = 64, least_batch = 8;
  std::vector<Candidate> picked;
  std::size_t i = 0, kept = 0;
  for (; i < candidates.size() && picked.size() < batch_size; ++i) {
    const bool crowded =
        std::any_of(picked.begin(), picked.end(), [&](const Candidate& p) { return near(p, candidates[i]); });
    if (crowded)
      candidates[kept++] = candidates[i];
    else
      picked.push_back(candidates[i]);
  }
  for (; i < candidates.size(); ++i) candidates[kept++] = candidates[i];
  std::size_t first = 0;
  while (picked.size() < least_batch && first < kept) picked.push_back(candidates[first++]);
  candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(kept), candidates.end());
  candidates.erase(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(first));
  return picked;
}

}  // namespace isophote
