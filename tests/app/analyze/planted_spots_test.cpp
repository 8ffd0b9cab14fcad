/// Spots planted in the gaze of simulated observers, through whole sessions: where a material draws gaze to
/// one place of the surface, the maps differ there, and nowhere else.
#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "app/inputs/protocol_inputs.h"
#include "devices/simulated/gaze_targets.h"
#include "tests/app/small_experiment.h"
#include "tests/support/tsv_file.h"

namespace fs = std::filesystem;
using namespace overt;
using namespace overt::test;

namespace {

/// Two questions about two busts in two materials; half of the fixations on matt ones go to a spot.
std::string spot_protocol() {
    std::string text = with(small_protocol, "duration_s = 1\n", "duration_s = 8\n");
    text = with(text, "rate_hz = 1000\n", "rate_hz = 500\nsimulated_accuracy_deg = 0.25\n");
    text = text.substr(0, text.find("[[task]]"));
    for (const std::string id : {"shape", "gloss"})
        text +=
            "[[task]]\nid = \"" + id + "\"\nquestion = \"What is it like?\"\nsimulated_head_share = 0.3\n\n";
    return text + "[[simulated_effect]]\nmaterial = \"matt\"\nspot_share = 0.5\n";
}

/// The middle of the spot that the effect has on each object, in the mesh's unit.
std::vector<glm::dvec3> planted_spots(const SmallExperiment& experiment) {
    Diagnostics diagnostics;
    const auto read =
        read_experiment(experiment.protocol(), experiment.cache(), InputDepth::everything, diagnostics);
    INFO(diagnostics.print());
    REQUIRE(read);
    const ObservedScene scene =
        make_observed_scene(read->protocol, read->objects, screen_geometry_of(read->protocol));
    std::vector<glm::dvec3> spots;
    for (const ObservedObject& object : scene.objects) {
        const GazeTargets targets(object, scene);
        RandomStream random(1, "middle of a spot");
        glm::dvec3 sum(0.0);
        for (int i = 0; i < 1000; ++i)
            sum += glm::dvec3(targets.draw_from_spot(random, 0).position);
        spots.push_back(sum / 1000.0);
    }
    return spots;
}

} // namespace

TEST_CASE("a spot that a material draws gaze to comes back through whole sessions where it was planted",
          "[session]") {
    const SmallExperiment experiment(spot_protocol());
    const fs::path study = experiment.folder().path() / "study";
    const ProgramRun run = experiment.overt({"replicate", experiment.protocol().string(), "--context",
                                             "osmesa", "--observers", "8", "--out", study.string()});
    INFO(run.err << run.out);
    REQUIRE(run.exit_code == 0);
    const std::vector<glm::dvec3> spots = planted_spots(experiment);
    const auto analyzed = [&](const std::string& compare) {
        fs::path out = study / compare;
        std::vector<std::string> arguments{"analyze", "--compare", compare,     "--format",
                                           "tsv",     "--out",     out.string()};
        for (int observer = 1; observer <= 8; ++observer)
            arguments.push_back((study / fmt::format("sessions/small/sub-{:02}_ses-01", observer)).string());
        REQUIRE(experiment.overt(arguments).exit_code == 0);
        return out;
    };
    const fs::path analysis = analyzed("material");

    // Lengths of an analysis are those that the objects seem to have at the screen's distance.
    const auto json = nlohmann::json::parse(text_of(analysis / "study.json"));
    const TsvFile clusters(analysis / "difference_clusters.tsv");
    std::array<int, 2> found{};
    for (std::size_t row = 0; row < clusters.size(); ++row) {
        if (clusters.text(row, "compared") != "material" || clusters.text(row, "task") != "all" ||
            !clusters.has(row, "p") || clusters.number(row, "p") > 0.05)
            continue;
        const std::size_t bust = clusters.text(row, "on_object") == "bust" ? 0 : 1;
        // Smooth is the first level: gaze of matt ones is what is more there.
        if (clusters.number(row, "difference") > 0.0)
            continue;
        const glm::dvec3 spot = json.at("objects").at(bust).at("mm_per_unit").get<double>() * spots[bust];
        const glm::dvec3 centre(clusters.number(row, "x_mm"), clusters.number(row, "y_mm"),
                                clusters.number(row, "z_mm"));
        CAPTURE(bust, centre.x, centre.y, centre.z, spot.x, spot.y, spot.z);
        // A cluster reaches as far as the kernel smooths the maps, about the width of a head: its centre lies
        // nearer to the spot than that, on busts of five heads' height.
        const double shown_size = json.at("objects").at(bust).at("shown_size");
        CHECK(shown_size * glm::distance(centre, spot) < 8.0); // as seen
        ++found[bust];
    }
    CHECK(found == std::array{1, 1});

    // The maps of all observers differ between materials, and not between questions that are looked at alike.
    const auto p_of_maps = [](const fs::path& of, const std::string& other) {
        const TsvFile pairs(of / "table1_pairs.tsv");
        for (std::size_t row = 0; row < pairs.size(); ++row) {
            if (pairs.text(row, other) == "all")
                return pairs.number(row, "maps_p");
        }
        return -1.0;
    };
    CHECK(p_of_maps(analysis, "task") == Approx(2.0 / 256.0).epsilon(0.5));
    const fs::path tasks = analyzed("task");
    CHECK(p_of_maps(tasks, "material") > 0.05);
    const TsvFile none(tasks / "difference_clusters.tsv");
    for (std::size_t row = 0; row < none.size(); ++row) {
        if (none.text(row, "material") == "all" && none.has(row, "p"))
            CHECK(none.number(row, "p_of_all") > 0.05);
    }
}
