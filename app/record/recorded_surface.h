/// The surfaces of a recorded session: its meshes and maps, from its own folder.
#pragma once

#include <map>
#include <memory>

#include "experiment/maps/coordinate_image_lookup.h"
#include "experiment/maps/coordinate_maps.h"
#include "experiment/record/read/session_record.h"

namespace overt {

/// Loads each object's mesh and maps when it is first asked for. Every one of these throws InputError or
/// RecordError for damaged or missing files.
class RecordedSurfaces {
  public:
    enum class Keep : std::uint8_t { all, last };
    /// `record` must outlive this. What it gives lives as long as this, or until another object is asked
    /// for, if only the last is kept.
    explicit RecordedSurfaces(const SessionRecord& record, Keep keep = Keep::all,
                              CoordinateMaps::Use use = CoordinateMaps::Use::many_lookups)
        : record_(&record), keep_(keep), use_(use) {}

    /// Where gaze on an object goes, be its maps of triangles or of coordinates; null if it has none.
    const SurfaceLookup* lookup_of(int object);

  private:
    struct Surface {
        Mesh mesh;
        std::unique_ptr<CoordinateMaps> maps;          ///< with a mesh
        std::unique_ptr<CoordinateImageLookup> images; ///< without, if there are maps
    };
    Surface& surface_of(int object);
    void load_maps(Surface& surface, int object) const;
    void load_images(Surface& surface, int object) const;

    const SessionRecord* record_;
    Keep keep_;
    CoordinateMaps::Use use_;
    std::map<int, std::unique_ptr<Surface>> loaded_;
};

} // namespace overt
