#include <numbers>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "render/bake/material_model.h"
#include "render/bake/microfacets.h"
#include "tests/render/bake/bake_support.h"

using namespace overt;

TEST_CASE("a brushed metal is reciprocal, tells its density, and is rougher across its scratches", "[unit]") {
    MaterialSettings material = test::material_of(MaterialKind::rough_conductor);
    material.roughness = 0.08;
    material.anisotropy = 0.6;
    const Mesh ball = test::ball({0, 0, 0}, 1.0, 12, 24);
    const auto wide = [&](BrushedAlong brushed, glm::vec3 lean) {
        material.brushed = brushed;
        const BakeScene scene(ball, material);
        const glm::vec3 front(0.0f, -1.0f, 0.0f);
        return scene.model().density(scene, {front, front}, glm::normalize(front + 0.6f * lean));
    };
    // Scratches around the vertical: what is mirrored spreads up and down.
    const glm::vec3 right(1.0f, 0.0f, 0.0f), above(0.0f, 0.0f, 1.0f);
    CHECK(wide(BrushedAlong::around, above) > 10.0f * wide(BrushedAlong::around, right));
    CHECK(wide(BrushedAlong::upward, right) > 10.0f * wide(BrushedAlong::upward, above));

    material.brushed = BrushedAlong::around;
    const BakeScene scene(ball, material);
    const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, -0.8f, 0.4f));
    const NormalFrame frame(normal);
    RandomStream random(4, "pairs");
    const auto above_surface = [&] {
        const double z = random.uniform(0.2, 1.0), turn = random.uniform(0.0, 6.28),
                     s = std::sqrt(1.0 - z * z);
        return frame.to_world(glm::vec3(glm::dvec3(s * std::cos(turn), s * std::sin(turn), z)));
    };
    const auto value = [&](glm::vec3 eye, glm::vec3 out) {
        // take() is value times cosine by density.
        Bins carried = Bins::filled(1.0f);
        scene.model().take(scene, {eye, normal}, out, carried);
        return carried.value[15] * scene.model().density(scene, {eye, normal}, out) / glm::dot(normal, out);
    };
    for (int pair = 0; pair < 200; ++pair) {
        const glm::vec3 eye = above_surface(), out = above_surface();
        const float there = value(eye, out), back = value(out, eye);
        CHECK(there == Approx(back).epsilon(2e-3).margin(1e-6));
    }
    const glm::vec3 eye = frame.to_world({0.6f, 0.0f, 0.8f});
    double told = 0.0, drawn = 0.0;
    constexpr int rows = 800;
    for (int i = 0; i < rows * rows; ++i) {
        const double z = (i / rows + 0.5) / rows, s = std::sqrt(1.0 - z * z),
                     turn = 2.0 * std::numbers::pi * (i % rows + 0.5) / rows;
        const glm::vec3 out =
            frame.to_world(glm::vec3(glm::dvec3(s * std::cos(turn), s * std::sin(turn), z)));
        told += static_cast<double>(scene.model().density(scene, {eye, normal}, out)) * 2.0 *
                std::numbers::pi / (rows * rows);
    }
    for (std::uint32_t sample = 0; sample < 16384; ++sample) {
        SampleSequence sequence(2, {5, 5}, sample);
        Bins carried = Bins::filled(1.0f);
        drawn += scene.model().scatter(scene, {eye, normal}, sequence, carried) != glm::vec3(0.0f)
                     ? 1.0 / 16384
                     : 0.0;
    }
    CHECK(told == Approx(drawn).margin(0.01));
}
