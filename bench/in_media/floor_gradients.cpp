#include "in_media/floor_gradients.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "isophote/cache/record_cache.h"
#include "isophote/derivatives/jarosz_2008b.h"
#include "isophote/derivatives/ward_heckbert_1992.h"
#include "isophote/image/false_colour.h"
#include "isophote/image/png.h"
#include "isophote/sampling/sampler.h"
#include "isophote/validity/limit_extrapolation.h"
#include "support/media_room.h"

namespace isophote::bench {
namespace {

using test::MediaRoom;
using Kind = test::AnalyticMedium::Kind;

/// Places on the floor, row by row from that of the greatest y, as pictures have them. Towards the walls irradiance
/// changes faster than differences can follow.
constexpr int side = 60;
constexpr double extent = 0.9, step = 2 * extent / side;
double x_of(int column) { return -extent + step * (column + 0.5); }
double y_of(int row) { return extent - step * (row + 0.5); }

/// The light of the sun that the medium scatters counts 20 times, that it matters beside that of the walls.
MediaRoom room_with(Kind kind) {
  MediaRoom room(kind, 0);
  room.sun *= 20;
  return room;
}

struct Slope {
  double x = 0, y = 0;
  double length() const { return std::hypot(x, y); }
};
Slope operator-(const Slope& a, const Slope& b) { return {a.x - b.x, a.y - b.y}; }

/// Of irradiance, with a margin of one place all round for differences.
class Values {
 public:
  Values(const MediaRoom& room, const ParallelFor& parallel) : all_((side + 2) * (side + 2)) {
    parallel(all_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const int n = static_cast<int>(i);
        all_[i] = of(room, x_of(n % (side + 2) - 1), y_of(n / (side + 2) - 1));
      }
    });
  }
  double at(int column, int row) const { return all_[(row + 1) * (side + 2) + column + 1]; }
  Slope slope(int column, int row) const {
    return {(at(column + 1, row) - at(column - 1, row)) / (2 * step),
            (at(column, row - 1) - at(column, row + 1)) / (2 * step)};
  }

 private:
  static double of(const MediaRoom& room, double x, double y) {
    return static_cast<double>(irradiance(gather_floor(room, x, y, {96, 288}, 2)).value.r);
  }
  std::vector<double> all_;
};

struct Estimate {
  const char* name;
  Jet<Rgb> (*jet)(const HemisphereGather&);
};
constexpr Estimate estimates[] = {
    {"unaware", [](const HemisphereGather& g) { return ward_heckbert_1992(g, RotationWeights::exact); }},
    {"aware-nearer", [](const HemisphereGather& g) { return jarosz_2008b(g, WallDistance::minimum); }},
    {"aware", [](const HemisphereGather& g) { return jarosz_2008b(g); }}};
struct Gathers {
  Strata strata;
  int shells;
};
constexpr Gathers all_gathers[] = {{{16, 48}, 12}, {{32, 96}, 24}};

using Slopes = std::vector<Slope>;

/// By each estimate, of the same gathers.
std::array<Slopes, std::size(estimates)> estimated(const MediaRoom& room, const Gathers& gathers,
                                                   const ParallelFor& parallel) {
  std::array<Slopes, std::size(estimates)> all;
  all.fill(Slopes(side * side));
  parallel(side * side, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int n = static_cast<int>(i);
      const HemisphereGather gather = gather_floor(room, x_of(n % side), y_of(n / side), gathers.strata, gathers.shells,
                                                   static_cast<std::uint32_t>(n + 1));
      for (std::size_t e = 0; e < all.size(); ++e) {
        const Gradient<Rgb> g = estimates[e].jet(gather).translational;
        all[e][i] = {static_cast<double>(g.x.r), static_cast<double>(g.y.r)};
      }
    }
  });
  return all;
}

template <class Value>
void draw(const std::string& path, const Value& value) {
  RgbImage image(side, side);
  for (int i = 0; i < side * side; ++i)
    image.pixels[i] = false_colour(static_cast<float>(std::clamp(value(i), 0.0, 1.0)));
  write_png(path, image, 0);
}

/// Does the shaft's rim meet the floor so near that differences reach across? Irradiance has a kink there.
bool at_rim(const MediaRoom& room, int i) {
  constexpr int reach = 2;
  const auto lit = [&](int dx, int dy) {
    return room.source({x_of(i % side + dx), y_of(i / side + dy), 0}, {0, 0, 1}) > 0;
  };
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (lit(dx, dy) != lit(0, 0)) return true;
  return false;
}

struct Errors {
  double all = 0, off_rim = 0;  ///< root mean squares over the floor, relative to the truth's own
  double median = 0;            ///< of what each place is off by, relative to the truth there
};

Errors errors(const MediaRoom& room, const Slopes& slopes, const Slopes& exact) {
  double off[2] = {}, all[2] = {};
  std::vector<double> relative;
  for (int i = 0; i < side * side; ++i) {
    const double here = (slopes[i] - exact[i]).length(), truth = exact[i].length();
    const bool rim = at_rim(room, i);
    off[rim] += here * here, all[rim] += truth * truth;
    relative.push_back(here / truth);
  }
  std::nth_element(relative.begin(), relative.begin() + relative.size() / 2, relative.end());
  return {std::sqrt((off[0] + off[1]) / (all[0] + all[1])), std::sqrt(off[0] / all[0]), relative[relative.size() / 2]};
}

