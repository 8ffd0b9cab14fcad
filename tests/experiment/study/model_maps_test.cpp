/// Predictions of models that are given as files.
#include "experiment/study/model_maps.h"

#include <algorithm>
#include <fstream>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/scene/files/vertex_values.h"
#include "experiment/study/map_predictions.h"
#include "tests/experiment/study/painted_study.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

namespace {

/// A mesh in text with a number at each vertex.
void write_model(const std::filesystem::path& file, const Mesh& mesh, const std::string& property,
                 const std::function<double(glm::dvec3)>& value, double scale = 1.0) {
    std::ofstream out(file);
    out << "ply\nformat ascii 1.0\nelement vertex " << mesh.positions.size()
        << "\nproperty float x\nproperty float y\nproperty float z\nproperty float " << property
        << "\nelement face " << mesh.triangles.size()
        << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const glm::vec3& p : mesh.positions)
        out << scale * p.x << ' ' << scale * p.y << ' ' << scale * p.z << ' ' << value(p) << '\n';
    for (const glm::uvec3& t : mesh.triangles)
        out << "3 " << t.x << ' ' << t.y << ' ' << t.z << '\n';
}

test::PaintedStudy front_study() {
    return {6, 1, 20, [](int, int, RandomStream& random) { return test::near(test::front, 0.3, random); }};
}

double towards_front(glm::dvec3 place) { return std::exp(-glm::length(place - 100.0 * test::front) / 30.0); }

} // namespace

TEST_CASE("a model that knows where gaze goes comes near the ceiling, one that does not stays below 0",
          "[unit]") {
    const test::TemporaryFolder folder;
    test::PaintedStudy study = front_study();
    const Mesh& mesh = *study.results.objects[0].mesh;
    write_model(folder.path() / "right.ply", mesh, "saliency", towards_front);
    write_model(folder.path() / "wrong.ply", mesh, "quality",
                [](glm::dvec3 place) { return towards_front(-place); });
    write_model(folder.path() / "even.ply", mesh, "density", [](glm::dvec3) { return 3.0; });
    study.options.models = {{"", folder.path() / "right.ply"},
                            {"ball", folder.path() / "wrong.ply"},
                            {"", folder.path() / "even.ply"}};
    const ObjectFixationMaps maps = fixation_maps(study.results, study.surfaces);
    const auto models = model_maps(study.results, study.surfaces, study.options);
    REQUIRE(models.size() == 3);
    CHECK(models[1].name == "wrong");
    const auto rows = map_predictions(study.results, maps, study.options, models);
    const auto row = [&](const std::string& level) {
        const auto found = std::ranges::find_if(rows, [&](const MapPredictionRow& one) {
            return one.by == MapPredictor::model && one.level == level;
        });
        REQUIRE(found != rows.end());
        return *found;
    };
    REQUIRE(rows[0].by == MapPredictor::same_level);
    CHECK(*rows[0].share_of_ceiling.value == Approx(1.0));
    CHECK(*row("right").share_of_ceiling.value > 0.7);
    CHECK(*row("right").gain_over_exposure.value > 1.5);
    CHECK(row("right").share_of_ceiling.interval);
    CHECK(*row("right").auc_judd.value > 0.8);
    CHECK(*row("wrong").gain_over_area.value < -1.0);
    CHECK(*row("wrong").share_of_ceiling.value < 0.0);
    CHECK(*row("wrong").nss.value < 0.0);
    CHECK(*row("even").gain_over_area.value == Approx(0.0).margin(0.01));
    CHECK(*row("even").auc_judd.value == Approx(0.5).margin(0.02));
    // All of the ball is exposed alike: times the exposure changes nothing.
    CHECK(*row("right x exposure").nss.value == Approx(*row("right").nss.value));
    CHECK(row("right").observers == 6);
}

TEST_CASE("a model's mesh has the object's place, in millimetres or in its own unit", "[unit]") {
    const test::TemporaryFolder folder;
    test::PaintedStudy study = front_study();
    const Mesh& mesh = *study.results.objects[0].mesh;
    write_model(folder.path() / "elsewhere.ply", mesh, "value", towards_front, 3.0);
    study.options.models = {{"", folder.path() / "elsewhere.ply"}};
    CHECK_THROWS_WITH(model_maps(study.results, study.surfaces, study.options),
                      Catch::Contains("do not lie on the surface of any object"));
    study.options.models = {{"vase", folder.path() / "elsewhere.ply"}};
    CHECK_THROWS_WITH(model_maps(study.results, study.surfaces, study.options),
                      Catch::Contains("no such object; there are ball"));
    // In the mesh's unit, of which the surface is three times as large.
    study.results.objects[0].mm_per_unit = 3.0;
    study.surfaces[0].geometry = std::make_unique<SurfaceGeometry>(mesh, 3.0);
    write_model(folder.path() / "own.ply", mesh, "value", towards_front);
    for (const char* file : {"own.ply", "elsewhere.ply"}) {
        study.options.models = {{"", folder.path() / file}};
        const auto models = model_maps(study.results, study.surfaces, study.options);
        REQUIRE(models.size() == 1);
        for (std::uint32_t v = 0; v < mesh.positions.size(); v += 50)
            CHECK(models[0].by_node[study.surfaces[0].geometry->node_of(v)] ==
                  Approx(towards_front(mesh.positions[v])).epsilon(1e-4));
    }
}

TEST_CASE("files without a number at each vertex are refused with what they have", "[unit]") {
    const test::TemporaryFolder folder;
    test::PaintedStudy study = front_study();
    const Mesh& mesh = *study.results.objects[0].mesh;
    const auto file = folder.path() / "model.ply";
    write_model(file, mesh, "height", towards_front);
    CHECK_THROWS_WITH(read_vertex_values(file), Catch::Contains("have x, y, z, height"));
    write_model(file, mesh, "scalar_model",
                [](glm::dvec3) { return std::numeric_limits<double>::quiet_NaN(); });
    CHECK_THROWS_WITH(read_vertex_values(file), Catch::Contains("must be a number"));
    std::ofstream(file) << "x,y\n";
    CHECK_THROWS_WITH(read_vertex_values(file), Catch::Contains("no PLY file"));
    study.options.models = {{"", file}};
    const auto refused =
        "--model " + file.string() +
        ": value has numbers below 0, or all are 0: give how probable gaze is at each vertex, "
        "per area and on any scale.";
    for (const double other : {0.0, -1.0}) {
        write_model(file, mesh, "value", [&](glm::dvec3 place) { return place.x > 99.0 ? other : 0.0; });
        CHECK_THROWS_WITH(model_maps(study.results, study.surfaces, study.options), refused);
    }
    // Zeros beside others are numbers like these, and so is 1 everywhere.
    for (const double other : {0.0, 1.0}) {
        write_model(file, mesh, "value", [&](glm::dvec3 place) { return place.x > 0.0 ? 1.0 : other; });
        CHECK(model_maps(study.results, study.surfaces, study.options).size() == 1);
    }
}
