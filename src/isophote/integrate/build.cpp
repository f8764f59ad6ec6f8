#include "isophote/integrate/build.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "isophote/cache/radiance_cache.h"
#include "isophote/integrate/adapt_radii.h"
#include "isophote/integrate/build_volumes.h"
#include "isophote/integrate/glossy_rule.h"
#include "isophote/integrate/leak_test.h"
#include "isophote/integrate/make_record.h"
#include "isophote/integrate/over_pixels.h"
#include "isophote/integrate/pick_spread.h"
#include "isophote/integrate/pilot.h"
#include "isophote/integrate/render.h"

namespace isophote {
namespace {

/// Passes over all pixels, one sample each, end when one finds fewer than this part of them uncovered. Where records
/// limit their neighbours those few are left so: one there could uncover more, which nobody would look for.
constexpr double good_coverage = 2e-4;
constexpr int most_passes = 32;

/// An uncovered point of the picture. `reach` is the radius that a record here is expected to have: that of the record
/// nearest in terms of its own footprint.
struct Candidate {
  Place place;  ///< its key is also its turn: well spread
  float nearest = infinity;
  float reach = 0;

  /// Takes note of a record of what is wanted that does not serve here.
  void meet(const Site& record) {
    if (dot(record.normal, place.normal) <= 0) return;
    const float distance = quadratic_form(record.footprint.shape, place.position - record.position);
    if (distance < nearest) nearest = distance, reach = record.footprint.radius;
  }
};

class Builder {
 public:
  Builder(const Job& job, RecordCache& cache) : job_(job), cache_(cache), volumes_(job_, cache) {}

  BuildReport run() {
    job_.progress.tell("build", 0);
    report_.seeding.chosen = job_.method.secondary;
    int stride = 1;
    while (stride * 16 <= std::min(job_.width, job_.height) && stride < 64) stride *= 2;
    for (; stride > 1 && !report_.cancelled; stride /= 2) {
      begin_level(1 + std::countr_zero(static_cast<unsigned>(stride)));
      std::vector<Candidate> candidates = uncovered(stride, 0);
      if (!ready_to_survey(candidates)) continue;
      begin_with_survey(candidates);
      cover(std::move(candidates));
      volumes_.cover(stride, 0, report_.rays);
      report_.cancelled = report_.cancelled || volumes_.cancelled();
      adapt(stride, 0);
      if (job_.progress.preview) job_.progress.preview(coarse_picture(job_, cache_, stride));
    }
    const double pixels = static_cast<double>(job_.width) * job_.height;
    for (int pass = 0; pass < most_passes && !report_.cancelled; ++pass) {
      begin_level(2);
      std::vector<Candidate> left = uncovered(1, pass % job_.samples);
      begin_with_survey(left);
      ++report_.passes;
      const std::size_t in_media = volumes_.cover(1, pass % job_.samples, report_.rays);
      report_.cancelled = report_.cancelled || volumes_.cancelled();
      const bool last = static_cast<double>(left.size() + in_media) < good_coverage * pixels;
      if (!last || !shrinks_others()) cover(std::move(left));
      if (last) break;
      if (pass + 1 < most_passes) adapt(1, pass % job_.samples);
    }
    cache_.reindex();
    if (cache_.radiance()) cache_.radiance()->reindex();
    volumes_.finish();
    report_.rounds += volumes_.rounds();
    report_.pilot = job_.pilot;
    job_.progress.tell("build", 1);
    return report_;
  }

 private:
  /// How much work is left is not known before it is done. Levels of a picture take about equally many records, the
  /// finer ones, which have more places to look at, being better covered from the start: each has one part in as many
  /// as there are levels `left`, itself counted.
  void begin_level(int left) {
    done_ += share_;
    share_ = (1 - done_) / left;
  }

  void add_uncovered(const FirstPoint& seen, std::uint64_t key, std::vector<Candidate>& found,
                     RayCounts& counts) const {
    const std::optional<Place> place = uncovered_place(job_, cache_, seen, key, counts);
    if (!place) return;
    Candidate candidate{*place};
    const auto meet = [&](const Site& record) { candidate.meet(record); };
    if (place->diffuse) cache_.visit_near(place->position, meet);
    if (place->bands > 0) cache_.radiance()->visit_near(place->position, meet);
    found.push_back(candidate);
  }

