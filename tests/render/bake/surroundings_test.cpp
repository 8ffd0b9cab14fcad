#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/spectra/metal_table.h"
#include "render/bake/coat_surface.h"
#include "render/bake/sample_sequence.h"
#include "tests/render/bake/bake_support.h"

using namespace overt;

namespace {

glm::vec3 any_direction(RandomStream& random) {
    const double z = random.uniform(-1.0, 1.0), azimuth = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double sine = std::sqrt(1.0 - z * z);
    return {static_cast<float>(sine * std::cos(azimuth)), static_cast<float>(sine * std::sin(azimuth)),
            static_cast<float>(z)};
}

void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

} // namespace

TEST_CASE("any colour of a probe comes back from its spectrum", "[unit]") {
    for (const glm::dvec3 colour : {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {0.3, 0.7, 12.0}}) {
        std::array<float, spectral_bins> light{};
        for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
            light[bin] =
                static_cast<float>(colour.x * light_basis()[0][bin] + colour.y * light_basis()[1][bin] +
                                   colour.z * light_basis()[2][bin]);
        }
        CHECK(glm::length(rec709_of_xyz(xyz_of_light(light)) - colour) < 1e-5 * glm::length(colour));
    }
    double y = 0.0;
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        const double white = light_basis()[0][bin] + light_basis()[1][bin] + light_basis()[2][bin];
        y += white * cie1931_xyz()[1][bin];
        // White is D65 itself.
        CHECK(white / illuminant_d65()[bin] ==
              Approx((light_basis()[0][10] + light_basis()[1][10] + light_basis()[2][10]) /
                     illuminant_d65()[10]));
        CHECK(absorbance_basis()[0][bin] + absorbance_basis()[1][bin] + absorbance_basis()[2][bin] ==
              Approx(1.0));
    }
    CHECK(y == Approx(1.0));
}

TEST_CASE("a light turned by its look-up is the light that load_light_probe turns", "[unit]") {
    LightSettings settings;
    settings.rotation_deg = 90.0; // whole texels, so that resampling changes nothing
    const LightProbe turned = load_light_probe(settings);
    const SpectralLight light(settings), turned_already(turned, 1.0);
    RandomStream random(3, "directions");
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 direction = any_direction(random);
        const glm::vec3 a = light.towards(direction, light.share_of_turn({0.0}));
        const glm::vec3 b = turned_already.towards(direction, turned_already.share_of_turn({0.0}));
        CHECK(glm::length(a - b) < 0.02f * (glm::length(a) + 0.05f));
    }
}

TEST_CASE("an object that turns sees its surroundings turn the other way", "[unit]") {
    const SpectralLight light{LightSettings{}};
    RandomStream random(5, "directions");
    const TurntablePose pose{glm::dvec3(0.0), {37.0}};
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 in_object = any_direction(random);
        const glm::vec3 in_world(pose.world_from_object() * glm::dvec4(in_object, 0.0));
        const glm::vec3 a = light.towards(in_object, light.share_of_turn({37.0}));
        const glm::vec3 b = light.towards(in_world, light.share_of_turn({0.0}));
        CHECK(glm::length(a - b) < 0.01f * (glm::length(a) + 0.05f));
    }
}

TEST_CASE("light has no seam round the horizon or at a pole", "[unit]") {
    LightProbe probe{LinearImage({16, 8}), 0};
    RandomStream random(8, "texels");
    for (glm::vec4& pixel : probe.radiance.pixels)
        pixel = glm::vec4(static_cast<float>(random.uniform()));
    const SpectralLight light(probe, 1.0);
    const float turn = light.share_of_turn({0.0});
    for (int i = 0; i < 32; ++i) {
        const float azimuth = 0.196f * static_cast<float>(i), tiny = 1e-4f;
        for (const float pole : {1.0f, -1.0f}) {
            const glm::vec3 side(tiny * std::sin(azimuth), tiny * std::cos(azimuth), pole);
            const float here = light.towards(glm::normalize(side), turn).x;
            const float across = light.towards(glm::normalize(glm::vec3(-side.x, -side.y, pole)), turn).x;
            CHECK(here == Approx(across).margin(2e-3));
        }
    }
    // Behind, where the picture's left and right edge meet.
    CHECK(light.towards({1e-5f, -1.0f, 0.0f}, turn).x ==
          Approx(light.towards({-1e-5f, -1.0f, 0.0f}, turn).x).margin(1e-3));
}

TEST_CASE("negative light of a probe counts as none and is spoken of; what is no number is refused",
          "[unit]") {
    const test::TemporaryFolder folder;
    LinearImage picture({8, 4});
    for (glm::vec4& pixel : picture.pixels)
        pixel = glm::vec4(0.5f);
    picture.at(3, 2) = glm::vec4(-0.08f, 0.1f, 0.1f, 1.0f);
    LightSettings settings;
    settings.probe = (folder.path() / "probe.exr").string();
    write_linear_exr(settings.probe, picture, {});
    const SpectralLight light(settings);
    REQUIRE(light.notes().size() == 1);
    CHECK(light.notes()[0] == "1 of 32 texels of the probe held negative light; it counts as none");

    picture.at(5, 1).y = std::nanf("");
    write_linear_exr(settings.probe, picture, {});
    CHECK_THROWS_WITH(SpectralLight(settings), Catch::Contains("pixel (5, 1)"));
    settings.probe = (folder.path() / "nowhere.exr").string();
    CHECK_THROWS_AS(SpectralLight(settings), InputError);
}

