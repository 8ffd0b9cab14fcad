#include "experiment/maps/coordinate_image_lookup.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/maps/coordinate_maps.h"
#include "experiment/maps/surface_walk.h"
#include "experiment/scene/ray_caster.h"
#include "tests/support/figures.h"

using namespace overt;

namespace {

constexpr glm::ivec2 image_px{160, 160};
const ObjectPose angle{12.0};

/// A ball in front of another, as rays through the pixel centres see them.
struct TwoBalls {
    TwoBalls() {
        test::add_part(mesh, test::ball({0.0, 0.0, 0.0}, 60.0, 96, 192), "body");
        test::add_part(mesh, test::ball({20.0, -75.0, 20.0}, 25.0, 48, 96), "head");
        scene.view.image_px = image_px;
        scene.bounds = mesh.bounds();
        scene.view.camera = fit_camera(mesh, {12.0}, image_px, angle.angle, 0.05);
    }
    std::optional<RayHit> hit(glm::dvec2 place) const {
        return rays().first_hit(to_object(scene.view.ray_through(place), scene.pose_at(angle)));
    }
    const RayCaster& rays() const {
        if (!caster)
            caster = std::make_unique<RayCaster>(mesh);
        return *caster;
    }
    CoordinateImageFile map(bool with_camera = true) const {
        CoordinateImageFile file{CoordinateImage(image_px), {}, 0};
        file.image.parts.assign(file.image.pixels.size(), PartIndex{0});
        for (int y = 0; y < image_px.y; ++y) {
            for (int x = 0; x < image_px.x; ++x) {
                const auto met = hit({x + 0.5, y + 0.5});
                if (!met)
                    continue;
                file.image.at(x, y) = glm::vec4(met->position, 1.0f);
                file.image.parts[static_cast<std::size_t>(y * image_px.x + x)] =
                    mesh.triangle_parts[met->triangle];
            }
        }
        file.description.bounds = scene.bounds;
        file.description.angle = angle.angle;
        if (with_camera)
            file.description.camera = scene.view.camera;
        return file;
    }

    Mesh mesh;
    SceneView scene;
    mutable std::unique_ptr<RayCaster> caster;
};

CoordinateImageLookup lookup_of(CoordinateImageFile map) {
    std::vector<CoordinateImageFile> maps;
    maps.push_back(std::move(map));
    return CoordinateImageLookup(std::move(maps), image_px);
}

} // namespace

TEST_CASE("at the pixel centres a map of coordinates gives back what it holds", "[unit]") {
    const TwoBalls figure;
    const CoordinateImageFile map = figure.map();
    const CoordinateImageLookup lookup = lookup_of(map);
    const CoordinateImage again = coordinate_image(lookup, {0}, image_px);
    CHECK(again.pixels == map.image.pixels);
}

TEST_CASE("between the centres a map of coordinates follows the surface, and never spans an edge", "[unit]") {
    const TwoBalls figure;
    const CoordinateImageLookup lookup = lookup_of(figure.map());
    const double pixel = SightLines(figure.scene, angle)
                             .pixel_width_at(figure.scene.view.depth_of(figure.scene.bounds.centre()));
    RandomStream random(11, "places");
    int inside = 0, close = 0, off_surface = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec2 place(random.uniform(0, image_px.x), random.uniform(0, image_px.y));
        const auto surface = lookup.surface_at({0}, place);
        const glm::dvec2 centre = glm::floor(place) + 0.5;
        REQUIRE(surface.has_value() == figure.hit(centre).has_value());
        if (!surface)
            continue;
        // Both balls are round: how far the place is from the nearer sphere is how far it is off the surface.
        const double off = std::min(std::abs(glm::length(surface->position) - 60.0),
                                    std::abs(glm::distance(surface->position, {20.0, -75.0, 20.0}) - 25.0));
        off_surface += off > pixel;
        const auto met = figure.hit(place);
        if (!met)
            continue;
        ++inside;
        close += glm::distance(surface->position, met->position) < 0.1 * pixel;
        CHECK(surface->triangle == no_triangle);
    }
    CHECK(inside > 3000);
    CHECK(close > 0.93 * inside); // the rest is at edges and at grazing incidence
    // Interpolating over the edge between the balls would give hundreds of places in mid-air.
    CHECK(off_surface <= inside / 200);
}

TEST_CASE("depth, incidence and part come with a map of coordinates", "[unit]") {
    const TwoBalls figure;
    const CoordinateImageLookup lookup = lookup_of(figure.map());
    const View& view = figure.scene.view;
    const glm::dmat4 world_from_object = figure.scene.pose_at(angle).world_from_object();
    const auto image_of = [&](glm::dvec3 place) {
        return view.project(glm::dvec3(world_from_object * glm::dvec4(place, 1.0)));
    };
    const auto surface = lookup.surface_at({0}, image_of({20, -75, 20}));
    REQUIRE(surface);
    CHECK(figure.mesh.part_names[surface->part] == "head");
    CHECK(surface->incidence.value < 3.0); // a ball is met head-on in its middle
    CHECK(surface->depth ==
          Approx(view.depth_of(glm::dvec3(world_from_object * glm::dvec4(surface->position, 1.0)))));

    const glm::dvec2 aslant = image_of({0, 0, 0}) + glm::dvec2(0.0, 30.0);
    const auto beside = lookup.surface_at({0}, aslant);
    const auto met = figure.hit(aslant);
    REQUIRE((beside && met));
    CHECK(figure.mesh.part_names[beside->part] == "body");
    const Ray ray = to_object(view.ray_through(aslant), figure.scene.pose_at(angle));
    const double truth =
        to_degrees({std::acos(std::abs(glm::dot(glm::normalize(met->position), ray.direction)))}).value;
    CHECK(truth > 20.0);
    CHECK(beside->incidence.value == Approx(truth).margin(3.0));
}

TEST_CASE("what needs the camera is not a number where the map does not name it", "[unit]") {
    const TwoBalls figure;
    const CoordinateImageLookup lookup = lookup_of(figure.map(false));
    const auto surface = lookup.surface_at({0}, 0.5 * glm::dvec2(image_px));
    REQUIRE(surface);
    CHECK(std::isnan(surface->depth));
    CHECK(std::isnan(surface->incidence.value));
}

TEST_CASE("beside the object, outside of the image and for no number at all there is no surface", "[unit]") {
    const TwoBalls figure;
    const CoordinateImageLookup lookup = lookup_of(figure.map());
    for (const glm::dvec2 place : {glm::dvec2(0.5, 0.5), {-1.0, 80.0}, {80.0, 160.0}, {NAN, 80.0}})
        CHECK_FALSE(lookup.surface_at({0}, place));
    CHECK_THROWS_AS(CoordinateImageLookup({figure.map()}, {80, 80}), InputError);
}
