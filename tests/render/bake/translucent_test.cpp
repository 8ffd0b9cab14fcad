#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "render/bake/conductor.h"
#include "render/bake/medium.h"
#include "tests/render/bake/bake_support.h"

using namespace overt;

namespace {

using Rgb = std::array<double, 3>;

MaterialSettings body_of(Rgb scattering, Rgb absorption, double ior = 1.5, double anisotropy = 0.0) {
    MaterialSettings material = test::material_of(MaterialKind::translucent);
    material.scattering_per_mm = scattering;
    material.absorption_per_mm = absorption;
    material.ior = ior;
    material.scattering_anisotropy = anisotropy;
    return material;
}

constexpr Rgb grey(double of) { return {of, of, of}; }

/// Seen in the middle of a box's top at an angle from upright, from which a camera does not look down.
SceneView top_view(const Mesh& box, double angle_deg, int size_px) {
    SceneView view = test::front_view(box, size_px);
    const double angle = to_radians(Degrees{std::max(angle_deg, 0.3)}).value, far = 2000.0;
    const glm::dvec3 middle(0.0, 0.0, box.bounds().max.z);
    view.view.camera = {middle + far * glm::dvec3(0.0, -std::sin(angle), std::cos(angle)), middle, {0.02}};
    return view;
}

/// A mean over pixels, and its standard error by how they differ.
struct Level {
    double mean = 0.0, error = 0.0;
};

Level level_of(const SpectralFrame& frame, std::size_t bin) {
    const Bins white = [] {
        Bins bins = Bins::of(light_basis()[0]);
        add(bins, Bins::of(light_basis()[1]));
        add(bins, Bins::of(light_basis()[2]));
        return bins;
    }();
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (std::size_t pixel = 0; pixel < frame.alpha.size(); ++pixel) {
        if (frame.alpha[pixel] < 1.0f)
            continue;
        const auto light =
            static_cast<double>(frame.radiance[pixel * spectral_bins + bin] / white.value[bin]);
        sum += light;
        squares += light * light;
        count += 1.0;
    }
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / count)};
}

/// Chandrasekhar's H function of isotropic scattering, by iteration.
class ChandrasekharH {
  public:
    explicit ChandrasekharH(double albedo) : albedo_(albedo), value_(steps, 1.0) {
        for (int turn = 0; turn < 60; ++turn) {
            std::vector<double> next;
            for (int i = 0; i < steps; ++i)
                next.push_back(at((i + 0.5) / steps));
            value_ = std::move(next);
        }
    }
    double at(double cosine) const {
        double integral = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double other = (i + 0.5) / steps;
            integral += other * value_[static_cast<std::size_t>(i)] / (cosine + other) / steps;
        }
        return 1.0 / (std::sqrt(1.0 - albedo_) + 0.5 * albedo_ * integral);
    }
    /// Of light that leaves at a cosine, lit from everywhere.
    double plane_albedo(double cosine) const { return 1.0 - at(cosine) * std::sqrt(1.0 - albedo_); }

  private:
    static constexpr int steps = 200;
    double albedo_;
    std::vector<double> value_;
};

/// Share of light along the normal that a half space with a polished border gives back: a walk of its own,
/// over depth and the cosine to it alone. Scattering and absorption by chance, unlike the path tracer's.
double known_half_space(double albedo, double ior, double g, int paths) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    const auto fresnel = [&](double relative, double cosine) {
        return static_cast<double>(
            dielectric_fresnel(static_cast<float>(relative), static_cast<float>(cosine)));
    };
    double back = fresnel(ior, 1.0) * paths;
    for (int path = 0; path < paths; ++path) {
        double depth = 0.0, cosine = -1.0; // up is out
        while (true) {
            depth -= cosine * -std::log(1.0 - number(random));
            if (depth < 0.0) {
                // It meets the border, and what is left of the flight is drawn anew.
                depth = 0.0;
                if (number(random) >= fresnel(1.0 / ior, cosine)) {
                    back += 1.0 - fresnel(ior, 1.0);
                    break;
                }
                cosine = -cosine;
                continue;
            }
            if (number(random) >= albedo)
                break;
            double turn = 1.0 - 2.0 * number(random);
            if (g != 0.0) {
                const double root = (1.0 - g * g) / (1.0 + g * turn);
                turn = (1.0 + g * g - root * root) / (2.0 * g);
            }
            const double around = 2.0 * std::numbers::pi * number(random);
            cosine = cosine * turn + std::sqrt(std::max(0.0, (1.0 - cosine * cosine) * (1.0 - turn * turn))) *
                                         std::cos(around);
        }
    }
    return back / paths;
}

} // namespace

