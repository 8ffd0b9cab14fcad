/// The surfaces of a recorded session: its meshes and maps, from its own folder.
#pragma once

#include <map>
#include <memory>

#include "experiment/analysis/coordinate_maps.h"
#include "experiment/record/session_record.h"

namespace overt {

/// Loads each sculpture's mesh and maps when it is first asked for.
class RecordedSurfaces {
  public:
    /// `record` must outlive this.
    explicit RecordedSurfaces(const SessionRecord& record) : record_(&record) {}

    /// The maps of a sculpture, or null if it has none. Throws InputError or RecordError for damaged or
    /// missing files.
    const CoordinateMaps* maps_of(int sculpture);
    /// Only for a sculpture that has maps.
    const Mesh& mesh_of(int sculpture) { return loaded_.at(sculpture)->mesh; }

  private:
    struct Surface {
        Mesh mesh;
        std::unique_ptr<CoordinateMaps> maps;
    };
    const SessionRecord* record_;
    std::map<int, std::unique_ptr<Surface>> loaded_;
};

} // namespace overt
