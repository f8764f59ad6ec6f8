#pragma once

#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/GridHandle.h>

#include "isophote/scene/density_grid_impl.h"

namespace isophote {

/// Values in a NanoVDB tree. Inactive ones are 0 there.
class NanoVoxels : public Voxels {
 public:
  explicit NanoVoxels(nanovdb::GridHandle<> handle) : handle_(std::move(handle)), grid_(handle_.grid<float>()) {}

  // Most cells have all their corners in one leaf, which is then looked up once. Accessors remember where they were, so
  // that none can be shared by threads, and a fresh one is cheap.
  void corners(int i, int j, int k, float out[8]) const override {
    constexpr int side = DensityGrid::block, last = side - 1;
    const int a = i & last, b = j & last, c = k & last;
    if (a < last && b < last && c < last) {
      if (const auto* leaf = grid_->tree().root().probeLeaf({i, j, k})) {
        const float* first = leaf->data()->mValues + (a * side + b) * side + c;
        for (int n = 0; n < 8; ++n) out[n] = first[((n >> 2) * side + (n >> 1 & 1)) * side + (n & 1)];
        return;
      }
    }
    const auto accessor = grid_->getAccessor();
    for (int n = 0; n < 8; ++n) out[n] = accessor.getValue({i + (n >> 2), j + (n >> 1 & 1), k + (n & 1)});
  }

 private:
  nanovdb::GridHandle<> handle_;
  const nanovdb::FloatGrid* grid_;
};

}  // namespace isophote