TEST_CASE("a body that absorbs nothing is not to be seen in even light", "[unit]") {
    const SpectralLight even(test::even_light(), 1.0);
    const Mesh bust = test::bust();
    const double size = bust.bounds().extent().z;
    const SceneView view = test::front_view(bust, 24);
    for (const double ior : {1.0, 1.5})
        for (const double g : {0.0, 0.7}) {
            // One scattering for all colours: no path is weighed, and every one comes out.
            MaterialSettings milk = body_of(grey(40.0 / size), grey(0.0), ior, g);
            if (g > 0.0)
                milk.roughness = 0.3;
            const SpectralFrame one = test::baked(BakeScene(bust, milk), even, view, {.samples = 4});
            const Level lit = level_of(one, 5);
            CHECK(lit.mean == Approx(1.0).margin(1e-4));
            CHECK(one.given_up == 0.0);
            // Each colour its own: right in the mean.
            milk.scattering_per_mm = {10.0 / size, 20.0 / size, 30.0 / size};
            const SpectralFrame many = test::baked(BakeScene(bust, milk), even, view, {.samples = 64});
            for (const std::size_t bin : {0u, 15u, 30u}) {
                const Level of = level_of(many, bin);
                CAPTURE(ior, g, bin, of.mean, of.error);
                CHECK(std::abs(of.mean - 1.0) <= 3.0 * of.error + 1e-4);
                CHECK(of.error < 0.02);
            }
        }
}

TEST_CASE("light that is given up in a very dense body is counted", "[unit]") {
    // Ten thousand mean flights to the middle: some paths would take a hundred million scatterings.
    const Mesh ball = test::ball({0.0, 0.0, 0.0}, 1.0);
    SceneView middle = test::front_view(ball, 16);
    middle.view.camera.vertical_fov.value /= 4.0;
    const SpectralFrame frame = test::baked(BakeScene(ball, body_of(grey(10000.0), grey(0.0), 1.0)),
                                            SpectralLight(test::even_light(), 1.0), middle, {.samples = 8});
    CHECK(level_of(frame, 5).mean + frame.given_up == Approx(1.0).margin(1e-5));
    CHECK(frame.given_up < 0.01);
}

TEST_CASE("without scattering a translucent body is coloured glass, bit for bit", "[unit]") {
    const Mesh ball = test::ball({0.0, 0.0, 0.0}, 1.0, 48, 96);
    LightSettings settings;
    settings.probe = "gallery";
    const SpectralLight gallery(settings);
    const SceneView view = test::front_view(ball, 24);
    MaterialSettings glass = test::material_of(MaterialKind::glass),
                     body = body_of(grey(0.0), {0.3, 0.05, 0.1});
    glass.absorbance = {0.3, 0.05, 0.1}; // over half the height, which is 1 mm
    for (const std::optional<double> roughness : {std::optional<double>(), std::optional(0.2)}) {
        glass.roughness = body.roughness = roughness;
        const SpectralFrame one = test::baked(BakeScene(ball, glass), gallery, view, {.samples = 4}),
                            other = test::baked(BakeScene(ball, body), gallery, view, {.samples = 4});
        CHECK(one.radiance == other.radiance);
        CHECK(one.alpha == other.alpha);
    }
}

TEST_CASE("what goes straight through a slab is left by Beer and Lambert's law", "[unit]") {
    const Mesh slab = test::box({-50.0, -50.0, -1.0}, {50.0, 50.0, 1.0});
    const SceneView view = top_view(slab, 0.0, 8);
    const MaterialSettings filter = body_of(grey(0.0), {0.2, 0.5, 1.0}, 1.0);
    const SpectralFrame seen =
        test::baked(BakeScene(slab, filter), SpectralLight(test::even_light(), 1.0), view, {.samples = 4});
    const Spectrum absorption = absorbance_of(filter.absorption_per_mm);
    for (const std::size_t bin : {0u, 12u, 20u, 30u})
        CHECK(level_of(seen, bin).mean == Approx(std::exp(-2.0 * absorption[bin])).epsilon(3e-4));
}

