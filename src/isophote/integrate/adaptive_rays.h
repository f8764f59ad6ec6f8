#pragma once

#include "isophote/integrate/gather.h"
#include "isophote/integrate/job.h"

namespace isophote {

/// How many rays a gather gets whose method adapts them. Let s be the standard deviation of one ray's share, relative
/// to the irradiance. Of all ways to spend a number of rays on records of equal size, n ~ s^(2/3) has the least mean
/// relative error, s n^-1/2 in the mean; so n = (rate / noise)^2 s^(2/3), rate being the mean of s^(2/3) over the
/// visible points (Pilot), has a mean error of `noise`. What s is, other gathers have to say: one that ends where it
/// looks good by itself is biased.
Strata strata_for(float spread, const Pilot& pilot, float noise);

/// s, by a gather that has been made.
float relative_spread(const Jet<Rgb>& jet, const Pilot& pilot);

/// The strata for a record at a place, by the spread of the nearest record that faces alike and is not the place's own.
Strata strata_near(const Job& job, const RecordCache& cache, const Place& place);

/// No gather whose rays adapt has fewer, for derivatives need them, or more.
inline constexpr int fewest_rays = 100, most_rays = 1 << 16;

}  // namespace isophote
