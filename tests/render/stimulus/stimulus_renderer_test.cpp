/// Live frames: every kind of material, drawn by OpenGL.
#include "render/stimulus/stimulus_renderer.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "render/gl/headless_context.h"
#include "tests/support/figures.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

namespace {

SceneView front_of(const Mesh& mesh) {
    SceneView scene;
    scene.bounds = mesh.bounds();
    scene.view.image_px = {64, 64};
    scene.view.camera = fit_camera(mesh, {12.0}, scene.view.image_px, {25.0}, 0.06);
    return scene;
}

MaterialSettings gold_of(MaterialKind kind) {
    MaterialSettings material;
    material.kind = kind;
    return material;
}

} // namespace

TEST_CASE("live frames of every kind of material have light, and no two kinds the same", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    const Mesh mesh = test::bust();
    const SceneView scene = front_of(mesh);
    const MeshBuffers buffers(*context, mesh, openness_of_vertices(mesh));
    StimulusRenderer renderer(*context, {}, scene.view.image_px);
    std::vector<LinearImage> pictures;
    for (const MaterialKindRow& row : material_kinds) {
        CAPTURE(row.name);
        if (row.kind == MaterialKind::own)
            continue; // drawn as one of the others, piece by piece (PaintedSurface)
        renderer.set_material(gold_of(row.kind));
        const LinearImage picture = renderer.draw(buffers, scene, Pose{});
        int lit = 0;
        for (const glm::vec4& pixel : picture.pixels) {
            REQUIRE(std::isfinite(pixel.r + pixel.g + pixel.b));
            REQUIRE(glm::min(pixel.r, glm::min(pixel.g, pixel.b)) >= 0.0f);
            lit += pixel.a > 0.0f && pixel.r > 0.0f;
        }
        CHECK(lit > 300);
        for (const LinearImage& other : pictures)
            CHECK(picture.pixels != other.pixels);
        pictures.push_back(picture);
    }
}

TEST_CASE("the table of a metal is read when the material is set, not for each frame", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    const Mesh mesh = test::bust();
    const SceneView scene = front_of(mesh);
    const MeshBuffers buffers(*context, mesh, openness_of_vertices(mesh));
    StimulusRenderer renderer(*context, {}, scene.view.image_px);
    const test::TemporaryFolder folder;
    MaterialSettings material = gold_of(MaterialKind::smooth_conductor);
    material.metal = (folder.path() / "metal.csv").string();
    std::ofstream(material.metal) << "wavelength_nm,n,k\n300,0,1\n800,0,1\n";
    renderer.set_material(material);
    const LinearImage before = renderer.draw(buffers, scene, Pose{});
    std::filesystem::remove(material.metal);
    CHECK(renderer.draw(buffers, scene, Pose{}).pixels == before.pixels);
    CHECK_THROWS_AS(renderer.set_material(material), InputError);
}

namespace {

/// The light of a surface that is painted so, in the middle of the picture's left and right halves.
struct PaintedPicture {
    LinearImage image;
    glm::vec3 left() const { return glm::vec3(image.at(22, 40)); }
    glm::vec3 right() const { return glm::vec3(image.at(42, 40)); }
};

PaintedPicture painted(const GlContext& context, const Mesh& mesh, const SurfaceAppearance& appearance,
                       const MaterialSettings& material) {
    const SceneView scene = front_of(mesh);
    const MeshBuffers buffers(context, mesh, openness_of_vertices(mesh));
    StimulusRenderer renderer(context, {}, scene.view.image_px);
    const PaintedSurface surface(context, mesh, buffers, appearance, material);
    renderer.set_painted(surface);
    return {renderer.draw(buffers, scene, Pose{})};
}

MaterialSettings own_as(MaterialKind kind) {
    MaterialSettings material;
    material.kind = kind;
    material.base = MaterialBase::own;
    return material;
}

} // namespace

TEST_CASE("a surface that is painted in one colour looks like the material of that colour", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    const Mesh mesh = test::bust();
    const SceneView scene = front_of(mesh);
    const MeshBuffers buffers(*context, mesh, openness_of_vertices(mesh));
    StimulusRenderer renderer(*context, {}, scene.view.image_px);
    FileMaterial paint;
    paint.colour = {0.3f, 0.5f, 0.7f};
    paint.metallic = 0.4f;
    paint.roughness = 0.5f;
    SurfaceAppearance appearance;
    appearance.materials = {paint};
    for (const MaterialKind kind : {MaterialKind::diffuse, MaterialKind::plastic, MaterialKind::own}) {
        CAPTURE(name_of(kind));
        MaterialSettings plain = own_as(kind);
        plain.base = MaterialBase::given;
        plain.reflectance = glm::dvec3(0.3, 0.5, 0.7);
        if (kind == MaterialKind::own) {
            plain.kind = MaterialKind::metallic_roughness;
            plain.metallic = 0.4;
            plain.roughness = 0.5;
        }
        renderer.set_material(plain);
        const LinearImage wanted = renderer.draw(buffers, scene, Pose{});
        const LinearImage found = painted(*context, mesh, appearance, own_as(kind)).image;
        for (std::size_t i = 0; i < wanted.pixels.size(); ++i)
            for (int channel = 0; channel < 4; ++channel)
                REQUIRE(found.pixels[i][channel] == Approx(wanted.pixels[i][channel]).margin(2e-3));
    }
}