TEST_CASE("a thick body gives back what Chandrasekhar's functions say of a half space", "[unit]") {
    // 80 mean flights deep, and wide enough that nothing gets to an edge.
    const Mesh block = test::box({-200.0, -200.0, -40.0}, {200.0, 200.0, 40.0});
    const SpectralLight even(test::even_light(), 1.0);
    const auto seen = [&](const MaterialSettings& material, double angle_deg, std::size_t bin,
                          int samples = 128) {
        return level_of(test::baked(BakeScene(block, material), even, top_view(block, angle_deg, 16),
                                    {.samples = samples}),
                        bin);
    };
    // The H function itself, against printed plane albedos.
    CHECK(ChandrasekharH(0.9).plane_albedo(1.0) == Approx(0.41495).margin(2e-4));
    CHECK(ChandrasekharH(0.5).plane_albedo(0.2) == Approx(0.21266).margin(2e-4));
    for (const double albedo : {0.5, 0.9, 0.99}) {
        const ChandrasekharH h(albedo);
        const MaterialSettings medium = body_of(grey(albedo), grey(1.0 - albedo), 1.0);
        for (const double cosine : {1.0, 0.5}) {
            const Level level = seen(medium, to_degrees({std::acos(cosine)}).value, 9);
            CAPTURE(albedo, cosine, level.mean, level.error);
            CHECK(std::abs(level.mean - h.plane_albedo(cosine)) <= 3.0 * level.error + 2e-4);
            CHECK(level.error < 0.004);
        }
    }
    // Colours that scatter unlike, each as if it were alone.
    const MaterialSettings colours = body_of({1.0, 2.0, 0.5}, {1.0, 0.2, 0.005}, 1.0);
    const SpectralFrame frame =
        test::baked(BakeScene(block, colours), even, top_view(block, 0.0, 16), {.samples = 256});
    const Spectrum scattering = absorbance_of(colours.scattering_per_mm),
                   absorption = absorbance_of(colours.absorption_per_mm);
    for (const std::size_t bin : {3u, 10u, 19u, 28u}) {
        const Level level = level_of(frame, bin);
        const double known =
            ChandrasekharH(scattering[bin] / (scattering[bin] + absorption[bin])).plane_albedo(1.0);
        CAPTURE(bin, level.mean, level.error, known);
        CHECK(std::abs(level.mean - known) <= 3.0 * level.error + 2e-4);
        CHECK(level.error < 0.008);
    }
    // With a border that mirrors and bends, and scattering forward: a walk of its own.
    const Level level = seen(body_of(grey(0.95), grey(0.05), 1.5, 0.6), 0.0, 9);
    CAPTURE(level.mean, level.error);
    CHECK(level.mean == Approx(known_half_space(0.95, 1.5, 0.6, 200000)).margin(3.0 * level.error + 0.002));
    // And the formula that live frames take their colour from, against printed albedos for even light.
    for (const auto& [albedo, known] :
         {std::pair{0.5, 0.14654}, {0.8, 0.34187}, {0.9, 0.47802}, {0.99, 0.79456}, {0.999, 0.92971}})
        CHECK(half_space_albedo(albedo, 0.0) == Approx(known).margin(0.0025));
}

TEST_CASE("what little comes through a dark slab is right in the mean, though chance ends most paths",
          "[unit]") {
    // Lit from below alone: what comes through carries a fiftieth or less.
    constexpr double scattering = 1.0, absorption = 0.5, thickness = 8.0, g = 0.9;
    const Mesh slab = test::box({-200.0, -200.0, -0.5 * thickness}, {200.0, 200.0, 0.5 * thickness});
    LightProbe below = test::even_light(glm::vec3(0.0f));
    for (int y = 2; y < 4; ++y)
        for (int x = 0; x < 8; ++x)
            below.radiance.at(x, y) = glm::vec4(1.0f);
    SpectralLight light(below, 1.0);
    light.aim_nowhere();
    const Level seen =
        level_of(test::baked(BakeScene(slab, body_of(grey(scattering), grey(absorption), 1.0, g)), light,
                             top_view(slab, 0.0, 16), {.samples = 256}),
                 9);
    // By walks of its own, none of which is ended by chance.
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    constexpr int paths = 100000;
    double known = 0.0;
    for (int path = 0; path < paths; ++path) {
        double depth = 0.0, cosine = 1.0, flown = 0.0; // down
        while (true) {
            const double flight = -std::log(1.0 - number(random)) / scattering;
            const double beyond = depth + flight * cosine;
            if (beyond > thickness || beyond < 0.0) {
                flown += ((beyond < 0.0 ? 0.0 : thickness) - depth) / cosine;
                // Rows are 45 degrees apart, and between the dark and the light ones is the horizon.
                const double angle = std::acos(cosine) * 180.0 / std::numbers::pi;
                known +=
                    std::exp(-absorption * flown) * std::clamp(0.5 + (90.0 - angle) / 45.0, 0.0, 1.0) / paths;
                break;
            }
            depth = beyond;
            flown += flight;
            const double root = (1.0 - g * g) / (1.0 + g * (1.0 - 2.0 * number(random)));
            const double turn = (1.0 + g * g - root * root) / (2.0 * g);
            cosine = cosine * turn + std::sqrt(std::max(0.0, (1.0 - cosine * cosine) * (1.0 - turn * turn))) *
                                         std::cos(2.0 * std::numbers::pi * number(random));
        }
    }
    CAPTURE(seen.mean, seen.error, known);
    CHECK(seen.mean == Approx(known).margin(3.0 * seen.error + 0.01 * known));
    CHECK(seen.error < 0.03 * known);
    CHECK(known < 0.02);
}

