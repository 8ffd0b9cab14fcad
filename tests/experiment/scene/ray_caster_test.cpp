#include <catch2/catch.hpp>

#include <cmath>
#include <optional>
#include <vector>

#include "experiment/base/random.h"
#include "experiment/scene/ray_caster.h"
#include "tests/support/figures.h"

using namespace overt;

namespace {

glm::dvec3 random_direction(RandomStream& random) {
    const double z = random.uniform(-1.0, 1.0), azimuth = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double radius = std::sqrt(1.0 - z * z);
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

/// Triangles thrown about in a box that stands far from the origin.
Mesh random_triangles(std::uint64_t seed, int count) {
    RandomStream random(seed, "random triangles");
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 centre(random.uniform(50.0, 60.0), random.uniform(-5.0, 5.0),
                                random.uniform(100.0, 110.0));
        for (int corner = 0; corner < 3; ++corner)
            mesh.positions.emplace_back(centre + random.uniform(0.05, 2.0) * random_direction(random));
        const auto first = static_cast<std::uint32_t>(3 * i);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    mesh.part_names = {"body"};
    return mesh;
}

struct BruteHit {
    std::uint32_t triangle;
    double distance;
};

/// Solves origin + t direction = a + u (b - a) + v (c - a) by Cramer's rule, for every triangle.
std::optional<BruteHit> by_brute_force(const Mesh& mesh, const Ray& ray) {
    std::optional<BruteHit> nearest;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3 t = mesh.triangles[i];
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        const glm::dmat3 sides(b - a, c - a, -ray.direction);
        const double determinant = glm::determinant(sides);
        const glm::dvec3 to_origin = ray.origin - a;
        const double u = glm::determinant(glm::dmat3(to_origin, sides[1], sides[2])) / determinant;
        const double v = glm::determinant(glm::dmat3(sides[0], to_origin, sides[2])) / determinant;
        const double distance = glm::determinant(glm::dmat3(sides[0], sides[1], to_origin)) / determinant;
        if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0 &&
            (!nearest || distance < nearest->distance))
            nearest = BruteHit{i, distance};
    }
    return nearest;
}

glm::dvec3 point_of(const Mesh& mesh, const RayHit& hit) {
    const glm::uvec3 t = mesh.triangles[hit.triangle];
    return hit.barycentric.x * glm::dvec3(mesh.positions[t.x]) +
           hit.barycentric.y * glm::dvec3(mesh.positions[t.y]) +
           hit.barycentric.z * glm::dvec3(mesh.positions[t.z]);
}

} // namespace

TEST_CASE("a cast ray meets the triangle that testing all of them finds", "[unit]") {
    const Mesh mesh = random_triangles(7, 400);
    const RayCaster caster(mesh);
    RandomStream random(7, "rays");
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
        // From far away as a camera stands, and from among the triangles.
        const glm::dvec3 towards(random.uniform(50.0, 60.0), random.uniform(-5.0, 5.0),
                                 random.uniform(100.0, 110.0));
        const glm::dvec3 direction = random_direction(random);
        const Ray ray{towards - random.uniform(0.0, i % 2 ? 5000.0 : 5.0) * direction, direction};
        const std::optional<BruteHit> expected = by_brute_force(mesh, ray);
        const std::optional<RayHit> hit = caster.first_hit(ray);
        REQUIRE(hit.has_value() == expected.has_value());
        if (!hit)
            continue;
        ++met;
        REQUIRE(hit->triangle == expected->triangle);
        REQUIRE(hit->distance == Approx(expected->distance).epsilon(1e-9).margin(1e-9));
        REQUIRE(glm::length(point_of(mesh, *hit) - hit->position) < 1e-9);
        REQUIRE(glm::length(ray.origin + hit->distance * ray.direction - hit->position) < 1e-9);
    }
    CHECK(met > 10000);
}

