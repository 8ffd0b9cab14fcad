#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "render/bake/own_surface.h"
#include "tests/render/bake/bake_support.h"

using namespace overt;

namespace {

std::shared_ptr<SurfaceAppearance> of_one_look(glm::vec3 colour, float metallic, float roughness) {
    auto look = std::make_shared<SurfaceAppearance>();
    FileMaterial& only = look->materials.emplace_back();
    only.colour = colour;
    only.metallic = metallic;
    only.roughness = roughness;
    return look;
}

glm::vec3 direction_above(RandomStream& random) {
    const double z = random.uniform(0.05, 1.0), azimuth = random.uniform(0.0, 6.28),
                 s = std::sqrt(1.0 - z * z);
    return {static_cast<float>(s * std::cos(azimuth)), static_cast<float>(s * std::sin(azimuth)),
            static_cast<float>(z)};
}

/// Largest difference between two surfaces' light over pairs of directions, as a share of the larger.
double difference_of(const OwnSurface& own, const LayeredSurface& layered) {
    RandomStream random(3, "pairs");
    const OwnPoint point = own.point(0, {0.3f, 0.3f});
    double largest = 0.0;
    for (int pair = 0; pair < 300; ++pair) {
        const glm::vec3 up(0.0f, 0.0f, 1.0f), eye = direction_above(random), light = direction_above(random);
        const SurfaceEvent event{eye, up, &point};
        const Bins a = own.value(event, light), b = layered.value({eye, up}, light);
        for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
            const auto x = static_cast<double>(a.value[bin]), y = static_cast<double>(b.value[bin]);
            largest = std::max(largest, std::abs(x - y) / std::max({x, y, 1e-9}));
        }
    }
    return largest;
}

/// A plate in the plane of the picture, of squares, each of two triangles and of a colour of its own.
struct Plate {
    static constexpr int side = 6;
    Mesh mesh;
    std::shared_ptr<SurfaceAppearance> look = std::make_shared<SurfaceAppearance>();
    std::vector<glm::u8vec3> texels;

    Plate() {
        RandomStream random(11, "plate");
        auto picture = std::make_shared<SurfacePicture>();
        picture->size_px = {side, side};
        for (int i = 0; i < side * side; ++i) {
            texels.emplace_back(60 + random.below(150), 60 + random.below(150), 60 + random.below(150));
            picture->texels.emplace_back(texels.back(), 255);
        }
        look->pictures.push_back(picture);
        FileMaterial& paint = look->materials.emplace_back();
        paint.colour_picture.picture = 0;
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                const auto first = static_cast<std::uint32_t>(mesh.positions.size());
                const auto x = static_cast<float>(10 * column), z = static_cast<float>(-10 * row);
                for (const glm::vec3 corner :
                     {glm::vec3(x, 0, z), {x, 0, z - 10}, {x + 10, 0, z - 10}, {x + 10, 0, z}})
                    mesh.positions.push_back(corner);
                const glm::vec2 uv = (glm::vec2(column, row) + 0.5f) / static_cast<float>(side);
                for (const glm::uvec3 triangle : {glm::uvec3(0, 1, 2), {0, 2, 3}}) {
                    mesh.triangles.push_back(triangle + first);
                    look->uvs[0].push_back({uv, uv, uv});
                }
            }
        mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
        mesh.part_names = {"body"};
    }
};

} // namespace

TEST_CASE("a surface of one look is what the kind of the same numbers is", "[unit]") {
    for (const float metallic : {0.0f, 0.4f, 1.0f})
        for (const float roughness : {0.25f, 0.5f, 1.0f}) {
            CAPTURE(metallic, roughness);
            MaterialSettings own, given;
            own.kind = MaterialKind::own;
            given.kind = MaterialKind::metallic_roughness;
            given.metallic = static_cast<double>(metallic);
            given.roughness = static_cast<double>(roughness);
            const glm::vec3 colour(0.5f, 0.3f, 0.2f);
            const Bins bins = Bins::of(reflectance_of({0.5, 0.3, 0.2}));
            CHECK(difference_of(OwnSurface(of_one_look(colour, metallic, roughness), own),
                                metallic_roughness_surface(given, bins)) < 2e-3);
        }
    // What base = own takes from the file is the colour alone.
    for (const PlasticBody body : {PlasticBody::light, PlasticBody::pigment}) {
        MaterialSettings plastic;
        plastic.kind = MaterialKind::plastic;
        plastic.roughness = 0.2;
        plastic.ior = 1.4;
        plastic.body = body;
        const LayeredSurface given = plastic_surface(plastic, Bins::of(reflectance_of({0.5, 0.3, 0.2})));
        plastic.base = MaterialBase::own;
        CHECK(difference_of(OwnSurface(of_one_look({0.5f, 0.3f, 0.2f}, 1.0f, 0.9f), plastic), given) < 2e-3);
    }
    MaterialSettings coated;
    coated.kind = MaterialKind::metallic_roughness;
    coated.metallic = 0.5;
    coated.roughness = 0.5;
    coated.clear_coat = 0.7;
    coated.clear_coat_roughness = 0.3;
    const LayeredSurface given =
        metallic_roughness_surface(coated, Bins::of(reflectance_of({0.5, 0.3, 0.2})));
    coated.base = MaterialBase::own;
    CHECK(difference_of(OwnSurface(of_one_look({0.5f, 0.3f, 0.2f}, 0.0f, 0.9f), coated), given) < 2e-3);
}