TEST_CASE("light goes through a translucent body as well there as back", "[unit]") {
    const Mesh block = test::box({-100.0, -100.0, -10.0}, {100.0, 100.0, 10.0});
    // Rings about the vertical: the tent of a row, ten degrees to each side.
    const auto ring = [](int row) {
        LightProbe probe{LinearImage({36, 18}), 0};
        for (int x = 0; x < 36; ++x)
            probe.radiance.at(x, row) = glm::vec4(1.0f);
        return probe;
    };
    const auto angle_of = [](int row) { return 10.0 * row + 5.0; };
    const auto weight_of = [&](int row) { // of cosines and solid angle
        double sum = 0.0;
        for (int i = -500; i < 500; ++i) {
            const double angle = to_radians(Degrees{angle_of(row) + (i + 0.5) / 50.0}).value;
            sum += (1.0 - std::abs(i + 0.5) / 500.0) * std::sin(angle) * std::cos(angle);
        }
        return sum;
    };
    for (const bool is_rough : {false, true}) {
        MaterialSettings wax = body_of({1.0, 2.0, 4.0}, {0.1, 0.2, 0.3}, 1.5, 0.5);
        if (is_rough)
            wax.roughness = 0.2;
        const BakeScene scene(block, wax);
        const auto seen = [&](int eye, int light) {
            SpectralLight rings(ring(light), 1.0);
            rings.aim_nowhere();
            return test::baked(scene, rings, top_view(block, angle_of(eye), 16), {.samples = 128});
        };
        constexpr int steep = 2, flat = 5;
        const SpectralFrame there = seen(steep, flat), back = seen(flat, steep);
        for (const std::size_t bin : {5u, 25u}) {
            const Level one = level_of(there, bin), other = level_of(back, bin);
            const double forth = one.mean / weight_of(flat), back_again = other.mean / weight_of(steep);
            const double error = std::hypot(one.error / weight_of(flat), other.error / weight_of(steep));
            CAPTURE(is_rough, bin, forth, back_again, error);
            CHECK(std::abs(forth - back_again) <= 3.0 * error + 0.01 * forth);
            CHECK(error < 0.06 * forth);
        }
    }
}

TEST_CASE("a body twice as large of a medium half as dense is the same picture", "[unit]") {
    Mesh small = test::bust(), large = small;
    for (glm::vec3& position : large.positions)
        position *= 2.0f;
    const double size = small.bounds().extent().z;
    MaterialSettings dense = body_of({5.0 / size, 10.0 / size, 15.0 / size}, grey(0.2 / size), 1.5, 0.3),
                     thin = dense;
    thin.density = 0.5;
    const SpectralLight even(test::even_light({0.2f, 0.5f, 1.0f}), 1.0);
    const SpectralFrame one =
        test::baked(BakeScene(small, dense), even, test::front_view(small, 24), {.samples = 8});
    const SpectralFrame other =
        test::baked(BakeScene(large, thin), even, test::front_view(large, 24), {.samples = 8});
    double difference = 0.0, light = 0.0;
    for (std::size_t i = 0; i < one.radiance.size(); ++i) {
        REQUIRE(std::isfinite(one.radiance[i]));
        difference += std::abs(static_cast<double>(one.radiance[i] - other.radiance[i]));
        light += static_cast<double>(one.radiance[i]);
    }
    CHECK(light > 0.0);
    CHECK(difference < 0.02 * light);
}

