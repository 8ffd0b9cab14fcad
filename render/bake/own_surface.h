/// A surface that is at each place as its object's file says: matt, or metal and plastic by share as
/// LayeredSurface has them, whose formula this is, with colour, share of metal and roughness of the place.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "experiment/scene/surface_appearance.h"
#include "render/bake/layered_surface.h"

namespace overt {

/// Changes whenever the same inputs would give other light: part of the key under which frames are kept.
constexpr int own_surface_version = 1;

/// What a path finds where it meets such a surface.
struct OwnPoint {
    Bins colour{};
    float metallic = 0.0f;
    std::size_t level = 0; ///< of roughness
};

/// Made once for a stimulus and asked from any number of threads.
class OwnSurface {
  public:
    /// `material`: of kind `own`, or with base = own, of which it then has all but the colour. Roughness that
    /// a picture gives is taken in steps of a thirty-second.
    OwnSurface(std::shared_ptr<const SurfaceAppearance> appearance, const MaterialSettings& material);

    /// At a place of a triangle, as look_at() has it.
    OwnPoint point(std::uint32_t triangle, glm::vec2 place) const;

    // As of LayeredSurface, at event.point.
    glm::vec3 scatter(const SurfaceEvent& event, SampleSequence& sequence, Bins& carried) const;
    float density(const SurfaceEvent& event, glm::vec3 onward) const;
    void take(const SurfaceEvent& event, glm::vec3 onward, Bins& carried) const;
    Bins value(const SurfaceEvent& event, glm::vec3 onward) const;

  private:
    /// What one roughness gives back at once, by the angle: Schlick's curve is the sum of its colour times
    /// what it leaves to it, and of what is white towards grazing.
    struct Level {
        float alpha = 0.0f;
        LobeAlbedo dielectric, lossless, grazing;
    };
    struct Chances;
    Chances chances(const OwnPoint& point, float cosine) const;

    std::shared_ptr<const SurfaceAppearance> appearance_;
    bool is_matt_ = false, is_pigment_ = false;
    float ior_ = 1.5f, inner_ = 0.0f;
    std::optional<float> metallic_; ///< of the protocol, in place of the file's
    bool has_own_roughness_ = true;
    /// What a material of kind `own` gives in place of what the file says.
    struct Given {
        std::optional<glm::vec3> colour;
        std::optional<float> metallic;
        std::optional<std::size_t> level; ///< of roughness
    };
    std::vector<Given> given_; ///< for each of the file's materials; empty: nothing
    std::vector<Level> levels_;
    std::vector<std::size_t> level_of_step_;
    std::optional<LayeredSurface::Mirrors> coat_;
    std::array<Bins, 3> basis_; ///< reflectances of linear red, green and blue
};

/// For each of the file's materials (for one, where it has none) whether it is among those that the
/// properties hold for that are given in place of the file's (MaterialSettings::of).
std::vector<bool> given_materials(const MaterialSettings& material, const SurfaceAppearance& appearance);

/// What each of the file's materials is where one colour, share of metal and roughness have to stand for all
/// of it: the means over its triangles. One without triangles has none.
std::vector<std::optional<MaterialSettings>>
each_on_average(const MaterialSettings& material, const SurfaceAppearance& appearance, const Mesh& mesh);

/// What a material of the file's is where one colour has to stand for all: the mean over the surface.
MaterialSettings on_average(const MaterialSettings& material, const SurfaceAppearance& appearance,
                            const Mesh& mesh);

} // namespace overt
