#pragma once

#include <vector>

#include "isophote/integrate/job.h"

namespace isophote {

/// All that visit(x, y, found, counts) appends to `found` at every stride-th pixel of the picture, from the top row
/// down. Rows run on the job's threads; their rays are added to `rays`.
template <class T, class Visit>
std::vector<T> collect_over_pixels(const Job& job, int stride, RayCounts& rays, const Visit& visit) {
  const int first = stride / 2;
  std::vector<std::vector<T>> found(static_cast<std::size_t>((job.height - first + stride - 1) / stride));
  rays += for_each(job.parallel, found.size(), 1, [&](std::size_t row, RayCounts& counts) {
    const int y = first + static_cast<int>(row) * stride;
    for (int x = first; x < job.width; x += stride) visit(x, y, found[row], counts);
  });
  std::vector<T> all;
  for (const auto& row : found) all.insert(all.end(), row.begin(), row.end());
  return all;
}

}  // namespace isophote
