#pragma once

#include "isophote/cache/catalogue.h"
#include "isophote/cache/irradiance_cells.h"
#include "isophote/cache/record_cache.h"
#include "isophote/trace/path.h"

namespace isophote {

/// Where the diffuse lobes of points that rays meet get their indirect irradiance from: from records where they cover
/// the point, else from cells, else from a path. Refers to what its maker keeps.
struct FarLight {
  const RecordCache* records = nullptr;
  const IrradianceCells* cells = nullptr;  ///< as earlier rounds left them
  IrradianceCells* left = nullptr;         ///< what this reader leaves for later ones; not null where `cells` is not
  const GlossyMethod* glossy = nullptr;    ///< by which the records' incident radiance is read for glossy lobes; null:
                                           ///< rays are followed

  bool none() const { return !records && !cells; }
};

/// Irradiance at a point, about its interpolated normal, by the samples in its cell: their mean where there are enough,
/// else one more, which goes on by the same rule at what it hits. Its expectation is the irradiance, averaged over the
/// cell. `distance` is that of the ray that met the point, `depth` counts the scattering events before it, and
/// `survival` is the chance, above 0, with which a sample is taken: those that are not count as no light, which the
/// others make up for.
Rgb cell_irradiance(const World& world, const FarLight& from, const SurfacePoint& point, float distance, int depth,
                    float survival, Sampler& sampler, RayCounts& counts);

/// Adds to `cells` what several readers of them left, in their order.
void take_in(const World& world, IrradianceCells& cells, std::span<const IrradianceCells> left, RayCounts& counts);

}  // namespace isophote
