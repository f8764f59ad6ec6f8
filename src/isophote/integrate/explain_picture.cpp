#include "isophote/integrate/explain_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isophote {
namespace {

constexpr std::array<LegendColour, 8> legend{{{"red", {1, 0.05f, 0.05f}},
                                              {"yellow", {1, 0.85f, 0}},
                                              {"green", {0.05f, 0.8f, 0.1f}},
                                              {"cyan", {0, 0.8f, 0.9f}},
                                              {"blue", {0.1f, 0.25f, 1}},
                                              {"magenta", {0.9f, 0.1f, 0.9f}},
                                              {"orange", {1, 0.3f, 0}},
                                              {"white", Rgb(0.9f)}}};
const Rgb grey(0.25f);
constexpr float thick = 2.5f, thin = 1.2f, dot_radius = 3, cross_arm = 9;  // pixels of the picture that is drawn

/// Shows all footprints about the pixel whole, as a plane across the line of sight would, and some room about them.
Window window_around(const Job& job, const Explanation& explanation, int x, int y) {
  Window window(job);
  if (explanation.serving.empty()) return window;
  float reach = 0;
  for (const ServingRecord& s : explanation.serving) reach = std::max(reach, s.distance + s.reach.axes.longer);
  const float pixels = 1.2f * reach / job.pixel_footprint(explanation.seen.path_length);
  const auto width = static_cast<float>(job.width), height = static_cast<float>(job.height);
  window.zoom = std::clamp(0.5f * std::min(width, height) / pixels, 1.0f, 32.0f);
  const auto middle = [&](float at, float size) {
    const float half = 0.5f * size / window.zoom;
    return std::clamp(at + 0.5f, half, size - half);
  };
  window.x = middle(static_cast<float>(x), width), window.y = middle(static_cast<float>(y), height);
  return window;
}

struct Drawn {
  const Record* record;
  Rgb colour;
  float width;
};

}  // namespace

const LegendColour& legend_colour(std::size_t rank) { return legend[std::min(rank, legend.size() - 1)]; }

ExplanationPicture explanation_picture(const Job& job, const RecordCache& cache, const Explanation& explanation, int x,
                                       int y) {
  const Window window = window_around(job, explanation, x, y);
  std::vector<Drawn> all;  // what comes first lies on top
  for (const ServingRecord& s : explanation.serving)
    all.push_back({&cache.records()[s.id], legend_colour(all.size()).colour, thick});
  for (const NearMiss& miss : explanation.near_misses) all.push_back({&cache.records()[miss.id], grey, thin});

  const auto mark = [&](float u, float v, const std::optional<Sight>& sight) -> std::optional<Rgb> {
    const float right = std::abs(u - static_cast<float>(x) - 0.5f) * window.zoom;
    const float down = std::abs(v - static_cast<float>(y) - 0.5f) * window.zoom;
    if (std::min(right, down) < 0.5f * thick && std::max(right, down) < cross_arm) return Rgb(1.0f);
    for (const Drawn& drawn : all) {
      if (!sight || dot(drawn.record->normal, sight->place.normal) < 0) continue;
      const OnScreen at = on_screen(*drawn.record, *sight);
      if (at.inside_rim < 0) continue;
      if (at.inside_rim < drawn.width || at.from_centre < dot_radius) return drawn.colour;
    }
    return std::nullopt;
  };
  return {marked_picture(job, cache, window, mark), window};
}

}  // namespace isophote
