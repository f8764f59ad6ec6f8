#pragma once

#include <cstdint>
#include <vector>

#include "isophote/scene/texture.h"

namespace isophote {

/// Where a texture is black, so that it can be told of a region without a look at each texel: how many blocks of texels
/// have any colour in the rectangle from the first block to each other (a summed-area table).
class LitBlocks {
 public:
  explicit LitBlocks(const Texture& texture);

  /// May `fetch` give a colour other than black for some uv between the two corners? In constant time; errs to true.
  bool lit(Vec2 lower, Vec2 upper) const;

 private:
  std::uint32_t& sum(int column, int row) { return sums_[static_cast<std::size_t>(row) * (columns_ + 1) + column]; }
  std::uint32_t sum(int column, int row) const {
    return sums_[static_cast<std::size_t>(row) * (columns_ + 1) + column];
  }

  int width_, height_;  // texels
  Wrap wrap_u_, wrap_v_;
  int columns_, rows_;               // blocks
  std::vector<std::uint32_t> sums_;  // of the blocks left of and above each corner between blocks
};

}  // namespace isophote