TEST_CASE("a table of a metal is averaged over the bins, and its mistakes are named by line", "[unit]") {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "metal.csv";
    write(file, "# rises with the wavelength\nwavelength_um, n, k\n0.3,0.3,3\n0.8,0.8,8\n");
    const ComplexIndex metal = read_metal_table(file);
    CHECK(metal.n[0] == Approx(0.4));
    CHECK(metal.k[30] == Approx(7.0));
    write(file, "bin,centre_nm,k,n\n0,400,1,2\n1,415,1,2\n");
    CHECK_THROWS_WITH(read_metal_table(file), Catch::Contains("metal.csv:3: the centres must be"));
    write(file, "wavelength_nm,n,k\n390,1,2\n500,x,2\n");
    CHECK_THROWS_WITH(read_metal_table(file), Catch::Contains("metal.csv:3: \"x\" is no number"));
    write(file, "wavelength_nm,n,k\n390,1,2\n500,1,2\n");
    CHECK_THROWS_WITH(read_metal_table(file), Catch::Contains("do not cover 395 to 705 nm"));
    write(file, "wavelength_nm,n\n390,1\n");
    CHECK_THROWS_WITH(read_metal_table(file), Catch::Contains("columns n and k are needed"));
    CHECK_THROWS_WITH(load_metal("Fe"), Catch::Contains("known are Au and Ag"));
}

TEST_CASE("a coat is as thick as asked in the mean, and has other bumps for another seed", "[unit]") {
    const Mesh ball = test::ball({3, 2, 1}, 1.0, 60, 120);
    CoatShape shape{.thickness = 0.02, .bump_height = 0.02, .bump_width = 0.2, .seed = 4};
    const auto thicknesses = [&] {
        double mean = 0.0, least = 1.0, most = 0.0;
        const Mesh coat = coat_over(ball, shape);
        for (const glm::vec3& position : coat.positions) {
            const double thickness = glm::distance(glm::dvec3(position), glm::dvec3(3, 2, 1)) - 1.0;
            mean += thickness / static_cast<double>(coat.positions.size());
            least = std::min(least, thickness);
            most = std::max(most, thickness);
        }
        return std::array{mean, least, most};
    };
    const auto [mean, least, most] = thicknesses();
    CHECK(mean == Approx(0.02).epsilon(0.08));
    CHECK(least >= 0.002 - 1e-3); // the ball's facets lie a little inside
    CHECK(most - least > 0.01);
    CHECK(most - least < 0.03);
    const Mesh one = coat_over(ball, shape);
    CHECK(one.positions == coat_over(ball, shape).positions);
    shape.seed = 5;
    CHECK(one.positions != coat_over(ball, shape).positions);
}

TEST_CASE("a coat is refused on an open mesh and on one that is inside out", "[unit]") {
    const MaterialSettings coated = test::material_of(MaterialKind::coated_conductor);
    Mesh mesh = test::ball({0, 0, 0}, 1.0);
    for (glm::uvec3& corners : mesh.triangles)
        std::swap(corners.y, corners.z);
    CHECK_THROWS_WITH(BakeScene(mesh, coated), Catch::Contains("fronts face inwards"));
    mesh = test::ball({0, 0, 0}, 1.0);
    mesh.triangles.resize(mesh.triangles.size() / 2);
    mesh.triangle_parts.resize(mesh.triangles.size());
    CHECK_THROWS_WITH(BakeScene(mesh, coated), Catch::Contains("edges are open"));
    CHECK_NOTHROW(BakeScene(mesh, test::material_of(MaterialKind::smooth_conductor)));
}

TEST_CASE("the first 2^k samples of a pixel lie in different cells of each of its pairs of dimensions",
          "[unit]") {
    for (const int pixel : {0, 7}) {
        std::vector<int> cells(16 * 16 * 2, 0);
        for (std::uint32_t sample = 0; sample < 256; ++sample) {
            SampleSequence sequence(3, {pixel, 5}, sample);
            for (std::size_t pair = 0; pair < 2; ++pair) {
                const glm::vec2 place = sequence.next_two();
                REQUIRE((place.x >= 0.0f && place.x < 1.0f && place.y >= 0.0f && place.y < 1.0f));
                // The second pair is a net of quality 1 or better: two in a cell at most of 16 x 16 by 256.
                ++cells[pair * 256 + static_cast<std::size_t>(place.x * 16.0f) * 16 +
                        static_cast<std::size_t>(place.y * 16.0f)];
            }
        }
        CHECK(*std::max_element(cells.begin(), cells.begin() + 256) == 1);
        CHECK(*std::max_element(cells.begin() + 256, cells.end()) <= 4);
    }
    // Each single dimension, also beyond the first four, is spread evenly.
    for (int dimension = 0; dimension < 12; ++dimension) {
        std::vector<int> cells(64, 0);
        for (std::uint32_t sample = 0; sample < 64; ++sample) {
            SampleSequence sequence(3, {1, 2}, sample);
            float value = 0.0f;
            for (int i = 0; i <= dimension; ++i)
                value = sequence.next();
            ++cells[static_cast<std::size_t>(value * 64.0f)];
        }
        CHECK(*std::max_element(cells.begin(), cells.end()) == 1);
    }
}