TEST_CASE("no ray leaks through the edges and corners of a closed ball", "[unit]") {
    const Mesh mesh = test::ball({3.0, -2.0, 1.0}, 1.0, 40, 80);
    const RayCaster caster(mesh);
    RandomStream random(1, "leaks");
    const glm::dvec3 inside(3.02, -2.05, 0.97);
    const auto leaks = [&](glm::dvec3 eye, glm::dvec3 aim) {
        return !caster.first_hit({eye, glm::normalize(aim - eye)}).has_value();
    };
    int leaked = 0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[triangle.x]), b(mesh.positions[triangle.y]);
        // From within through a corner and through places of an edge; and from far outside likewise, towards
        // the middle of the ball.
        const glm::dvec3 on_edge = glm::mix(a, b, random.uniform());
        const glm::dvec3 far_away = inside + 2000.0 * glm::normalize(on_edge - inside);
        leaked += leaks(inside, a) + leaks(inside, on_edge) + leaks(inside, 0.5 * (a + b)) +
                  leaks(far_away, inside);
    }
    CHECK(leaked == 0);
}

TEST_CASE("a batch of rays gives what each ray gives alone", "[unit]") {
    const Mesh mesh = random_triangles(3, 200);
    const RayCaster caster(mesh);
    RandomStream random(3, "batch");
    std::vector<Ray> rays;
    for (int i = 0; i < 10000; ++i)
        rays.push_back({{random.uniform(40.0, 70.0), -30.0, random.uniform(95.0, 115.0)}, {0.0, 1.0, 0.0}});
    std::vector<std::optional<RayHit>> hits(rays.size());
    caster.first_hits(rays, hits);
    bool same = true;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::optional<RayHit> alone = caster.first_hit(rays[i]);
        same = same && alone.has_value() == hits[i].has_value() &&
               (!alone || (alone->triangle == hits[i]->triangle && alone->position == hits[i]->position));
    }
    CHECK(same);
}

TEST_CASE("a point of the surface is hidden exactly when something else is met first", "[unit]") {
    const Mesh mesh = test::bust();
    const RayCaster caster(mesh);
    RandomStream random(5, "hidden");
    int hidden = 0;
    for (int i = 0; i < 5000; ++i) {
        const std::uint32_t triangle = random.below(static_cast<std::uint32_t>(mesh.triangles.size()));
        double u = random.uniform(0.01, 0.99), v = random.uniform(0.01, 0.99);
        if (u + v > 1.0)
            u = 1.0 - u, v = 1.0 - v;
        const glm::uvec3 t = mesh.triangles[triangle];
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        const glm::dvec3 point = a + u * (b - a) + v * (c - a);
        const glm::dvec3 eye(random.uniform(-300.0, 300.0), -1500.0, 150.0);
        const std::optional<RayHit> hit = caster.first_hit({eye, glm::normalize(point - eye)});
        // Rays that pass a corner at rounding's distance may meet either neighbour, at the same place.
        const bool met_first = hit && glm::length(hit->position - point) > 1e-5;
        const bool is_hidden = caster.is_hidden(point, eye);
        CHECK(is_hidden == met_first);
        hidden += is_hidden;
    }
    CHECK(hidden > 500);
    CHECK(hidden < 4500);
}

TEST_CASE("a ray that starts behind the mesh or passes beside it meets nothing", "[unit]") {
    const Mesh mesh = test::ball({0.0, 0.0, 0.0}, 1.0);
    const RayCaster caster(mesh);
    CHECK(caster.first_hit({{0.0, -5.0, 0.1}, {0.0, 1.0, 0.0}}).has_value());
    CHECK_FALSE(caster.first_hit({{0.0, 5.0, 0.1}, {0.0, 1.0, 0.0}}).has_value());
    CHECK_FALSE(caster.first_hit({{0.0, -5.0, 1.2}, {0.0, 1.0, 0.0}}).has_value());
    CHECK_FALSE(caster.first_hit({{0.0, -5.0, 0.1}, {0.0, std::nan(""), 0.0}}).has_value());

    const Mesh nothing;
    CHECK_FALSE(RayCaster(nothing).first_hit({{0.0, -5.0, 0.1}, {0.0, 1.0, 0.0}}).has_value());
}
