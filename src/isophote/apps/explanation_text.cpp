#include "isophote/apps/explanation_text.h"

#include <fmt/format.h>

#include <string_view>

#include "isophote/apps/table.h"
#include "isophote/integrate/explain_picture.h"

namespace isophote::app {
namespace {

std::string triple(const Vec3& v) { return fmt::format("{:.4g} {:.4g} {:.4g}", v.x, v.y, v.z); }
std::string triple(const Rgb& c) { return fmt::format("{:.4g} {:.4g} {:.4g}", c.r, c.g, c.b); }
std::string percent(float part) { return fmt::format("{:.2f}%", 100 * part); }
std::string degrees(float radians) { return fmt::format("{:.1f}", radians * (180 / pi)); }
std::string length_of(float metres) { return fmt::format("{:.4g}", metres); }

/// A line "  what       text".
void say(std::string_view what, const std::string& text) { fmt::print("  {:<11}{}\n", what, text); }

std::string quoted(const std::string& name) { return name.empty() ? "without a name" : "'" + name + "'"; }

/// What had a say in a radius besides the metric.
std::string changes(const Reach& reach) {
  std::string text;
  const auto add = [&](bool changed, const char* what) {
    if (changed) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  add(reach.gradient, "less by the gradient");
  add(reach.neighbours, "less by neighbours");
  add(reach.raised, "raised to the least");
  add(reach.lowered, "cut to the largest");
  return text.empty() ? "nothing" : text;
}

/// A column of a table of records.
template <class R>
struct Column {
  std::string heading;
  std::string (*cell)(const R&);
};

template <class R, std::size_t n>
void print_records(const std::vector<R>& records, const Column<R> (&columns)[n],
                   const std::vector<std::string>& names) {
  std::vector<Row> rows(1);
  rows[0].push_back("  record");
  for (const Column<R>& column : columns) rows[0].push_back(column.heading);
  for (std::size_t i = 0; i < records.size(); ++i) {
    Row& row = rows.emplace_back(Row{names[i]});
    for (const Column<R>& column : columns) row.push_back(column.cell(records[i]));
  }
  print_table(rows);
}

using S = ServingRecord;
const Column<S> shares[] = {
    {"share", [](const S& s) { return percent(s.share); }},
    {"weight", [](const S& s) { return fmt::format("{:.4g}", s.weight); }},
    {"distance m", [](const S& s) { return length_of(s.distance); }},
    {"of the way to the rim", [](const S& s) { return percent(s.footprint_error); }},
    {"turned deg", [](const S& s) { return degrees(s.angle); }},
    {"value W/m2", [](const S& s) { return triple(s.value); }},
    {"extrapolated W/m2", [](const S& s) { return triple(s.extrapolated); }},
    {"predicted error", [](const S& s) { return percent(s.predicted_error); }},
    {"leak test", [](const S& s) { return std::string(s.tested ? "ray: free" : "not needed"); }},
};
const Column<S> reaches[] = {
    {"position m", [](const S& s) { return triple(s.position); }},
    {"semi-axes m",
     [](const S& s) { return fmt::format("{:.4g} x {:.4g}", s.reach.axes.longer, s.reach.axes.shorter); }},
    {"height m", [](const S& s) { return length_of(s.reach.axes.height); }},
    {"by the metric m", [](const S& s) { return length_of(s.reach.natural); }},
    {"changed by", [](const S& s) { return changes(s.reach); }},
    {"gradient kept", [](const S& s) { return percent(s.reach.gradient_kept); }},
    {"curvature kept", [](const S& s) { return percent(s.reach.curvature_kept); }},
};

using M = NearMiss;
const Column<M> misses[] = {
    {"distance m", [](const M& m) { return length_of(m.distance); }},
    {"over that of its rim", [](const M& m) { return fmt::format("{:.3f}", m.rim); }},
    {"turned deg", [](const M& m) { return degrees(m.angle); }},
    {"why not", [](const M& m) { return std::string(words_of(m.why).sentence); }},
};

void print_surface(const ExplainedPixel& pixel, const Explanation& e) {
  const SurfacePoint& point = *e.seen.point;
  const Mesh& mesh = pixel.job.world.scene.meshes[point.mesh];
  const Material& material = pixel.job.world.scene.materials[static_cast<std::size_t>(mesh.material)];
  std::string way;
  if (e.seen.depth > 0)
    way = fmt::format(", through {} mirror{} or glass, first mesh {}", e.seen.depth, e.seen.depth > 1 ? "s" : "",
                      quoted(pixel.job.world.scene.meshes[e.seen.first_mesh].name));
  say("sees", fmt::format("mesh {}, material {}{}", quoted(mesh.name), quoted(material.name), way));
  say("at", fmt::format("{} m, normal {}, mapped normal {}", triple(point.position), triple(point.shading_normal),
                        triple(point.bsdf.frame.n)));
  say("from", fmt::format("{:.4g} m away, depth {:.4g} m, a pixel spans {:.3g} m", e.seen.path_length, e.depth,
                          pixel.job.pixel_footprint(e.seen.path_length)));
}

/// Why no record can have to do with the pixel.
std::string no_surface(const Job& job, const FirstPoint& seen) {
  if (seen.first_distance == infinity) return "the sky: no record has to do with it";
  if (!seen.point && seen.path_length == infinity) return "the sky, by mirrors or glass: no record has to do with it";
  if (!seen.point) return "mirrors or glass in which the path ended: no record has to do with it";
  if (!seen.point->bsdf.has_diffuse()) return "a surface that scatters nothing diffusely: it reads no record";
  return fmt::format("a surface where --max-depth {} leaves nothing for records to say", job.world.max_depth);
}

std::vector<std::string> serving_names(const Explanation& e) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < e.serving.size(); ++i)
    names.push_back(fmt::format("  {} {}", e.serving[i].id, legend_colour(i).name));
  return names;
}

}  // namespace

