#include "app/bench/painted_look.h"

namespace overt {

std::shared_ptr<const SurfaceAppearance> painted_look(const Mesh& mesh) {
    SurfaceAppearance look;
    constexpr int side = 512;
    for (int kind = 0; kind < 3; ++kind) {
        SurfacePicture picture;
        picture.size_px = {side, side};
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const int code = (x * 37 + y * 91) % 64;
                picture.texels.push_back(
                    kind == 2 ? glm::u8vec4(112 + code / 2, 112 + (code * 7) % 32, 250, 255)
                              : glm::u8vec4(60 + code, 90 + code, kind == 1 ? 3 * code : 70, 255));
            }
        look.pictures.push_back(std::make_shared<const SurfacePicture>(std::move(picture)));
    }
    FileMaterial material;
    material.metallic = material.roughness = 1.0f;
    material.colour_picture.picture = 0;
    material.surface_picture.picture = 1;
    material.normal_picture.picture = 2;
    look.materials.push_back(material);
    const Bounds bounds = mesh.bounds();
    const auto place = [&](std::uint32_t vertex) {
        const glm::dvec3 at = (glm::dvec3(mesh.positions[vertex]) - bounds.min) / bounds.extent();
        return glm::vec2(static_cast<float>(at.x + 0.3 * at.y), static_cast<float>(at.z));
    };
    for (const glm::uvec3& triangle : mesh.triangles)
        look.uvs[0].push_back({place(triangle.x), place(triangle.y), place(triangle.z)});
    return std::make_shared<const SurfaceAppearance>(std::move(look));
}

} // namespace overt