TEST_CASE("scattering turns light by Henyey and Greenstein's function", "[unit]") {
    for (const double g : {-0.6, 0.0, 0.0005, 0.3, 0.9}) {
        CAPTURE(g);
        const Medium medium(body_of(grey(1.0), grey(0.0), 1.5, g));
        const glm::vec3 along = glm::normalize(glm::vec3(0.3f, -0.5f, 0.7f));
        constexpr int steps = 400, cells = 20;
        double mean = 0.0, whole = 0.0, of_density = 0.0;
        std::array<double, cells> found{}, known{};
        glm::dvec3 aside(0.0);
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < 16; ++j) {
                const glm::vec3 onward = medium.onward(
                    along, {(static_cast<float>(i) + 0.5f) / steps, (static_cast<float>(j) + 0.5f) / 16.0f});
                REQUIRE(glm::length(onward) == Approx(1.0f).margin(1e-5));
                const auto cosine = static_cast<double>(glm::dot(along, onward));
                mean += cosine / (16.0 * steps);
                aside += glm::dvec3(onward - static_cast<float>(cosine) * along) / (16.0 * steps);
                found[static_cast<std::size_t>(
                    std::clamp((cosine + 1.0) / 2.0 * cells, 0.0, cells - 0.001))] += 1.0 / (16.0 * steps);
            }
        for (int i = 0; i < 20000; ++i) {
            const double cosine = (i + 0.5) / 10000.0 - 1.0,
                         share = 2.0 * std::numbers::pi * Medium::phase(g, cosine) / 10000.0;
            whole += share;
            of_density += cosine * share;
            known[static_cast<std::size_t>(i * cells / 20000)] += share;
        }
        CHECK(mean == Approx(g).margin(2e-3));
        CHECK(whole == Approx(1.0).margin(1e-4));
        CHECK(of_density == Approx(g).margin(1e-4));
        CHECK(glm::length(aside) < 1e-4);
        for (std::size_t i = 0; i < cells; ++i)
            CHECK(found[i] == Approx(known[i]).margin(0.006));
    }
}

TEST_CASE("how far a place is from the surface is what going through its triangles says", "[unit]") {
    Mesh figure;
    test::add_part(figure, test::box({-70.0, -45.0, 40.0}, {70.0, 45.0, 190.0}), "body");
    test::add_part(figure, test::ball({0.0, -10.0, 245.0}, 52.0, 8, 16), "head");
    const TracedSurface traced(figure, glm::dvec3(0.0), 50.0);
    const SurfaceTree tree({&traced});
    std::mt19937 random(3);
    std::uniform_real_distribution<float> number(-1.0f, 1.0f);
    for (int turn = 0; turn < 60; ++turn) {
        const glm::vec3 place(90.0f * number(random), 60.0f * number(random),
                              150.0f + 160.0f * number(random));
        float nearest = std::numeric_limits<float>::infinity(); // by places on each triangle
        for (const glm::uvec3& corners : traced.triangles) {
            const glm::vec3 a = traced.positions[corners.x], b = traced.positions[corners.y],
                            c = traced.positions[corners.z];
            constexpr int steps = 48;
            for (int i = 0; i <= steps; ++i)
                for (int j = 0; i + j <= steps; ++j)
                    nearest = std::min(nearest,
                                       glm::distance(place, a + (static_cast<float>(i) / steps) * (b - a) +
                                                                (static_cast<float>(j) / steps) * (c - a)));
        }
        const float found = tree.clearance(place, 1000.0f);
        CHECK(found <= nearest + 1e-3f);
        CHECK(std::sqrt(found * found + 9.0f) >= nearest - 1e-3f); // their places are 4 apart at most
        CHECK(tree.clearance(place, 0.5f * found) == 0.5f * found);
    }
}

TEST_CASE("a translucent body asks for a closed surface, and for a medium that numbers can follow",
          "[unit]") {
    Mesh open = test::ball({0.0, 0.0, 0.0}, 1.0);
    open.triangles.resize(open.triangles.size() / 2);
    CHECK_THROWS_WITH(BakeScene(open, body_of(grey(1.0), grey(0.0))),
                      Catch::Contains("a translucent body needs a closed surface"));
    const Mesh large = test::ball({0.0, 0.0, 0.0}, 500.0);
    CHECK_THROWS_WITH(BakeScene(large, body_of(grey(900.0), grey(0.0))), Catch::Contains("too often"));
    CHECK_NOTHROW(BakeScene(large, body_of(grey(3.0), grey(0.0))));
}