/// Records of one radius at random places of the floor, the same for all estimates, where none serves yet.
RecordCache floor_records(const MediaRoom& room, const Estimate& estimate, float radius) {
  constexpr std::uint32_t tries = 10000, places = side * side;
  RecordCache cache({{-1, -1, -1}, {1, 1, 1}});
  for (std::uint32_t i = 0; i < tries + places; ++i) {  // then none of those that are looked at is left without
    Sampler sampler(Purpose::test, 1, 0, i);
    const Vec2 at = sampler.next2();
    const int place = static_cast<int>(i) - static_cast<int>(tries);
    const double x = place < 0 ? extent * (2 * static_cast<double>(at.x) - 1) : x_of(place % side);
    const double y = place < 0 ? extent * (2 * static_cast<double>(at.y) - 1) : y_of(place / side);
    const Query query{Vec3(Vec3d(x, y, 0)), {0, 0, 1}, {0, 0, 1}};
    if (cache.covers(query)) continue;
    Record record;
    record.position = query.position, record.normal = query.normal;
    record.jet = estimate.jet(gather_floor(room, x, y, all_gathers[1].strata, all_gathers[1].shells, i + 1));
    record.footprint = Footprint::disk(radius, 1);
    record.footprint.order = 1, record.footprint.falloff = Falloff::tent;
    limit_extrapolation(record, radius);
    cache.insert(record);
  }
  return cache;
}

void draw_records(const std::string& folder, const MediaRoom& room, const Values& values, double greatest) {
  constexpr Estimate constant{"values", [](const HemisphereGather& g) { return irradiance(g); }};
  for (const float radius : {0.3f, 0.2f, 0.14f, 0.1f})
    for (const Estimate& estimate : {constant, estimates[0], estimates[2]}) {
      const RecordCache cache = floor_records(room, estimate, radius);
      std::vector<double> found(side * side);
      double off = 0, all = 0;
      for (int i = 0; i < side * side; ++i) {
        const Vec3 at(Vec3d(x_of(i % side), y_of(i / side), 0));
        const double value = values.at(i % side, i / side);
        found[i] = static_cast<double>(cache.interpolate({at, {0, 0, 1}, {0, 0, 1}}).value().r);
        off += (found[i] - value) * (found[i] - value), all += value;
      }
      const std::size_t records = cache.records().size();
      draw(fmt::format("{}/{}-by-{}-records.png", folder, estimate.name, records),
           [&](int i) { return found[i] / greatest; });
      fmt::print("{{\"estimator\": \"{}\", \"records\": {}, \"rmse\": {}}}\n", estimate.name, records,
                 std::sqrt(off * side * side) / all);
    }
}

}  // namespace

void draw_floor_gradients(const std::string& folder, const ParallelFor& parallel) {
  const MediaRoom room = room_with(Kind::homogeneous);
  const Values clear(room_with(Kind::none), parallel), values(room, parallel);
  Slopes exact;
  double greatest = 0, steepest = 0, clear_mean = 0, mean = 0;
  for (int i = 0; i < side * side; ++i) {
    exact.push_back(values.slope(i % side, i / side));
    const double a = clear.at(i % side, i / side), b = values.at(i % side, i / side);
    greatest = std::max({greatest, a, b}), steepest = std::max(steepest, exact.back().length());
    clear_mean += a / (side * side), mean += b / (side * side);
  }
  fmt::print("{{\"clear\": {}, \"medium\": {}, \"greatest\": {}, \"steepest\": {}}}\n", clear_mean, mean, greatest,
             steepest);
  draw(folder + "/clear.png", [&](int i) { return clear.at(i % side, i / side) / greatest; });
  draw(folder + "/medium.png", [&](int i) { return values.at(i % side, i / side) / greatest; });
  const auto draw_slopes = [&](const std::string& path, const auto& slope) {
    draw(path, [&](int i) { return std::sqrt(slope(i).length() / steepest); });  // small ones matter too
  };
  draw_slopes(folder + "/exact.png", [&](int i) { return exact[i]; });
  draw_records(folder, room, values, greatest);
  for (const Gathers& gathers : all_gathers) {
    const auto all = estimated(room, gathers, parallel);
    for (std::size_t e = 0; e < all.size(); ++e) {
      const std::string stem = fmt::format("{}/{}-{}", folder, estimates[e].name, gathers.strata.size());
      draw_slopes(stem + ".png", [&](int i) { return all[e][i]; });
      draw_slopes(stem + "-off.png", [&](int i) { return all[e][i] - exact[i]; });
      const Errors off = errors(room, all[e], exact);
      fmt::print("{{\"estimator\": \"{}\", \"rays\": {}, \"rms\": {}, \"off_rim\": {}, \"median\": {}}}\n",
                 estimates[e].name, gathers.strata.size(), off.all, off.off_rim, off.median);
      std::fflush(stdout);
    }
  }
}

}  // namespace isophote::bench
