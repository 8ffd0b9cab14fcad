/// The surfaces that a study's sessions have, one in memory at a time.
#pragma once

#include <memory>

#include "app/record/recorded_surface.h"
#include "experiment/study/read/study_reader.h"

namespace overt {

/// What read_study() asks for objects with. Copies share what they hold.
class StudySurfaces {
  public:
    const SurfaceLookup* operator()(const SessionRecord& record, std::size_t /*session*/,
                                    const ViewedObject& viewed) {
        // The one before goes first, so that two are never in memory.
        held_->reset();
        held_->emplace(record, RecordedSurfaces::Keep::last, CoordinateMaps::Use::many_lookups);
        return (*held_)->lookup_of(viewed);
    }

  private:
    std::shared_ptr<std::optional<RecordedSurfaces>> held_ =
        std::make_shared<std::optional<RecordedSurfaces>>();
};

} // namespace overt