TEST_CASE("colours of materials, of corners and of pictures stand where the file has them", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    const Mesh mesh = test::bust();
    const auto is_left = [&](std::size_t t) {
        const glm::uvec3& of = mesh.triangles[t];
        return mesh.positions[of.x].x + mesh.positions[of.y].x + mesh.positions[of.z].x < 0.0f;
    };
    const glm::vec3 red(0.8f, 0.1f, 0.1f), green(0.1f, 0.8f, 0.1f);
    // On a box of the bust a triangle may reach from one side to the other: its corners tell.
    FileMaterial white;
    SurfaceAppearance by_corners;
    by_corners.materials = {white};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        CornerColours& corners = by_corners.colours.emplace_back();
        for (int corner = 0; corner < 3; ++corner)
            corners[static_cast<std::size_t>(corner)] =
                mesh.positions[mesh.triangles[t][corner]].x < 0.0f ? red : green;
    }
    SurfaceAppearance by_materials;
    by_materials.materials = {white, white, white};
    by_materials.materials[0].colour = red;
    by_materials.materials[2].colour = green; // the one between has no triangles
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        by_materials.triangle_materials.push_back(is_left(t) ? 0 : 2);
    // A picture of two texels, as wide as the bust: u = 0.5 in the middle. Moved by one width and mirrored it
    // is the other way round; a factor dims it.
    auto texels = std::make_shared<SurfacePicture>();
    texels->size_px = {2, 1};
    texels->texels = {{231, 89, 89, 255}, {89, 231, 89, 255}};
    SurfaceAppearance by_picture;
    by_picture.pictures = {texels};
    by_picture.materials = {white};
    by_picture.materials[0].colour_picture.picture = 0;
    by_picture.materials[0].colour_picture.is_nearest = true;
    for (const glm::uvec3& of : mesh.triangles) {
        CornerUvs& corners = by_picture.uvs[0].emplace_back();
        for (int corner = 0; corner < 3; ++corner)
            corners[static_cast<std::size_t>(corner)] = {mesh.positions[of[corner]].x / 200.0f + 0.5f, 0.5f};
    }
    SurfaceAppearance mirrored = by_picture;
    mirrored.materials[0].colour_picture.offset = {1.0, 0.0};
    mirrored.materials[0].colour_picture.across = PictureEdge::mirror;
    SurfaceAppearance dimmed = by_picture;
    dimmed.materials[0].colour = glm::vec3(0.5f);

    const auto draw = [&](const SurfaceAppearance& look) {
        return painted(*context, mesh, look, own_as(MaterialKind::diffuse));
    };
    const PaintedPicture plain = draw(by_picture);
    for (const PaintedPicture& picture : {draw(by_corners), draw(by_materials), plain}) {
        CHECK(picture.left().r > 2.0f * picture.left().g);
        CHECK(picture.right().g > 2.0f * picture.right().r);
        CHECK(picture.left().b < 0.5f * picture.left().r);
    }
    const PaintedPicture other = draw(mirrored);
    CHECK(other.left().g > 2.0f * other.left().r);
    CHECK(other.right().r > 2.0f * other.right().g);
    // Light goes to and fro in folds, so that half the reflectance gives a little less than half the light.
    CHECK(draw(dimmed).left().r < 0.52f * plain.left().r);
    CHECK(draw(dimmed).left().r > 0.35f * plain.left().r);
    // Codes are of sRGB: 231 is 0.799 of the light, 89 is 0.100.
    CHECK(plain.left().g / plain.left().r == Approx(0.125).margin(0.05));
}

TEST_CASE("what a picture says to be metal mirrors as metal does, and the rest as plastic does", "[gl]") {
    const auto context = make_headless_context(ContextKind::osmesa);
    const Mesh mesh = test::bust();
    const auto texels = [](std::uint8_t left, std::uint8_t right) {
        auto picture = std::make_shared<SurfacePicture>();
        picture->size_px = {2, 1};
        picture->texels = {{0, 255, left, 255}, {0, 255, right, 255}};
        return picture;
    };
    SurfaceAppearance look;
    FileMaterial paint;
    paint.colour = {0.8f, 0.6f, 0.2f};
    paint.metallic = 1.0f;
    paint.roughness = 0.4f;
    paint.surface_picture.picture = 0;
    paint.surface_picture.is_nearest = true;
    look.materials = {paint};
    for (const glm::uvec3& of : mesh.triangles) {
        CornerUvs& corners = look.uvs[0].emplace_back();
        for (int corner = 0; corner < 3; ++corner)
            corners[static_cast<std::size_t>(corner)] = {mesh.positions[of[corner]].x / 200.0f + 0.5f, 0.5f};
    }
    const auto draw = [&](std::uint8_t left, std::uint8_t right, float factor) {
        look.pictures = {texels(left, right)};
        look.materials[0].metallic = factor;
        return painted(*context, mesh, look, gold_of(MaterialKind::own));
    };
    const PaintedPicture metal = draw(255, 255, 1.0f), plastic = draw(0, 0, 1.0f), both = draw(255, 0, 1.0f),
                         dimmed = draw(255, 255, 0.0f);
    for (int channel = 0; channel < 3; ++channel) {
        CHECK(both.left()[channel] == Approx(metal.left()[channel]).margin(1e-4));
        CHECK(both.right()[channel] == Approx(plastic.right()[channel]).margin(1e-4));
        CHECK(dimmed.left()[channel] == Approx(plastic.left()[channel]).margin(1e-4));
    }
    CHECK(std::abs(metal.left().b - plastic.left().b) > 0.01f);
}