Words words_of(Standing standing) {
  // In the order of Standing.
  constexpr Words words[] = {{"beyond_rim", "the pixel is beyond its rim"},
                             {"facing_away", "it faces away"},
                             {"in_front", "it lies in front"},
                             {"turned", "its normal differs too much"},
                             {"blocked", "something stands between"},
                             {"serves", "it serves"}};
  return words[static_cast<std::size_t>(standing)];
}

void print_explanation(const ExplainedPixel& pixel, const Explanation& e) {
  const Job& job = pixel.job;
  fmt::print("pixel {},{} of {} x {}, method {}, {} records\n", pixel.x, pixel.y, job.width, job.height,
             job.method.name, pixel.cache.records().size());
  if (e.seen.point) print_surface(pixel, e);
  if (!e.reads_cache) say(e.seen.point ? "but" : "sees", no_surface(job, e.seen));
  say("radiance",
      fmt::format("{} W/m2/sr: direct {}, indirect {} (mean of {} sample{})", triple(e.mean.direct + e.mean.indirect),
                  triple(e.mean.direct), triple(e.mean.indirect), job.samples, job.samples > 1 ? "s" : ""));
  if (!e.reads_cache) return;
  if (e.irradiance)
    say("irradiance", fmt::format("{} W/m2, indirect, from {} record{}; predicted error {}", triple(*e.irradiance),
                                  e.serving.size(), e.serving.size() > 1 ? "s" : "", percent(e.predicted_error)));
  else
    say("irradiance", "no record serves here: the sample goes on as a path");
  if (!e.serving.empty()) {
    fmt::print("\nrecords that serve\n");
    print_records(e.serving, shares, serving_names(e));
    fmt::print("\nhow far they reach\n");
    print_records(e.serving, reaches, serving_names(e));
  }
  if (e.near_misses.empty()) return;
  fmt::print("\nrecords that nearly do\n");
  std::vector<std::string> names;
  for (const NearMiss& miss : e.near_misses) names.push_back(fmt::format("  {}", miss.id));
  print_records(e.near_misses, misses, names);
}

}  // namespace isophote::app
