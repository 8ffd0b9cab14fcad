#include "render/bake/bake_scene.h"

#include <fmt/format.h>

#include "experiment/error.h"
#include "experiment/scene/mesh_topology.h"
#include "experiment/scene/metal_table.h"
#include "render/bake/light_colour.h"

namespace overt {

BakeScene::BakeScene(const Mesh& mesh, const MaterialSettings& material, double crease_deg)
    : material_(material), centre_(mesh.bounds().centre()) {
    if (mesh.triangles.empty())
        throw InputError("a mesh without triangles cannot be baked");
    radius_ = static_cast<float>(0.5 * mesh.bounds().diagonal());
    is_closed_ =
        count_edges(mesh.triangles, mesh.positions.size()).bounds_volume() && signed_volume(mesh) > 0.0;
    if (material.kind == MaterialKind::diffuse)
        reflectance_ = Bins::of(reflectance_of(material.reflectance));
    else
        metal_ = ConductorTable(load_metal(material.metal), 1.0);
    body_surface_ = std::make_unique<TracedSurface>(mesh, centre_, crease_deg);
    tree_ = std::make_unique<SurfaceTree>(std::vector<const TracedSurface*>{body_surface_.get()});
}

BakeScene::~BakeScene() = default;
BakeScene::BakeScene(BakeScene&&) noexcept = default;
BakeScene& BakeScene::operator=(BakeScene&&) noexcept = default;

} // namespace overt
