/// A body of glass that is looked at and through, by the commands that a user types.
#include <catch2/catch.hpp>

#include <cmath>
#include <set>

#include "experiment/maps/coordinate_image_file.h"
#include "experiment/units.h"
#include "tests/app/small_experiment.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

const std::string with_glass = with(small_protocol, "id = \"matt\"\nkind = \"diffuse\"\n",
                                    "id = \"crown\"\nkind = \"glass\"\nior = 1.5168\n");

} // namespace

TEST_CASE("samples tell where the line of sight leaves a body of clear glass", "[session]") {
    const SmallExperiment experiment(with_glass);
    const ProgramRun run = experiment.run({"--trials", "4"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const auto tables = experiment.folder().path() / "tables";
    const ProgramRun exported =
        experiment.overt({"export", experiment.session().string(), "--through", "--out", tables.string()});
    INFO(exported.err);
    REQUIRE(exported.exit_code == 0);
    const TsvFile samples(tables / "samples.tsv");
    std::set<std::string> materials;
    int of_metal = 0, of_glass = 0, straight = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        materials.insert(samples.text(i, "material"));
        const bool has_far = samples.has(i, "through_x");
        CHECK(has_far == samples.has(i, "through_triangle"));
        CHECK(has_far == samples.has(i, "through_reflections"));
        if (!samples.has(i, "surface_x") || samples.text(i, "material") != "crown") {
            REQUIRE_FALSE(has_far);
            of_metal += samples.has(i, "surface_x");
            continue;
        }
        of_glass += 1;
        if (!has_far || samples.text(i, "part") != "body" || samples.integer(i, "through_reflections") > 0)
            continue;
        // Into a box by one of its upright walls, x or y, at the angle that Snell's law makes of that
        // outside.
        const glm::dvec3 inside = glm::dvec3(samples.number(i, "through_x"), samples.number(i, "through_y"),
                                             samples.number(i, "through_z")) -
                                  glm::dvec3(samples.number(i, "surface_x"), samples.number(i, "surface_y"),
                                             samples.number(i, "surface_z"));
        const double sine = std::sin(to_radians(Degrees{samples.number(i, "incidence_deg")}).value) / 1.5168;
        const double cosine = std::sqrt(1.0 - sine * sine);
        const glm::dvec3 along = glm::abs(glm::normalize(inside));
        CHECK(std::min(std::abs(along.x - cosine), std::abs(along.y - cosine)) < 1e-5);
        straight += 1;
    }
    CHECK(materials == std::set<std::string>{"crown", "smooth"});
    CHECK(of_metal > 100);
    CHECK(of_glass > 100);
    CHECK(straight > 30);
    // Without the option there are no such columns; with it the dictionary explains them.
    CHECK_THAT(text_of(tables / "dictionary.json"), Contains("bent by Snell's law at 587.6 nm"));
    const auto plain = experiment.folder().path() / "plain";
    REQUIRE(experiment.overt({"export", experiment.session().string(), "--out", plain.string()}).exit_code ==
            0);
    CHECK_THAT(text_of(plain / "samples.tsv"), !Contains("through_x"));
}

TEST_CASE("a map through glass is written with the index that bends it", "[session]") {
    const SmallExperiment experiment(with_glass);
    const auto folder = experiment.folder().path() / "maps";
    const ProgramRun written =
        experiment.overt({"lut", experiment.protocol().string(), "--stimulus", "bust/crown", "--through",
                          "--frame", "3", "--out", folder.string()});
    INFO(written.err);
    REQUIRE(written.exit_code == 0);
    CHECK_THAT(written.out, Contains("pixels of the object have a far side"));
    const auto file = folder / "bust_through_crown_frame_0003.exr";
    const CoordinateImageFile through = read_coordinate_image(file);
    CHECK(through.description.glass_index == 1.5168);
    CHECK(through.image.covered_pixels() > 500);
    REQUIRE(experiment
                .overt({"lut", experiment.protocol().string(), "--stimulus", "bust", "--frame", "3", "--out",
                        folder.string()})
                .exit_code == 0);
    const CoordinateImageFile front = read_coordinate_image(folder / "bust_frame_0003.exr");
    CHECK_FALSE(front.description.glass_index);
    int behind = 0;
    for (int y = 0; y < front.image.size_px.y; ++y) {
        for (int x = 0; x < front.image.size_px.x; ++x) {
            CHECK((!through.image.covers(x, y) || front.image.covers(x, y)));
            behind += through.image.covers(x, y) && through.image.at(x, y).y > front.image.at(x, y).y;
        }
    }
    CHECK(behind > 400);
}

TEST_CASE("what has no line of sight through it is refused to be looked through", "[session]") {
    const SmallExperiment metal(small_protocol);
    REQUIRE(metal.run({"--trials", "1"}).exit_code == 0);
    const auto tables = metal.folder().path() / "tables";
    const ProgramRun exported =
        metal.overt({"export", metal.session().string(), "--through", "--out", tables.string()});
    CHECK(exported.exit_code == 2);
    CHECK_THAT(exported.err, Contains("--through: none of its materials is polished glass"));
    CHECK_FALSE(std::filesystem::exists(tables));
    const ProgramRun written = metal.overt(
        {"lut", metal.protocol().string(), "--stimulus", "bust/matt", "--through", "--frame", "0"});
    CHECK(written.exit_code == 2);
    CHECK_THAT(written.err, Contains("material \"matt\" is no polished glass"));
    CHECK(metal
              .overt({"lut", metal.protocol().string(), "--stimulus", "bust/matt", "--through", "--check",
                      "--frame", "0"})
              .exit_code == 2);
    const SmallExperiment frosted(with(with_glass, "ior = 1.5168\n", "ior = 1.5168\nroughness = 0.2\n"));
    CHECK(frosted
              .overt({"lut", frosted.protocol().string(), "--stimulus", "bust/crown", "--through", "--frame",
                      "0"})
              .exit_code == 2);
}