  /// Are reflections here that the final pass follows rays for worth records of their own? Where they are faint, the
  /// few samples behind them that no record covers may as well be paths.
  bool shines(const FirstPoint& seen) const {
    if (!seen.point || !seen.point->bsdf.has_glossy()) return false;
    const Bsdf& bsdf = seen.point->bsdf;
    const float by_rays = 1 - cached_lobe(job_.method.glossy, bsdf, -seen.direction).share;
    return by_rays * max_component(specular_albedo(bsdf, -dot(seen.direction, bsdf.frame.n))) > 0.25f;
  }
  /// What a glossy surface shows: there the final pass reads the cache too.
  FirstPoint reflected(const FirstPoint& seen, Sampler& stream, RayCounts& counts) const {
    FirstPoint next = glossy_ray(job_.world.clear(), *seen.point, -seen.direction, stream, counts).next;
    next.path_length += seen.path_length;
    next.depth += seen.depth + 1;
    return next;
  }

  /// The uncovered points that sample `sample` of every stride-th pixel sees, by itself and reflected, ordered by key.
  std::vector<Candidate> uncovered(int stride, int sample) {
    const auto look = [&](int x, int y, std::vector<Candidate>& found, RayCounts& counts) {
      Sampler stream = job_.sampler(x, y, sample);
      const FirstPoint seen =
          first_point(job_.world.clear(), job_.camera_ray(x, y, stream), true, stream, counts.camera);
      const std::uint64_t key = hash(job_.seed, x, y, sample);
      add_uncovered(seen, key, found, counts);
      if (shines(seen)) add_uncovered(reflected(seen, stream, counts), hash(key), found, counts);
    };
    auto all = collect_over_pixels<Candidate>(job_, stride, report_.rays, look);
    std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.place.key < b.place.key; });
    return all;
  }

  /// Where a survey learns what irradiance is like: where it is wanted, or anywhere where that is nowhere.
  static std::vector<Place> to_survey(const std::vector<Candidate>& candidates) {
    const bool any = std::any_of(candidates.begin(), candidates.end(), [](const auto& c) { return c.place.diffuse; });
    std::vector<Place> places;
    for (const Candidate& c : candidates)
      if (places.size() < surveyed_places && (c.place.diffuse || !any)) places.push_back(c.place);
    return places;
  }

  /// Levels too coarse to show what the picture is like are left out.
  bool ready_to_survey(const std::vector<Candidate>& candidates) const {
    return !must_survey(job_) || !cache_.records().empty() || to_survey(candidates).size() >= surveyed_places;
  }

