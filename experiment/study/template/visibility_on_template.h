/// What was visible of several objects, as visibility of the template that stands for them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "experiment/scene/mesh.h"
#include "experiment/study/read/exposure.h"
#include "experiment/study/template/surface_bridge.h"

namespace overt {

class VisibilityOnTemplate {
  public:
    /// `onto`: the template's mesh, which must outlive this.
    explicit VisibilityOnTemplate(const Mesh& onto);

    /// Adds an object's visibility, weighted with `share`. A vertex of the template was visible as long as
    /// the place of the object that belongs to it; each vertex of the object gives its seconds times pixels
    /// (by vertex, as in Exposure) to the place to which it is brought, so that none are lost. `across`: null
    /// where the object has the template's own surface. Uses all processors; does not depend on how many.
    void add(const StudyObject& object, std::span<const double> pixel_seconds, const SurfaceBridge* across,
             double share);

    const Exposure& exposure() const { return laid_; }

  private:
    const Mesh& onto_;
    std::vector<std::optional<SurfaceSite>> onto_sites_; ///< by vertex
    Exposure laid_;
};

} // namespace overt
