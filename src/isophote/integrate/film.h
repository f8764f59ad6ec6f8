#pragma once

#include <cstdint>
#include <vector>

#include "isophote/core/vec.h"
#include "isophote/image/exr.h"
#include "isophote/image/image.h"

namespace isophote {

/// What one sample of one pixel saw. Radiance in W/m2/sr, irradiance in W/m2.
struct PixelSample {
  Rgb direct, indirect;  ///< of the picture; their sum is its colour
  Rgb irradiance;        ///< indirect, at the first point that does not scatter specularly; 0 where that is not diffuse
  Rgb albedo;            ///< of the diffuse lobe there
  Vec3 normal;           ///< there, normal map included, world space
  float depth = 0;       ///< along the camera's axis, to the first hit of any kind
  float alpha = 0;       ///< 1 on a surface, 0 in the sky or where a cancelled render knows nothing; before the sky,
                         ///< what media take of its light
};

/// Sums of samples, row by row: rows may have different numbers of samples.
class Film {
 public:
  Film(int width, int height);

  void add(int x, int y, const PixelSample& sample);
  /// To be called once all pixels of a row have been given `samples` more samples.
  void finish_row(int y, int samples) { samples_[y] += samples; }
  int samples(int y) const { return samples_[y]; }
  std::uint64_t samples() const;  ///< of all pixels

  RgbImage color() const;  ///< direct + indirect
  RgbImage irradiance() const { return mean(&PixelSample::irradiance); }
  /// All layers under the project's names: R,G,B,A, direct, indirect, irradiance, albedo, normal, depth.Z.
  ExrFile exr() const;

 private:
  RgbImage mean(Rgb PixelSample::*layer) const;

  int width_, height_;
  std::vector<PixelSample> sums_;
  std::vector<int> samples_;
};

}  // namespace isophote
