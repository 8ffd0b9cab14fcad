#include <catch2/catch.hpp>

#include "tests/app/small_experiment.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using Catch::Matchers::Contains;

namespace {

constexpr std::string_view bust_line = "mesh = \"meshes/bust.ply\"", tall_line = "mesh = \"meshes/tall.ply\"";

/// A ball whose upper half is the head.
Mesh ball_of(double radius, glm::dvec3 centre) {
    Mesh mesh;
    test::add_part(mesh, test::ball(centre, radius, 60, 120), "body");
    mesh.part_names.emplace_back("head");
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3 corners = mesh.triangles[i];
        const auto height = static_cast<double>(mesh.positions[corners.x].z + mesh.positions[corners.y].z +
                                                mesh.positions[corners.z].z);
        if (height > 3.0 * centre.z)
            mesh.triangle_parts[i] = 1;
    }
    return mesh;
}

/// A line `text` that is to follow another.
std::string followed(std::string_view line, std::string_view text) {
    return std::string(line) + "\n" + std::string(text);
}

} // namespace

TEST_CASE("surface points are in millimetres, be the mesh in centimetres or scaled", "[session]") {
    // One ball of 60 mm about (10, 20, 30) mm in a file in centimetres, one of 90 mm about (0, 0, 45) mm in a
    // file whose lengths are to be multiplied by 30.
    std::string protocol = test::with(test::small_protocol, bust_line, followed(bust_line, "unit = \"cm\""));
    protocol = test::with(protocol, tall_line, followed(tall_line, "scale = 30"));
    const test::SmallExperiment experiment(protocol);
    write_ply(experiment.folder().path() / "meshes/bust.ply", ball_of(6.0, {1.0, 2.0, 3.0}));
    write_ply(experiment.folder().path() / "meshes/tall.ply", ball_of(3.0, {0.0, 0.0, 1.5}));
    const auto run = experiment.run({"--trials", "6"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const auto out = experiment.folder().path() / "tables";
    REQUIRE(experiment.overt({"export", experiment.session().string(), "--out", out.string()}).exit_code ==
            0);
    const test::TsvFile samples(out / "samples.tsv");
    int of_bust = 0, of_tall = 0;
    for (std::size_t row = 0; row < samples.size(); ++row) {
        if (!samples.has(row, "surface_x"))
            continue;
        const bool is_bust = samples.text(row, "object") == "bust";
        const glm::dvec3 centre = is_bust ? glm::dvec3(10.0, 20.0, 30.0) : glm::dvec3(0.0, 0.0, 45.0);
        const double radius = is_bust ? 60.0 : 90.0;
        const glm::dvec3 place(samples.number(row, "surface_x"), samples.number(row, "surface_y"),
                               samples.number(row, "surface_z"));
        // The facets of 60 by 120 lie within 0.2 % of the sphere.
        REQUIRE(glm::distance(place, centre) == Approx(radius).epsilon(2e-3));
        ++(is_bust ? of_bust : of_tall);
    }
    CHECK(of_bust > 100);
    CHECK(of_tall > 100);
    const auto lut = experiment.overt({"lut", experiment.protocol().string(), "--stimulus", "bust/matt",
                                       "--frame", "0", "--format", "png16", "--context", "osmesa", "--out",
                                       (experiment.folder().path() / "luts").string()});
    INFO(lut.err);
    REQUIRE(lut.exit_code == 0);
    bool says_mm = false;
    for (const auto& entry : std::filesystem::directory_iterator(experiment.folder().path() / "luts"))
        if (entry.path().extension() == ".json")
            says_mm = test::text_of(entry.path()).find("\"unit\": \"mm\"") != std::string::npos;
    CHECK(says_mm);
}