  /// Before the first record, fills cells and surveys the picture, where the method wants that, the latter at the first
  /// candidates, whose jets then make the first records; where there are records already, candidates are no fair
  /// choice.
  void begin_with_survey(std::vector<Candidate>& candidates) {
    if (candidates.empty()) return;
    if (!seeded_) {
      seeded_ = true;
      report_.seeding = seed_cells(job_, cache_, report_.rays);
      job_.method.secondary = report_.seeding.chosen;
    }
    if (!must_survey(job_)) return;
    if (!cache_.records().empty()) {
      job_.pilot = survey(job_, cache_, random_places(job_, report_.rays), report_.rays).pilot;
      return;
    }
    const std::vector<Place> places = to_survey(candidates);
    const Survey first = survey(job_, cache_, places, report_.rays);
    job_.pilot = first.pilot;
    const LeakTest open{job_.world, report_.rays};
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Place& place = places[i];
      if (!place.diffuse || cache_.covers(query_at(place), open)) continue;
      const auto id =
          cache_.insert(job_.method.make_record(place.position, place.normal, first.jets[i], view_of(job_, place)));
      job_.method.settle(cache_.settling(), {&id, 1});
      report_.places.push_back(place);
    }
    std::erase_if(candidates, [&](Candidate& c) {
      if (!still_wants(cache_, c.place, open)) return true;
      if (c.place.diffuse)
        for (const Record& record : cache_.records()) c.meet(record);
      return false;
    });
  }

  /// Can a new record uncover what others covered?
  bool shrinks_others() const {
    const GlossyMethod& glossy = job_.method.glossy;
    return job_.method.metric->settle || (glossy.caches() && (glossy.metric->settle_radiance || glossy.contrast > 0));
  }

  /// Rounds, until records cover all candidates.
  void cover(std::vector<Candidate> candidates) {
    const auto all = static_cast<double>(candidates.size());
    while (!candidates.empty()) {
      if (job_.progress.stop()) {
        report_.cancelled = true;
        return;
      }
      const FreshIds fresh = add_round(pick(candidates));
      report_.rays += for_each(job_.parallel, candidates.size(), 256,
                               [&](std::size_t i, RayCounts& counts) { take_note(fresh, candidates[i], counts); });
      std::size_t kept = 0;
      for (std::size_t i = 0; i < candidates.size(); ++i)
        if (candidates[i].place.diffuse || candidates[i].place.bands > 0) candidates[kept++] = candidates[i];
      candidates.resize(kept);
      ++report_.rounds;
      job_.progress.tell("build", done_ + (1 - static_cast<double>(kept) / all) * share_);
    }
  }

  void adapt(int stride, int sample) {
    if (job_.method.glossy.contrast > 0 && cache_.radiance() && !report_.cancelled)
      adapt_radii(job_, *cache_.radiance(), stride, sample, report_.rays);
  }

  /// What fresh records serve a candidate no longer wants; the others it meets.
  void take_note(const FreshIds& fresh, Candidate& candidate, RayCounts& counts) const {
    const LeakTest open{job_.world, counts};
    Place& place = candidate.place;
    const Query query = query_at(place);
    for (const std::uint32_t id : fresh.irradiance) {
      if (!place.diffuse) break;
      const Record& record = cache_.records()[id];
      place.diffuse = !(serving_error(record, query, open) < 1);
      if (place.diffuse) candidate.meet(record);
    }
    for (const std::uint32_t id : fresh.radiance) {
      if (place.bands == 0) break;
      const RadianceRecord& record = cache_.radiance()->records()[id];
      const bool serves = RadianceCache::holds(record, place.bands) && serving_error(record, query, open) < 1;
      if (serves) place.bands = 0;
      if (!serves) candidate.meet(record);
    }
  }

  /// The first candidates in order that are not within each other's expected reach; takes them out of the list.
  static std::vector<Place> pick(std::vector<Candidate>& candidates) {
    const auto near = [](const Candidate& a, const Candidate& b) {
      const float reach = std::max(a.reach, b.reach);
      return length_squared(a.place.position - b.place.position) < reach * reach &&
             dot(a.place.normal, b.place.normal) > 0;
    };
    std::vector<Place> places;
    for (const Candidate& c : pick_spread(candidates, near)) places.push_back(c.place);
    return places;
  }

  FreshIds add_round(const std::vector<Place>& places) {
    std::vector<NewRecords> made(places.size());
    left_.resize(std::max(left_.size(), places.size()));
    for (IrradianceCells& left : left_) left.clear();
    report_.rays += for_each(job_.parallel, places.size(), 1, [&](std::size_t i, RayCounts& counts) {
      thread_local HemisphereGather scratch;
      made[i] = make_records(job_, cache_, places[i], scratch, left_[i], counts);
    });
    take_in(job_.world, cache_.cells(), left_, report_.rays);
    for (const Place& place : places)
      if (place.diffuse) report_.places.push_back(place);
    return add_records(job_.method, cache_, std::move(made));
  }

  BuildReport report_;
  Job job_;
  RecordCache& cache_;
  VolumeBuilder volumes_;
  std::vector<IrradianceCells> left_;  // by the gathers of a round
  bool seeded_ = false;                // the cells
  double done_ = 0, share_ = 0;        // of the build: before the present level, and of it
};

}  // namespace

RecordCache empty_cache(const Job& job) {
  const Box bounds = job.world.scene.bounds();
  RecordCache cache(bounds);
  const GlossyMethod& glossy = job.method.glossy;
  if (glossy.caches()) cache.set_radiance(std::make_shared<RadianceCache>(bounds, glossy.basis));
  if (job.method.volume.caches() && job.world.media) cache.set_volumes(std::make_shared<VolumeCaches>(bounds));
  return cache;
}

BuildReport build_in_rounds(const Job& job, RecordCache& cache) { return Builder(job, cache).run(); }

}  // namespace isophote
