/// Makes the hidden maps that the cache lacks.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "render/stimulus/coordinate_pass.h"
#include "render/stimulus/mesh_buffers.h"
#include "render/stimulus/stimulus_cache.h"

namespace overt {

/// Told how far a longer piece of work is: `done` of `total` pieces, and which share of the time they are
/// thought to take. What it throws ends the work; what was finished by then is kept.
using Progress = std::function<void(std::string_view what, int done, int total, double share)>;

class MapMaker {
  public:
    /// Both must outlive the maker, which is used on the context's thread.
    MapMaker(const GlContext& context, const StimulusCache& cache) : context_(&context), cache_(&cache) {}

    /// Brings ready-made maps (see given_maps.h) into the cache as maps of coordinates. Throws as
    /// read_given_map does.
    void prepare_given_maps(const Progress& progress);

    /// Draws whatever maps the cache lacks, of all objects with a mesh in all views, or of one. Throws
    /// InputError for an object that is nowhere in the picture, GraphicsError, RecordError.
    void prepare_maps(const Progress& progress);
    void prepare_maps(const ViewedObject& viewed, const Progress& progress);

    /// Draws a map that the cache lacks. Gives false if there was nothing to do. Throws likewise.
    bool draw_missing_map(const ViewedObject& viewed, PoseIndex pose);

    /// Draws one pose anew, past the cache: for a look and for measurements.
    TriangleMap draw_map(const ViewedObject& viewed, PoseIndex pose);

    /// An object on the card, which holds one at a time; `for_light`: with what StimulusRenderer needs.
    const MeshBuffers& buffers_of(int object, bool for_light);

  private:
    const GlContext* context_;
    const StimulusCache* cache_;
    std::optional<CoordinatePass> coordinate_pass_;
    std::optional<MeshBuffers> buffers_;
    int buffered_object_ = -1;
    bool buffered_for_light_ = false;
};

} // namespace overt
