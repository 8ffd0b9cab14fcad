/// The surfaces of a recorded session: its meshes and maps, from its own folder.
#pragma once

#include <map>
#include <memory>

#include "experiment/maps/coordinate_image_lookup.h"
#include "experiment/maps/coordinate_maps.h"
#include "experiment/maps/glass_sight.h"
#include "experiment/record/read/session_record.h"

namespace overt {

/// Loads an object's mesh and its maps in a view when they are first asked for. Every one of these throws
/// InputError or RecordError for damaged or missing files.
class RecordedSurfaces {
  public:
    enum class Keep : std::uint8_t { all, last };
    /// `record` must outlive this. What it gives lives as long as this, or until another object is asked
    /// for, if only the last is kept.
    explicit RecordedSurfaces(const SessionRecord& record, Keep keep = Keep::all,
                              CoordinateMaps::Use use = CoordinateMaps::Use::many_lookups)
        : record_(&record), keep_(keep), use_(use) {}

    /// Where gaze on an object in a view goes, be its maps of triangles or of coordinates; null if it has
    /// none.
    const SurfaceLookup* lookup_of(const ViewedObject& viewed);

    /// How an object is looked through if it is of clear glass of this index; null if it has no mesh.
    const GlassSight* glass_of(const ViewedObject& viewed, double index);

  private:
    struct Surface {
        Mesh mesh;
        std::unique_ptr<CoordinateMaps> maps;          ///< with a mesh
        std::unique_ptr<CoordinateImageLookup> images; ///< without, if there are maps
        std::map<double, GlassSight> glass;            ///< by the index, of maps
    };
    Surface& surface_of(const ViewedObject& viewed);
    void load_maps(Surface& surface, const ViewedObject& viewed) const;
    void load_images(Surface& surface, const ViewedObject& viewed) const;

    const SessionRecord* record_;
    Keep keep_;
    CoordinateMaps::Use use_;
    std::map<ViewedObject, std::unique_ptr<Surface>> loaded_;
};

} // namespace overt
