/// An object in a material, made ready for paths.
#pragma once

#include <memory>
#include <optional>

#include "experiment/protocol/protocol.h"
#include "experiment/scene/mesh.h"
#include "experiment/scene/surface_appearance.h"
#include "render/bake/conductor.h"
#include "render/bake/surface_tree.h"

namespace overt {

class Bumps;
class Glass;
class LayeredSurface;
class Medium;
class OwnSurface;
struct MaterialModel;

/// Built once for a stimulus and used for all its poses, from any number of threads.
class BakeScene {
  public:
    /// The mesh may go afterwards. `appearance`: of the mesh, for a material that is of it
    /// (MaterialSettings::is_of_file); without one such a material has the same reflectance everywhere.
    /// Throws InputError for an unknown metal and for what the material does not allow, GraphicsError if
    /// Embree refuses.
    BakeScene(const Mesh& mesh, const MaterialSettings& material,
              std::shared_ptr<const SurfaceAppearance> appearance = nullptr);
    ~BakeScene();
    BakeScene(BakeScene&&) noexcept;
    BakeScene& operator=(BakeScene&&) noexcept;

    /// Numbers of the surfaces in tree().
    static constexpr int body = 0, coat = 1;

    const MaterialModel& model() const { return *model_; }
    const MaterialSettings& material() const { return material_; }
    glm::dvec3 centre() const { return centre_; } ///< of the mesh; paths have their coordinates about it
    float radius() const { return radius_; }      ///< of a sphere about the centre that holds all surfaces
    float step_off() const {
        return 2e-6f * radius_;
    } ///< how far off a surface a path goes on, lest it meet it again
    /// Whether the mesh bounds a volume: then its surface has one side.
    bool is_closed() const { return is_closed_; }

    const SurfaceTree& tree() const { return *tree_; }                                 ///< all surfaces
    const SurfaceTree& body_tree() const { return coat_body_ ? *coat_body_ : *tree_; } ///< the mesh itself
    const ConductorTable& metal() const { return metal_; }
    const Bins& reflectance() const { return reflectance_; }  ///< of a body with a colour
    const LayeredSurface& layers() const { return *layers_; } ///< only of a layered material
    const OwnSurface* own() const { return own_.get(); } ///< only of a material that is of the file's surface
    bool has_coat() const { return material_.kind == MaterialKind::coated_conductor; }
    const Glass* glass() const { return glass_.get(); }    ///< null: light does not go through
    const Medium* medium() const { return medium_.get(); } ///< null: nothing that scatters is inside
    const Bumps* bumps() const { return bumps_.get(); }    ///< null: the surface is as smooth as its mesh
    const Bins& absorbance() const { return absorbance_; } ///< of what is inside, per unit of length

  private:
    MaterialSettings material_;
    const MaterialModel* model_;
    glm::dvec3 centre_{0.0};
    float radius_ = 1.0f;
    bool is_closed_ = false;
    ConductorTable metal_;
    Bins reflectance_, absorbance_;
    std::unique_ptr<TracedSurface> body_surface_, coat_surface_; // the trees hold their addresses
    std::unique_ptr<SurfaceTree> tree_, coat_body_;
    std::unique_ptr<LayeredSurface> layers_;
    std::unique_ptr<OwnSurface> own_;
    std::unique_ptr<Bumps> bumps_;
    std::unique_ptr<Glass> glass_; ///< or the border of a translucent body
    std::unique_ptr<Medium> medium_;
};

} // namespace overt
