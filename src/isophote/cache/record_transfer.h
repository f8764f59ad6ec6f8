#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>

#include "isophote/validity/volume_record.h"

/// What of a record is on file, and in which order: each said once, for both ways.
namespace isophote::record_transfer {

/// Puts numbers into bytes, least significant first.
struct Packer {
  std::string bytes;

  void integer(std::uint64_t v, int size) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(v >> (8 * i)));
  }
  void operator()(float& v) { integer(std::bit_cast<std::uint32_t>(v), 4); }
  void operator()(std::uint32_t& v) { integer(v, 4); }
  void operator()(std::uint16_t& v) { integer(v, 2); }
  void operator()(std::uint8_t& v) { integer(v, 1); }
  void operator()(bool& v) { integer(v, 1); }
};

/// And takes them out; the caller has made sure that there are enough.
struct Unpacker {
  const char* at;
  bool malformed = false;  ///< there was something that no writer puts there

  std::uint64_t integer(int size) {
    std::uint64_t v = 0;
    for (int i = 0; i < size; ++i) v |= static_cast<std::uint64_t>(static_cast<unsigned char>(*at++)) << (8 * i);
    return v;
  }
  void operator()(float& v) { v = std::bit_cast<float>(static_cast<std::uint32_t>(integer(4))); }
  void operator()(std::uint32_t& v) { v = static_cast<std::uint32_t>(integer(4)); }
  void operator()(std::uint16_t& v) { v = static_cast<std::uint16_t>(integer(2)); }
  void operator()(std::uint8_t& v) { v = static_cast<std::uint8_t>(integer(1)); }
  void operator()(bool& v) {
    const std::uint64_t bit = integer(1);
    malformed = malformed || bit > 1;
    v = bit != 0;
  }
};

template <class Stream>
void transfer(Stream& io, Vec3& v) {
  io(v.x), io(v.y), io(v.z);
}
template <class Stream>
void transfer(Stream& io, Rgb& c) {
  io(c.r), io(c.g), io(c.b);
}
template <class Stream>
void transfer(Stream& io, Gradient<Rgb>& g) {
  transfer(io, g.x), transfer(io, g.y), transfer(io, g.z);
}
template <class Stream>
void transfer(Stream& io, Sym3& m) {
  io(m.xx), io(m.xy), io(m.xz), io(m.yy), io(m.yz), io(m.zz);
}

template <class Stream, int sectors>
void transfer(Stream& io, NearestBySector<sectors>& obstacles) {
  for (std::uint16_t& sector : obstacles.nearest) io(sector);
  obstacles.least = *std::min_element(obstacles.nearest.begin(), obstacles.nearest.end());
}

template <class Stream>
void transfer(Stream& io, DistanceStats& distances) {
  io(distances.harmonic_mean);
  transfer(io, distances.obstacles);
}

template <class Stream>
void transfer(Stream& io, Site& s) {
  Footprint& f = s.footprint;
  auto falloff = static_cast<std::uint8_t>(f.falloff);
  transfer(io, s.position), transfer(io, s.normal);
  transfer(io, f.shape);
  io(f.normal_scale), io(f.radius), io(f.unscaled), io(f.smallest), io(f.largest);
  io(falloff), io(f.order), io(f.logarithmic);
  f.falloff = static_cast<Falloff>(falloff);
  io(s.gradient_scale);
}

template <class Stream>
void transfer(Stream& io, Record& r) {
  transfer(io, static_cast<Site&>(r));
  io(r.curvature_scale);
  transfer(io, r.jet.value), transfer(io, r.jet.translational), transfer(io, r.jet.rotational);
  transfer(io, r.jet.hessian);
  io(r.jet.standard_error), io(r.jet.gradient_error), io(r.jet.rays);
  transfer(io, r.jet.distances);
}

/// The coefficients that a record of radiance has, of its value and then of its gradient, where it has one.
inline std::array<Coefficients*, 3> coefficients(RadianceRecord& r) {
  return {&r.jet.value, &r.jet.translational.x, &r.jet.translational.y};
}
inline std::array<Coefficients*, 4> coefficients(VolumeRecord& r) {
  return {&r.jet.value, &r.jet.translational.x, &r.jet.translational.y, &r.jet.translational.z};
}

/// The part of such a record whose size does not depend on its bands; these, and whether there is a gradient, are said
/// by its end.
template <class Stream>
void transfer_head(Stream& io, RadianceRecord& r, std::uint8_t& bands, bool& has_gradient) {
  transfer(io, static_cast<Site&>(r));
  io(r.jet.rays);
  transfer(io, r.jet.distances);
  io(bands), io(has_gradient);
}
template <class Stream>
void transfer_head(Stream& io, VolumeRecord& r, std::uint8_t& bands, bool& has_gradient) {
  transfer(io, static_cast<Site&>(r));
  io(r.media), io(r.jet.rays);
  io(r.jet.standard_error), io(r.jet.gradient_error);
  transfer(io, r.jet.hessian);
  io(r.jet.value_sum), io(r.jet.gradient_sum), io(r.jet.distances.harmonic_mean);
  transfer(io, r.jet.obstacles);
  io(bands), io(has_gradient);
}
/// And the rest; the vectors have their sizes already.
template <class Stream, class R>
void transfer_rest(Stream& io, R& r) {
  for (Coefficients* all : coefficients(r))
    for (Rgb& c : *all) transfer(io, c);
}

/// What the footprints were decided by.
template <class Stream>
void transfer(Stream& io, Pilot& pilot, float& threshold) {
  auto known = static_cast<std::uint8_t>(pilot.known);
  io(known), io(pilot.error_rate), io(pilot.irradiance), io(pilot.noise_rate), io(threshold);
  pilot.known = known != 0;
}
constexpr std::size_t pilot_size = 17;

}  // namespace isophote::record_transfer
