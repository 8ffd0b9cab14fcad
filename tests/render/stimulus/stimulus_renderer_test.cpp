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
            continue; // drawn as one of the others, of the mean of its surface (on_average)
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