TEST_CASE("what is given in place of the file's word holds for the materials that are named, and no others",
          "[unit]") {
    auto look = of_one_look({0.5f, 0.3f, 0.2f}, 0.3f, 0.90625f);
    look->materials[0].name = "glaze";
    look->materials.push_back(look->materials[0]);
    look->materials[1].name = "foot";
    look->triangle_materials = {0, 1};
    MaterialSettings own, expected;
    own.kind = MaterialKind::own;
    own.roughness = 0.237; // none of the steps
    expected.kind = MaterialKind::metallic_roughness;
    expected.roughness = 0.237;
    expected.metallic = 0.3;
    const Bins brown = Bins::of(reflectance_of({0.5, 0.3, 0.2})),
               blue = Bins::of(reflectance_of({0.1, 0.2, 0.6}));
    CHECK(difference_of(OwnSurface(look, own), metallic_roughness_surface(expected, brown)) < 2e-3);
    own.metallic = 0.8;
    own.reflectance = glm::dvec3(0.1, 0.2, 0.6);
    expected.metallic = 0.8;
    const LayeredSurface given = metallic_roughness_surface(expected, blue);
    CHECK(difference_of(OwnSurface(look, own), given) < 2e-3);
    expected.metallic = 0.3;
    expected.roughness = 0.90625; // a step of those that pictures are taken in
    own.of = {"foot"};
    const OwnSurface foot(look, own);
    CHECK(difference_of(foot, metallic_roughness_surface(expected, brown)) <
          0.02); // steps of a thirty-second
    CHECK(foot.point(1, {0.2f, 0.2f}).metallic == 0.8f);
    CHECK(foot.point(0, {0.2f, 0.2f}).metallic == 0.3f);
    CHECK(foot.point(1, {0.2f, 0.2f}).level != foot.point(0, {0.2f, 0.2f}).level);
    // Live frames have the mean of what is shown.
    Mesh two;
    two.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {2, 0, 0}};
    two.triangles = {{0, 1, 2}, {1, 3, 2}};
    const MaterialSettings mean = on_average(own, *look, two);
    CHECK(mean.given_metallic() == Approx(0.55));
    CHECK(mean.given_roughness() == Approx(0.5 * (0.90625 + 0.237)));
    CHECK(mean.given_reflectance().z == Approx(0.4));
    // A varnish over what the file says.
    own = {};
    own.kind = MaterialKind::own;
    own.clear_coat = 0.7;
    own.clear_coat_roughness = 0.3;
    expected.clear_coat = 0.7;
    expected.clear_coat_roughness = 0.3;
    CHECK(difference_of(OwnSurface(look, own), metallic_roughness_surface(expected, brown)) < 2e-3);
}

TEST_CASE("each square of a painted plate is baked in its own colour, by any number of threads", "[unit]") {
    const Plate plate;
    MaterialSettings matt;
    matt.kind = MaterialKind::diffuse;
    matt.base = MaterialBase::own;
    const BakeScene scene(plate.mesh, matt, plate.look);
    const SpectralLight light(test::even_light(), 1.0);
    const SceneView view = test::front_view(plate.mesh, 48);
    BakeSettings settings{.samples = 4};
    settings.most_threads = 1;
    const SpectralFrame frame = test::baked(scene, light, view, settings);
    settings.most_threads = 3;
    const SpectralFrame again = test::baked(scene, light, view, settings);
    const LinearImage picture = to_rec709(frame), by_three = to_rec709(again);
    CHECK(picture.pixels == by_three.pixels);
    for (int row = 0; row < Plate::side; ++row)
        for (int column = 0; column < Plate::side; ++column) {
            CAPTURE(row, column);
            const glm::dvec2 middle = view.view.project({10.0 * column + 5.0, 0.0, -10.0 * row - 5.0});
            const auto x = static_cast<std::size_t>(middle.x), y = static_cast<std::size_t>(middle.y);
            const glm::vec4 seen = picture.pixels[y * 48 + x];
            const glm::u8vec3 texel = plate.texels[static_cast<std::size_t>(row * Plate::side + column)];
            // A plate sees nothing of itself: it gives back of even light just its reflectance.
            CHECK(seen.r == Approx(linear_of_srgb(texel.x)).margin(2e-3));
            CHECK(seen.g == Approx(linear_of_srgb(texel.y)).margin(2e-3));
            CHECK(seen.b == Approx(linear_of_srgb(texel.z)).margin(2e-3));
        }
}

TEST_CASE("a surface whose roughness and metal a picture gives keeps energy and loses none", "[unit]") {
    auto look = of_one_look(glm::vec3(1.0f), 1.0f, 1.0f);
    auto picture = std::make_shared<SurfacePicture>();
    picture->size_px = {2, 2};
    picture->texels = {{0, 40, 0, 255}, {0, 90, 255, 255}, {0, 160, 128, 255}, {0, 255, 40, 255}};
    look->pictures.push_back(picture);
    look->materials[0].surface_picture.picture = 0;
    const Mesh ball = test::ball({0.0, 0.0, 0.0}, 50.0);
    for (std::size_t i = 0; i < ball.triangles.size(); ++i) {
        const auto place = static_cast<float>(i % 4);
        const glm::vec2 uv(0.25f + 0.5f * std::fmod(place, 2.0f), 0.25f + 0.5f * std::floor(place / 2.0f));
        look->uvs[0].push_back({uv, uv, uv});
    }
    MaterialSettings own;
    own.kind = MaterialKind::own;
    const BakeScene scene(ball, own, look);
    const LinearImage lit = to_rec709(test::baked(scene, SpectralLight(test::even_light(), 1.0),
                                                  test::front_view(ball, 32), {.samples = 64}));
    double light = 0.0, covered = 0.0;
    for (const glm::vec4& pixel : lit.pixels) {
        light += static_cast<double>(pixel.g);
        covered += static_cast<double>(pixel.a);
    }
    CHECK(light / covered == Approx(1.0).margin(0.01));
}
