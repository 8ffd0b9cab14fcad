#include "render/stimulus/painted_surface.h"

#include "experiment/base/error.h"
#include "render/bake/own_surface.h"

namespace overt {

namespace {

GLint edge_of(PictureEdge edge) {
    switch (edge) {
    case PictureEdge::repeat:
        return GL_REPEAT;
    case PictureEdge::clamp:
        return GL_CLAMP_TO_EDGE;
    case PictureEdge::mirror:
        return GL_MIRRORED_REPEAT;
    }
    return GL_REPEAT;
}

/// Nothing for a picture that is larger than the card takes: then the mean colour stands for it.
std::optional<Texture2D> picture_of(const GlContext& context, const SurfaceAppearance& appearance,
                                    const SurfacePlacement& placement, PixelFormat format) {
    const SurfacePicture& picture = *appearance.pictures[static_cast<std::size_t>(placement.picture)];
    GLint most = 0;
    context.gl().GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (picture.size_px.x > most || picture.size_px.y > most)
        return std::nullopt;
    Texture2D texture(context, picture.size_px, format);
    texture.upload(std::as_bytes(std::span(picture.texels)));
    texture.set_as_picture(edge_of(placement.across), edge_of(placement.down), placement.is_nearest);
    return texture;
}

/// Corners one after another.
struct Corners {
    std::vector<glm::vec3> positions, normals, colours;
    std::vector<glm::vec4> openness;
    std::vector<glm::vec2> places, places_of_metal;
};

} // namespace

PaintedSurface::PaintedSurface(const GlContext& context, const Mesh& mesh, const MeshBuffers& buffers,
                               const SurfaceAppearance& appearance, const MaterialSettings& material)
    : context_(&context), array_(context) {
    OVERT_EXPECTS(buffers.openness().size() == mesh.positions.size());
    const std::vector<glm::vec3> normals = mesh.vertex_normals();
    const std::vector<std::optional<MaterialSettings>> means = each_on_average(material, appearance, mesh);
    const std::vector<bool> given = given_materials(material, appearance);
    Corners corners;
    for (std::size_t of = 0; of < means.size(); ++of) {
        if (!means[of])
            continue;
        const FileMaterial own = appearance.materials.empty() ? FileMaterial() : appearance.materials[of];
        const bool is_given = material.kind == MaterialKind::own && given[of] && material.reflectance;
        Piece piece{*means[of], static_cast<GLint>(corners.positions.size()), 0, {}, {}};
        if (!is_given && own.colour_picture.picture >= 0)
            piece.picture = picture_of(context, appearance, own.colour_picture, PixelFormat::srgba8);
        const bool is_metal_given = material.kind != MaterialKind::own || (given[of] && material.metallic);
        if (!is_metal_given && own.surface_picture.picture >= 0)
            piece.metal = picture_of(context, appearance, own.surface_picture, PixelFormat::rgba8);
        piece.metallic = own.metallic;
        const bool is_mean = is_given || (own.colour_picture.picture >= 0 && !piece.picture);
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            if ((appearance.triangle_materials.empty() ? 0u : appearance.triangle_materials[t]) != of)
                continue;
            for (int corner = 0; corner < 3; ++corner) {
                const std::uint32_t v = mesh.triangles[t][corner];
                const auto c = static_cast<std::size_t>(corner);
                corners.positions.emplace_back(glm::dvec3(mesh.positions[v]) - buffers.centre());
                corners.normals.push_back(normals[v]);
                corners.openness.push_back(buffers.openness()[v]);
                glm::vec3 colour = is_mean ? glm::vec3(*piece.material.reflectance) : own.colour;
                if (!is_mean && !appearance.colours.empty())
                    colour *= appearance.colours[t][c];
                corners.colours.push_back(colour);
                const auto place_on = [&](const SurfacePlacement& picture) {
                    const auto set = static_cast<std::size_t>(picture.uv_set);
                    return glm::vec2(picture.place_of(glm::dvec2(appearance.uvs[set][t][c])));
                };
                corners.places.push_back(piece.picture ? place_on(own.colour_picture) : glm::vec2(0.0f));
                corners.places_of_metal.push_back(piece.metal ? place_on(own.surface_picture)
                                                              : glm::vec2(0.0f));
            }
        }
        piece.count = static_cast<GLsizei>(corners.positions.size()) - piece.first;
        pieces_.push_back(std::move(piece));
    }
    const GladGLContext& gl = context.gl();
    array_.bind();
    const auto attribute = [&](GLuint index, GLint components, std::span<const std::byte> bytes) {
        buffers_.emplace_back(context, GL_ARRAY_BUFFER, bytes, GL_STATIC_DRAW);
        gl.EnableVertexAttribArray(index);
        gl.VertexAttribPointer(index, components, GL_FLOAT, GL_FALSE, 0, nullptr);
    };
    attribute(0, 3, std::as_bytes(std::span(corners.positions)));
    attribute(1, 3, std::as_bytes(std::span(corners.normals)));
    attribute(2, 4, std::as_bytes(std::span(corners.openness)));
    attribute(3, 2, std::as_bytes(std::span(corners.places)));
    attribute(4, 3, std::as_bytes(std::span(corners.colours)));
    attribute(5, 2, std::as_bytes(std::span(corners.places_of_metal)));
}

void PaintedSurface::draw(const Piece& piece) const {
    array_.bind();
    context_->gl().DrawArrays(GL_TRIANGLES, piece.first, piece.count);
}

} // namespace overt
