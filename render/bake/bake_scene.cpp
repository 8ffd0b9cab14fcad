#include "render/bake/bake_scene.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/scene/mesh_topology.h"
#include "render/bake/bumps.h"
#include "render/bake/coat_surface.h"
#include "render/bake/glass.h"
#include "render/bake/layered_surface.h"
#include "render/bake/light_colour.h"
#include "render/bake/material_model.h"
#include "render/bake/medium.h"
#include "render/bake/own_surface.h"
#include "render/bake/thin_film.h"

namespace overt {

namespace {

/// Edges that are not between two triangles, at most, of a mesh that still counts as closed: what a scan
/// leaves.
constexpr double open_share = 1e-3;

/// Throws InputError if a coat cannot be put around the mesh, or it cannot be of glass. `what`: "a coat",
/// `lies`: "outside", `instead`: "a material without a coat".
void expect_body(const EdgeCounts& edges, double volume, std::string_view what, std::string_view lies,
                 std::string_view instead) {
    const std::size_t faulty = edges.boundary + edges.non_manifold + edges.conflicting;
    if (static_cast<double>(faulty) > open_share * static_cast<double>(edges.edges)) {
        throw InputError(fmt::format(
            "{} needs a closed surface, but {} of the mesh's {} edges are open, {} belong to more than two "
            "triangles and at {} the fronts disagree: close the mesh, or use {}",
            what, edges.boundary, edges.edges, edges.non_manifold, edges.conflicting, instead));
    }
    if (!(volume > 0.0)) {
        throw InputError(
            fmt::format("{} lies {}, but the mesh's fronts face inwards: turn its faces round, or "
                        "use {}",
                        what, lies, instead));
    }
}

/// Throws InputError if flights in a medium are too short for numbers as coarse as positions on the body.
void expect_flights(const Medium& medium, float radius, float step_off) {
    constexpr float least_steps = 20.0f;
    if (medium.most_scattering() * least_steps * step_off > 1.0f)
        throw InputError(fmt::format(
            "light of a translucent body is scattered every {:.3g} mm, which is too often for a body of "
            "{:.3g} "
            "mm across: at least {:.3g} mm are needed between two scatterings; take less `scattering_per_mm` "
            "or `density`, or a plastic, which gives light back where it comes in",
            1.0f / medium.most_scattering(), 2.0f * radius, least_steps * step_off));
}

/// A translucent body's border is that of glass without dispersion.
MaterialSettings border_of(MaterialSettings material) {
    material.abbe.reset();
    return material;
}

CoatShape coat_shape(const MaterialSettings& material, double half_height) {
    return {material.coat_thickness * half_height, material.coat_bump * half_height,
            material.coat_bump_width * half_height, static_cast<std::uint64_t>(material.coat_seed)};
}

/// Of a mesh that says nothing of its surface.
std::shared_ptr<const SurfaceAppearance> of_one_colour(const MaterialSettings& material) {
    SurfaceAppearance appearance;
    FileMaterial& only = appearance.materials.emplace_back();
    only.colour = glm::vec3(material.given_reflectance());
    return std::make_shared<const SurfaceAppearance>(std::move(appearance));
}

} // namespace

BakeScene::BakeScene(const Mesh& mesh, const MaterialSettings& material,
                     std::shared_ptr<const SurfaceAppearance> appearance)
    : material_(material), model_(&model_of(material)), centre_(mesh.bounds().centre()) {
    if (mesh.triangles.empty())
        throw InputError("a mesh without triangles cannot be baked");
    const double half_height = 0.5 * mesh.bounds().extent().z;
    radius_ = static_cast<float>(0.5 * mesh.bounds().diagonal());
    const EdgeCounts edges = count_edges(mesh.triangles, mesh.positions.size());
    const double volume = signed_volume(mesh);
    is_closed_ =
        volume > 0.0 && static_cast<double>(edges.boundary + edges.non_manifold + edges.conflicting) <=
                            open_share * static_cast<double>(edges.edges);
    body_surface_ = std::make_unique<TracedSurface>(mesh, centre_, lit_crease_deg);
    std::vector<const TracedSurface*> surfaces{body_surface_.get()};
    const MaterialKindRow& row = row_of(material.kind);
    if (row.has_key("reflectance"))
        reflectance_ =
            Bins::of(reflectance_of({material.given_reflectance().x, material.given_reflectance().y,
                                     material.given_reflectance().z}));
    if (has_coat())
        expect_body(edges, volume, "a coat", "outside", "a material without a coat");
    if (material.kind == MaterialKind::glass) {
        expect_body(edges, volume, "glass", "inside", "a material that lets no light through");
        absorbance_ = Bins::of(absorbance_of(material.absorbance));
        scale(absorbance_, static_cast<float>(1.0 / half_height));
        glass_ = std::make_unique<Glass>(material_);
    }
    if (material.kind == MaterialKind::translucent) {
        expect_body(edges, volume, "a translucent body", "inside", "a material that lets no light through");
        medium_ = std::make_unique<Medium>(material_);
        expect_flights(*medium_, radius_, step_off());
        absorbance_ = medium_->absorption();
        glass_ = std::make_unique<Glass>(border_of(material_));
    }
    if (row.has_key("metal"))
        metal_ = metal_table(material);
    if (has_coat()) {
        const CoatShape shape = coat_shape(material, half_height);
        absorbance_ = Bins::of(absorbance_of(material.coat_absorbance));
        scale(absorbance_, static_cast<float>(1.0 / shape.thickness));
        const Mesh outside = coat_over(mesh, shape);
        coat_surface_ = std::make_unique<TracedSurface>(outside, centre_, 180.0);
        for (const glm::vec3& position : coat_surface_->positions)
            radius_ = std::max(radius_, glm::length(position));
        coat_body_ = std::make_unique<SurfaceTree>(surfaces);
        surfaces.push_back(coat_surface_.get());
    }
    tree_ = std::make_unique<SurfaceTree>(std::move(surfaces));
    if (model_->layers)
        layers_ = std::make_unique<LayeredSurface>(model_->layers(material_, reflectance_, metal_));
    if (material_.has_own_bumps() && appearance && has_bumps(*appearance))
        bumps_ = std::make_unique<Bumps>(appearance, mesh, body_surface_->normals);
    if (material_.is_own())
        own_ = std::make_unique<OwnSurface>(appearance ? std::move(appearance) : of_one_colour(material_),
                                            material_);
}

BakeScene::~BakeScene() = default;
BakeScene::BakeScene(BakeScene&&) noexcept = default;
BakeScene& BakeScene::operator=(BakeScene&&) noexcept = default;

} // namespace overt
