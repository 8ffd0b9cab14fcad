#include <catch2/catch.hpp>

#include "render/bake/bumps.h"
#include "tests/render/bake/bake_support.h"

using namespace overt;

namespace {

/// A square of 20 mm that faces the camera, with a picture of normals on it, one texel: u to the right and v
/// down, as glTF has places, unless it lies otherwise.
struct BumpyPlate {
    Mesh mesh;
    std::shared_ptr<SurfaceAppearance> look = std::make_shared<SurfaceAppearance>();

    explicit BumpyPlate(glm::u8vec4 texel, glm::vec2 right = {1, 0}, glm::vec2 down = {0, 1}) {
        auto picture = std::make_shared<SurfacePicture>();
        picture->size_px = {1, 1};
        picture->texels = {texel};
        look->pictures.push_back(picture);
        FileMaterial& only = look->materials.emplace_back();
        only.name = "glaze";
        only.metallic = 1.0f;
        only.roughness = 0.4f;
        only.normal_picture.picture = 0;
        mesh.positions = {{-10, 0, 10}, {-10, 0, -10}, {10, 0, -10}, {10, 0, 10}};
        mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
        mesh.triangle_parts.assign(2, PartIndex{0});
        mesh.part_names = {"body"};
        const std::array<glm::vec2, 4> uv{glm::vec2(0.0f), down, right + down, right};
        look->uvs[0] = {{uv[0], uv[1], uv[2]}, {uv[0], uv[2], uv[3]}};
    }

    glm::vec3 normal() const {
        const std::vector<CornerNormals> normals = corner_normals(mesh, 50.0);
        const Bumps bumps(look, mesh, normals);
        SurfaceHit hit;
        hit.triangle = 1;
        hit.place = {0.3f, 0.2f};
        hit.shading_normal = normals[1][0];
        return bumps.normal_at(hit);
    }
};

/// Right, up and towards the camera.
glm::vec3 seen(glm::vec3 normal) { return {normal.x, normal.z, -normal.y}; }

LinearImage picture_of(const Mesh& mesh, const MaterialSettings& material,
                       std::shared_ptr<const SurfaceAppearance> look, int samples = 16) {
    LightSettings gallery;
    gallery.probe = "gallery";
    const BakeScene scene(mesh, material, std::move(look));
    return to_rec709(
        test::baked(scene, SpectralLight(gallery), test::front_view(mesh, 24), {.samples = samples}));
}

} // namespace

TEST_CASE("a normal that a picture has comes back where the picture lies, turned and mirrored with it",
          "[unit]") {
    // Codes of a normal that leans by some 37 degrees to the right: 2 c / 255 - 1.
    const glm::u8vec4 to_the_right(204, 128, 230, 255), upwards(128, 204, 230, 255);
    const glm::vec3 leans = glm::normalize(glm::vec3(0.6f, 0.0f, 0.8039f)),
                    rises = glm::normalize(glm::vec3(0.0f, 0.6f, 0.8039f));
    const auto is = [](glm::vec3 a, glm::vec3 b) { return glm::length(a - b) < 1e-3f; };
    CHECK(is(seen(BumpyPlate(to_the_right).normal()), leans));
    CHECK(is(seen(BumpyPlate(upwards).normal()), rises));
    // A picture that lies mirrored, left for right: its own right is the surface's left; its up stays.
    CHECK(is(seen(BumpyPlate(to_the_right, {-1, 0}).normal()), {-leans.x, 0.0f, leans.z}));
    CHECK(is(seen(BumpyPlate(upwards, {-1, 0}).normal()), rises));
    // Upside down.
    CHECK(is(seen(BumpyPlate(upwards, {1, 0}, {0, -1}).normal()), {0.0f, -rises.y, rises.z}));
    // Its u runs down, so that its right is the surface's below.
    CHECK(is(seen(BumpyPlate(to_the_right, {0, -1}, {1, 0}).normal()), {0.0f, -leans.x, leans.z}));
    // By KHR_texture_transform, too: u' = v, v' = -u is a turn by a quarter; scales alone change nothing.
    BumpyPlate turned(to_the_right);
    turned.look->materials[0].normal_picture.turn_rad = 0.5 * 3.14159265358979;
    CHECK(is(seen(turned.normal()), {0.0f, -leans.x, leans.z}));
    BumpyPlate scaled(to_the_right);
    scaled.look->materials[0].normal_picture.scale = {3.0, 0.5};
    CHECK(is(seen(scaled.normal()), leans));
    // Its scale is on the slope alone.
    BumpyPlate half(to_the_right);
    half.look->materials[0].normal_scale = 0.5f;
    CHECK(is(seen(half.normal()), glm::normalize(glm::vec3(0.3f, 0.0f, 0.8039f))));
}

