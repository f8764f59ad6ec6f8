#include <fmt/format.h>

#include <array>
#include <charconv>

#include "isophote/apps/explanation_text.h"
#include "isophote/apps/output_files.h"
#include "isophote/apps/session.h"
#include "isophote/core/atomic_file.h"
#include "isophote/core/error.h"
#include "isophote/image/png.h"
#include "isophote/integrate/explain_picture.h"

namespace isophote::app {
namespace {

struct Pixel {
  int x = 0, y = 0;
};

Pixel parsed_pixel(const std::string& text) {
  Pixel pixel;
  const char* const end = text.data() + text.size();
  const auto x = std::from_chars(text.data(), end, pixel.x);
  if (x.ec == std::errc() && x.ptr != end && *x.ptr == ',') {
    const auto y = std::from_chars(x.ptr + 1, end, pixel.y);
    if (y.ec == std::errc() && y.ptr == end) return pixel;
  }
  throw UsageError(fmt::format("--pixel: wants X,Y, whole numbers from the top left, not '{}'", text));
}

void check_inside(const Pixel& p, const Job& job) {
  if (p.x < 0 || p.x >= job.width || p.y < 0 || p.y >= job.height)
    throw UsageError(fmt::format("--pixel: {},{} is outside the picture, which has {} x {} pixels", p.x, p.y, job.width,
                                 job.height));
}

void check_explainable(const RenderSettings& settings, const Method& method) {
  if (!method.caches()) throw UsageError("method 'path' caches nothing: there are no records to explain a pixel by");
  if (settings.lazy) throw UsageError("--order lazy has other records at each pixel: explain takes no such order");
}

/// Files are judged before the work.
std::vector<NamedFile> checked_outputs(const ExplainRequest& request) {
  if (request.picture.empty()) return {};
  const std::vector<NamedFile> outputs{{"-o " + request.picture, request.picture}};
  require_png(outputs[0]);
  check_kept(std::array{NamedFile{"the scene", request.scene}}, outputs);
  if (!request.load_cache.empty())
    check_kept(std::array{NamedFile{"the records of --load-cache", request.load_cache}}, outputs);
  AtomicFile{request.picture};
  return outputs;
}

}  // namespace

int explain(const ExplainRequest& request) {
  const Pixel at = parsed_pixel(request.pixel);
  const std::vector<NamedFile> outputs = checked_outputs(request);
  Session session(request);
  session.read();
  for (const std::string& file : session.loaded().files)
    check_kept(std::array{NamedFile{file + ", which the scene is read from", file}}, outputs);
  check_explainable(session.settings(), session.method());
  session.prepare();
  Job& job = session.job();
  check_inside(at, job);

  RecordCache cache = session.starting_cache();
  const bool cancelled = session.build(cache).cancelled;
  session.display().clear();
  if (cancelled) {
    fmt::print(stderr, "isophote: interrupted: the records are not complete\n");
    return 1;
  }
  RayCounts counts;
  const std::optional<RecordCache> fitted = session.fitted(cache, counts);
  const RecordCache& shown = fitted ? *fitted : cache;
  const Explanation explanation = isophote::explain(job, shown, at.x, at.y, &cache);
  const ExplainedPixel pixel{job, shown, at.x, at.y};
  request.json ? print_explanation_json(pixel, explanation) : print_explanation(pixel, explanation);
  if (request.picture.empty()) return 0;
  const auto [picture, window] = explanation_picture(job, shown, explanation, at.x, at.y);
  write_png(request.picture, picture, 0);
  if (!request.json) fmt::print("\n{}: {:.3g} times enlarged\n", request.picture, window.zoom);
  return 0;
}

}  // namespace isophote::app
