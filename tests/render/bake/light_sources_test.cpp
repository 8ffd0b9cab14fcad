#include <numbers>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "render/bake/layered_surface.h"
#include "render/bake/light_sources.h"
#include "render/bake/material_model.h"
#include "tests/render/bake/bake_support.h"

using namespace overt;

namespace {

constexpr double lamp_pi = std::numbers::pi;

LampSettings lamp_of(LampShape shape, glm::dvec3 position, double cd_m2) {
    LampSettings lamp;
    lamp.id = "lamp";
    lamp.shape = shape;
    lamp.position = position;
    lamp.cd_m2 = cd_m2;
    return lamp;
}

LightSettings lit_by(const LampSettings& lamp) {
    LightSettings light;
    light.probe = "dark";
    light.lamps = {lamp.id};
    light.shining = {lamp};
    return light;
}

LightSettings sun_from(double azimuth_deg, double elevation_deg, double lux) {
    LightSettings light;
    light.probe = "dark";
    light.sun_lux = lux;
    light.sun_azimuth_deg = azimuth_deg;
    light.sun_elevation_deg = elevation_deg;
    return light;
}

/// A plate of 2 x 2 that faces the camera, in the plane y = 0, about the origin.
Mesh plate() {
    Mesh mesh;
    mesh.positions = {{-1, 0, 1}, {-1, 0, -1}, {1, 0, -1}, {1, 0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.triangle_parts.assign(2, PartIndex{0});
    mesh.part_names = {"body"};
    return mesh;
}

/// What the middle of the plate gives back, as a share of the probe's unit.
double middle_of_plate(const LightSettings& light, const MaterialSettings& material, int samples,
                       const ObjectPose& pose = {}) {
    const Mesh mesh = plate();
    SceneView view = test::front_view(mesh, 9);
    view.view.camera.vertical_fov.value /= 100.0; // all of the picture is the very middle
    const BakeScene scene(mesh, material);
    const LinearImage picture =
        to_rec709(test::baked(scene, SpectralLight(light), view, {.samples = samples}, pose));
    double mean = 0.0;
    for (const glm::vec4& pixel : picture.pixels)
        mean += static_cast<double>(pixel.g) / static_cast<double>(picture.pixels.size());
    return mean;
}

MaterialSettings matt() {
    MaterialSettings material = test::material_of(MaterialKind::diffuse);
    material.reflectance = glm::dvec3(0.5);
    return material;
}

/// Illuminance at the origin, on what faces (0, -1, 0), by points of a lamp in even steps.
double reckoned_illuminance(const LightSource& source) {
    double sum = 0.0;
    constexpr int side = 200;
    for (int i = 0; i < side * side; ++i) {
        const glm::vec2 place((static_cast<float>(i % side) + 0.5f) / side,
                              (static_cast<float>(i / side) + 0.5f) / side);
        const LightSource::Aim aim = source.aim(glm::vec3(0.0f), place);
        if (aim.density > 0.0f)
            sum += std::max(0.0, -static_cast<double>(aim.direction.y)) /
                   (static_cast<double>(aim.density) * side * side);
    }
    return sum * static_cast<double>(source.light.g);
}

} // namespace

TEST_CASE("the illuminance of sun, disc, sphere and rectangle is that of the closed forms", "[unit]") {
    struct Known {
        std::string name;
        LightSettings light;
        double lux; ///< on the plate's middle
    };
    std::vector<Known> known;
    // Facing disc: pi L sin^2, sin^2 = r^2 / (r^2 + d^2).
    LampSettings disc = lamp_of(LampShape::disc, {0, -3, 0}, 100.0);
    disc.radius = 1.5;
    known.push_back({"disc", lit_by(disc), lamp_pi * 100.0 * 2.25 / (2.25 + 9.0)});
    // Sphere wholly above the plane: pi L (r / d)^2 cos.
    LampSettings sphere = lamp_of(LampShape::sphere, {2, -3, 1}, 40.0);
    sphere.radius = 0.8;
    const double d = std::sqrt(14.0);
    known.push_back({"sphere", lit_by(sphere), lamp_pi * 40.0 * 0.64 / 14.0 * 3.0 / d});
    // A parallel rectangle, a quarter of it: L / 2 (A / sqrt(1 + A^2) atan(B / sqrt(1 + A^2)) + the same of B
    // and A), A = a / d, B = b / d.
    LampSettings window = lamp_of(LampShape::rectangle, {0, -2, 0}, 70.0);
    window.width = 3.0;
    window.height = 1.0;
    const double a = 0.75, b = 0.25;
    known.push_back({"rectangle", lit_by(window),
                     4.0 * 70.0 * 0.5 *
                         (a / std::hypot(1.0, a) * std::atan(b / std::hypot(1.0, a)) +
                          b / std::hypot(1.0, b) * std::atan(a / std::hypot(1.0, b)))});
    // The sun: its lux times the cosine, whatever its size.
    known.push_back({"sun", sun_from(30.0, 20.0, 1000.0),
                     1000.0 * std::cos(30.0 * lamp_pi / 180.0) * std::cos(20.0 * lamp_pi / 180.0)});
    known.push_back({"large sun", sun_from(-40.0, 10.0, 500.0),
                     500.0 * std::cos(40.0 * lamp_pi / 180.0) * std::cos(10.0 * lamp_pi / 180.0)});
    known.back().light.sun_radius_deg = 12.0;
    for (const Known& one : known) {
        CAPTURE(one.name);
        const std::vector<LightSource> sources = light_sources(one.light);
        REQUIRE(sources.size() == 1);
        CHECK(reckoned_illuminance(sources[0]) == Approx(one.lux).epsilon(1e-4));
        // Baked on a matt surface: E rho / pi.
        CHECK(middle_of_plate(one.light, matt(), 512) == Approx(one.lux * 0.5 / lamp_pi).epsilon(3e-3));
        // The same light in another unit.
        LightSettings other = one.light;
        other.unit_cd_m2 = 10.0;
        CHECK(middle_of_plate(other, matt(), 16) == Approx(one.lux * 0.05 / lamp_pi).epsilon(1e-2));
    }
}

TEST_CASE("lamps are aimed at with the density that they tell, and met where they are", "[unit]") {
    LampSettings disc = lamp_of(LampShape::disc, {1, -3, 2}, 1.0), sphere = disc, window = disc;
    disc.radius = sphere.radius = 0.7;
    sphere.shape = LampShape::sphere;
    window.shape = LampShape::rectangle;
    window.width = 2.0;
    window.height = 0.5;
    window.faces = glm::dvec3(0.5, 0.0, -1.0);
    for (const LightSettings& light : {lit_by(disc), lit_by(sphere), lit_by(window), sun_from(70, 30, 1)}) {
        const LightSource source = light_sources(light)[0];
        RandomStream random(5, "places");
        const glm::vec3 from(0.1f, -0.2f, 0.3f);
        for (int i = 0; i < 300; ++i) {
            const LightSource::Aim aim = source.aim(from, {static_cast<float>(random.uniform(0.0, 1.0)),
                                                           static_cast<float>(random.uniform(0.0, 0.999))});
            REQUIRE(aim.density > 0.0f);
            CHECK(glm::length(aim.direction) == Approx(1.0f).epsilon(1e-5));
            if (i % 2 == 0 && source.shape == LightSource::Shape::disc)
                continue; // edges are met or not, by rounding
            const float at = source.met_at(from, aim.direction);
            if (at < 0.0f)
                continue;
            CHECK(source.density(from, aim.direction, at) == Approx(aim.density).epsilon(1e-3));
            if (source.shape != LightSource::Shape::sun)
                CHECK(at == Approx(aim.distance).epsilon(1e-3));
        }
        // Of all directions as many meet it as its densities say.
        double met = 0.0, aimed = 0.0;
        constexpr int rows = 1000;
        for (int i = 0; i < rows * rows; ++i) {
            const double z = 1.0 - 2.0 * (i / rows + 0.5) / rows, s = std::sqrt(1.0 - z * z),
                         around = 2.0 * lamp_pi * (i % rows + 0.5) / rows;
            met +=
                source.met_at(from, glm::vec3(glm::dvec3(s * std::cos(around), s * std::sin(around), z))) > 0
                    ? 4.0 * lamp_pi / (rows * rows)
                    : 0.0;
        }
        for (int i = 0; i < 10000; ++i)
            aimed +=
                1e-4 / static_cast<double>(source
                                               .aim(from, {(static_cast<float>(i % 100) + 0.5f) / 100.0f,
                                                           (static_cast<float>(i / 100) + 0.5f) / 100.0f})
                                               .density);
        if (source.shape != LightSource::Shape::sun)
            CHECK(met == Approx(aimed).epsilon(0.02));
        else
            CHECK(aimed == Approx(6.801e-5).epsilon(1e-3)); // steradian, of 0.2666 degrees
        CHECK(source.met_at(from, {0.0f, 1.0f, 0.0f}) < 0.0f);
    }
    // From behind nothing shines.
    const LightSource back = light_sources(lit_by(disc))[0];
    CHECK(back.met_at({2.0f, -6.0f, 4.0f}, glm::normalize(glm::vec3(-1.0f, 3.0f, -2.0f))) < 0.0f);
    CHECK(back.aim({2.0f, -6.0f, 4.0f}, {0.3f, 0.4f}).density == 0.0f);
}

TEST_CASE("the sun stands where azimuth and elevation say, and turns with its light and the object",
          "[unit]") {
    // Behind the observer, at the right, behind the object, above.
    const auto is_at = [](const LightSettings& light, glm::dvec3 place) {
        return glm::length(glm::dvec3(light_sources(light)[0].place) - place) < 1e-6;
    };
    CHECK(is_at(sun_from(0, 0, 1), {0, -1, 0}));
    CHECK(is_at(sun_from(90, 0, 1), {1, 0, 0}));
    CHECK(is_at(sun_from(180, 0, 1), {0, 1, 0}));
    CHECK(is_at(sun_from(77, 90, 1), {0, 0, 1}));
    // The light is turned as its probe is: by 90 degrees, what was behind the observer is at the right.
    LightSettings turned = sun_from(0, 0, 1);
    turned.rotation_deg = 90.0;
    const auto at = [](const LightSettings& light, ObjectPose pose) {
        return SpectralLight(light).sources_at(pose)[0].place;
    };
    CHECK(glm::length(at(turned, {}) - glm::vec3(1, 0, 0)) < 1e-6f);
    LightProbe lamp = test::even_light(glm::vec3(0.0f));
    lamp.radiance = LinearImage({64, 32});
    lamp.radiance.at(0, 16) = glm::vec4(1.0f); // behind the observer
    const SpectralLight probe(lamp, 1.0, 90.0);
    CHECK(probe.towards({1, 0, 0}, probe.share_of_turn({0.0})).x > 0.2f);
    // The object turned by 90 degrees, counter-clockwise seen from above, has it at its front's other side.
    CHECK(glm::length(at(sun_from(0, 0, 1), {{90.0}}) - glm::vec3(-1, 0, 0)) < 1e-6f);
    // So has the plate, turned away or towards.
    CHECK(middle_of_plate(sun_from(60, 0, 100), matt(), 16) ==
          Approx(100.0 * 0.5 * 0.5 / lamp_pi).epsilon(0.01));
    CHECK(middle_of_plate(sun_from(60, 0, 100), matt(), 16, {{50.0}}) ==
          Approx(100.0 * std::cos(10.0 * lamp_pi / 180.0) * 0.5 / lamp_pi).epsilon(0.01));
    // What is moved is farther from a lamp: a sphere behind the camera, the plate moved away from it.
    LampSettings sphere = lamp_of(LampShape::sphere, {0, -4, 0}, 10.0);
    sphere.radius = 1.0;
    ObjectPose away;
    away.shift = {0.0, 1.0, 0.0};
    CHECK(middle_of_plate(lit_by(sphere), matt(), 16, away) == Approx(0.5 * 10.0 / 25.0).epsilon(0.01));
}

TEST_CASE("the light of probe, sun and lamps together is the sum of each, for all kinds of surface",
          "[unit]") {
    LampSettings window = lamp_of(LampShape::rectangle, {-1.5, -1.5, 1.5}, 3.0);
    window.width = window.height = 1.2;
    LightSettings both = lit_by(window);
    both.sun_lux = 2.0;
    both.sun_azimuth_deg = 20.0;
    both.sun_radius_deg = 5.0;
    LightSettings lamp = lit_by(window), sun = both;
    sun.lamps.clear();
    sun.shining.clear();
    for (const MaterialKind kind :
         {MaterialKind::diffuse, MaterialKind::plastic, MaterialKind::rough_conductor,
          MaterialKind::metallic_roughness, MaterialKind::smooth_conductor}) {
        MaterialSettings material = test::material_of(kind);
        material.roughness = 0.3;
        const Mesh figure = test::ball({0, 0, 0}, 1.0, 24, 48);
        const SceneView view = test::front_view(figure, 16);
        const BakeScene scene(figure, material);
        const auto light_of = [&](const LightSettings& light) {
            const LinearImage picture =
                to_rec709(test::baked(scene, SpectralLight(light), view, {.samples = 128}));
            double sum = 0.0;
            for (const glm::vec4& pixel : picture.pixels)
                sum += static_cast<double>(pixel.g);
            return sum;
        };
        CAPTURE(row_of(kind).name);
        CHECK(light_of(both) == Approx(light_of(lamp) + light_of(sun)).epsilon(0.01));
        CHECK(light_of(lamp) > 0.0);
    }
}

TEST_CASE("what a rough surface shows of a lamp does not depend on how it is found", "[unit]") {
    // A disc as wide as most of the sky, and a probe that has it: aimed at, by chance, and both.
    LampSettings disc = lamp_of(LampShape::disc, {0, -3, 0}, 1.0);
    disc.radius = 1.0;
    for (const double alpha : {0.05, 0.3}) {
        MaterialSettings plastic = test::material_of(MaterialKind::plastic);
        plastic.roughness = alpha;
        plastic.reflectance = glm::dvec3(0.4);
        const BakeScene scene(plate(), plastic);
        const LayeredSurface& surface = scene.layers();
        // Reckoned over the disc, seen head-on: value times cosine.
        const LightSource source = light_sources(lit_by(disc))[0];
        const SurfaceEvent event{{0, -1, 0}, {0, -1, 0}};
        double expected = 0.0;
        constexpr int side = 300;
        for (int i = 0; i < side * side; ++i) {
            const LightSource::Aim aim =
                source.aim(glm::vec3(0.0f), {(static_cast<float>(i % side) + 0.5f) / side,
                                             (static_cast<float>(i / side) + 0.5f) / side});
            expected += static_cast<double>(surface.value(event, aim.direction).value[15] * -aim.direction.y /
                                            aim.density) /
                        (side * side);
        }
        CAPTURE(alpha);
        CHECK(middle_of_plate(lit_by(disc), plastic, 256) == Approx(expected).epsilon(0.01));
    }
}

TEST_CASE("a live frame's probe has the light of sun, lamps and sums, whole", "[unit]") {
    const auto flux = [](const LightProbe& probe) {
        const glm::ivec2 size = probe.radiance.size_px;
        double sum = 0.0;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                sum += static_cast<double>(probe.radiance.at(x, y).g) * 2.0 * lamp_pi / size.x *
                       (std::cos(lamp_pi * y / size.y) - std::cos(lamp_pi * (y + 1) / size.y));
        return sum;
    };
    const LightSettings sun = sun_from(100, 35, 100.0);
    const double sine = std::sin(0.2666 * lamp_pi / 180.0);
    // A lamp as small as that has a flux of its illuminance, but for the cosines within it.
    CHECK(flux(distant_probe(sun)) == Approx(100.0 / (lamp_pi * sine * sine) * 6.801e-5).epsilon(1e-3));
    LampSettings sphere = lamp_of(LampShape::sphere, {2, 1, 1}, 5.0);
    sphere.radius = 1.0;
    const double cap = 2.0 * lamp_pi * (1.0 - std::sqrt(1.0 - 1.0 / 6.0));
    CHECK(flux(distant_probe(lit_by(sphere))) == Approx(5.0 * cap).epsilon(1e-3));
    LightSettings sum;
    sum.sum = {{"a", 2.0}, {"b", 0.5}};
    sum.parts = {lit_by(sphere), sun};
    CHECK(flux(distant_probe(sum)) ==
          Approx(2.0 * flux(distant_probe(sum.parts[0])) + 0.5 * flux(distant_probe(sum.parts[1])))
              .epsilon(0.05));
}