TEST_CASE("a flat picture of normals, and one that is not asked for, change no bit of a frame", "[unit]") {
    MaterialSettings own;
    own.kind = MaterialKind::own;
    MaterialSettings smooth = own;
    smooth.bumps = MaterialBumps::none;
    const BumpyPlate flat({128, 127, 255, 255}), bumpy({170, 128, 230, 255});
    const std::vector<glm::vec4> without = picture_of(flat.mesh, smooth, flat.look).pixels;
    CHECK(picture_of(flat.mesh, own, flat.look).pixels == without);
    CHECK(picture_of(bumpy.mesh, smooth, bumpy.look).pixels == without);
    CHECK(picture_of(bumpy.mesh, own, bumpy.look).pixels != without);
    // A metal of the protocol's takes the bumps where it is told to.
    MaterialSettings gold = test::material_of(MaterialKind::smooth_conductor);
    const std::vector<glm::vec4> polished = picture_of(bumpy.mesh, gold, bumpy.look).pixels;
    gold.bumps = MaterialBumps::own;
    CHECK(picture_of(flat.mesh, gold, flat.look).pixels == polished);
    CHECK(picture_of(bumpy.mesh, gold, bumpy.look).pixels != polished);
}

TEST_CASE("a mirror with a leaning normal shows what lies where that sends the sight line", "[unit]") {
    const BumpyPlate plate({204, 128, 230, 255});
    LightProbe probe = test::even_light(glm::vec3(0.0f));
    probe.radiance = LinearImage({256, 128});
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 256; ++x)
            probe.radiance.at(x, y) = glm::vec4(static_cast<float>(x) / 256.0f, 0.0f, 0.0f, 1.0f);
    MaterialSettings mirror;
    const test::WhiteMetal white;
    mirror = test::material_of(MaterialKind::smooth_conductor, white.file());
    mirror.bumps = MaterialBumps::own;
    const BakeScene scene(plate.mesh, mirror, plate.look);
    const LinearImage picture = to_rec709(
        test::baked(scene, SpectralLight(probe, 1.0), test::front_view(plate.mesh, 25), {.samples = 4}));
    // The sight line of the middle runs along +y; the normal leans by 36.7 degrees from -y to +x, and what is
    // mirrored by twice that.
    const double lean = std::atan2(0.6, 0.8039);
    const double azimuth = std::atan2(std::sin(2.0 * lean), -std::cos(2.0 * lean)) / (2.0 * 3.14159265) + 0.5;
    CHECK(static_cast<double>(picture.at(12, 12).r) == Approx(azimuth - 0.5 / 256).margin(0.003));
}

TEST_CASE("bumps make no light and lose little", "[unit]") {
    const Mesh ball = test::ball({0.0, 0.0, 0.0}, 50.0);
    BumpyPlate plate({170, 90, 230, 255});
    auto look = std::make_shared<SurfaceAppearance>(*plate.look);
    look->uvs[0].clear();
    for (const glm::uvec3 triangle : ball.triangles) {
        CornerUvs& uvs = look->uvs[0].emplace_back();
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3 place = ball.positions[triangle[corner]];
            uvs[static_cast<std::size_t>(corner)] = {0.01f * place.x, -0.01f * place.z};
        }
    }
    MaterialSettings white;
    white.kind = MaterialKind::own;
    white.reflectance = glm::dvec3(1.0);
    for (const double metallic : {0.0, 1.0}) {
        white.metallic = metallic;
        const BakeScene scene(ball, white, look);
        const LinearImage lit = to_rec709(test::baked(scene, SpectralLight(test::even_light(), 1.0),
                                                      test::front_view(ball, 32), {.samples = 64}));
        double light = 0.0, covered = 0.0;
        for (const glm::vec4& pixel : lit.pixels) {
            light += static_cast<double>(pixel.g);
            covered += static_cast<double>(pixel.a);
        }
        CAPTURE(metallic);
        CHECK(light / covered < 1.002);
        CHECK(light / covered > 0.95);
    }
}
