#pragma once

#include "isophote/image/image.h"

namespace isophote {

/// How a picture differs from its reference, in linear values (not after tone mapping). Where the reference is black
/// all over, what is relative to its mean is 0 for a black picture and infinite for any other.
struct Difference {
  double rmse = 0;           ///< root of the mean squared difference over pixels and channels
  double relative_rmse = 0;  ///< rmse / mean of the reference over pixels and channels
  double relative_mse = 0;   ///< mean over pixels of (a - ref)^2 / (ref^2 + (0.01 mean ref)^2), luminance
  double bias = 0;           ///< (mean a - mean ref) / mean ref, luminance
  double block_error = 0;  ///< root mean square over 8x8 blocks of the difference of block means / mean ref, luminance
  double ssim = 0;         ///< structural similarity [Wang 2004] of luminance as displayed, see `compare`
};

/// Throws UserError where the sizes differ, or where either holds a value that is not finite (naming the pixel).
/// SSIM sees both pictures at the reference's auto_exposure, clipped to [0, 1] and sRGB encoded, so that it does not
/// depend on the scene's units; Gaussian windows of 11x11, sigma 1.5, K1 = 0.01, K2 = 0.03, averaged over the windows
/// that lie within the picture (in a side shorter than 11 the window is cut to fit).
Difference compare(const RgbImage& image, const RgbImage& reference);

/// The same against a reference of which there are two independent estimates. The product of the differences to each
/// stands for the squared difference, so that the noise of the references cancels on average; what it leaves can make a
/// squared error negative, which counts as 0. `ssim` is against the mean of both.
Difference compare(const RgbImage& image, const RgbImage& reference, const RgbImage& second);

/// What two pictures, alike but for their random numbers, have in common: the product of the difference of one to the
/// first reference and of the other to the second stands for the squared difference, so that the noise of the pictures
/// cancels too, and what is left is systematic. `bias` and `ssim` are of the first.
Difference compare(const RgbImage& image, const RgbImage& other, const RgbImage& reference, const RgbImage& second);

/// Means over n x n blocks; a last incomplete row or column of blocks is averaged over what it has.
RgbImage block_average(const RgbImage& image, int n);

}  // namespace isophote
