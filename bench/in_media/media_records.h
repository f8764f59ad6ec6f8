#pragma once

#include <string>
#include <vector>

#include "in_media/seen_point.h"

namespace isophote::bench {

struct MediaComparison {
  int gathers = 1;                  ///< whose mean a record is made of
  std::vector<std::size_t> counts;  ///< of records of both parts together
  std::string pictures;             ///< a folder for pictures beside `paths`; empty: none
  std::string paths;                ///< the picture that `in_scattered_by_paths` makes, as a file
};

/// Bisects the threshold of each way to make records in media for each count, and prints lines of JSON with the errors
/// at the points of `truths`; first of all with those of records made at the points themselves, their noise.
void compare_media_records(Job job, const std::vector<Truth>& truths, const MediaComparison& comparison);

/// Light that media scatter towards the eye, but for that of directly sampled emitters, by `job.samples` paths a pixel.
RgbImage in_scattered_by_paths(const Job& job);

}  // namespace isophote::bench
