/// `overt bench analyze` on a session: what it measures is there and can be right.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "experiment/scene/files/ply_writer.h"
#include "tests/app/small_experiment.h"
#include "tests/experiment/surface/flat_and_round.h"

using namespace overt::test;

TEST_CASE("the benchmark of analyses measures a study, voxels and maps", "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run().exit_code == 0);
    const std::filesystem::path ball = experiment.folder().path() / "ball.ply";
    overt::Mesh mesh = icosphere(100.0, 6);
    overt::write_ply(ball, mesh);
    const ProgramRun run = experiment.overt(
        {"bench", "analyze", experiment.session(1).string(), "--mesh", ball.string(), "--json"});
    INFO(run.err << run.out);
    REQUIRE((run.exit_code == 0 || run.exit_code == 1)); // 1: a target is missed on this machine
    std::map<std::string, double> values;
    const auto json = nlohmann::json::parse(run.out);
    for (const auto& figure : json.at("figures")) {
        const auto text = figure.at("figure").get<std::string>();
        values[text] = figure.at("value").get<double>();
        if (text.find("correlation of both") != std::string::npos)
            CHECK(figure.at("value").get<double>() >= 0.995);
        if (text.find("error of the mass") != std::string::npos)
            CHECK(figure.at("value").get<double>() <= 1e-6);
    }
    // Ten trials of a second at 1000 Hz, and what was recorded around them.
    CHECK(values.at("study: gaze samples") > 5000);
    CHECK(values.at("study: sessions to tables, figures and report") > 0.0);
    CHECK(values.at("study: of that, figures and report") <
          values.at("study: sessions to tables, figures and report"));
    CHECK(values.at("study: peak memory") > 10.0);
    int voxels = 0, maps = 0;
    for (const auto& [name, value] : values) {
        voxels += name.starts_with("voxel Gaussian at ");
        maps += name.find("8 maps with sigma 30 mm") != std::string::npos;
    }
    CHECK(voxels >= 1);
    CHECK(maps == 4);
}
