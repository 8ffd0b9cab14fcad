/// The pictures of all screens of a session, by the command that writes them.
#include <filesystem>

#include <catch2/catch.hpp>

#include "experiment/session/session_screens.h"
#include "tests/app/small_experiment.h"
#include "tests/experiment/protocol/protocol_fixtures.h"
#include "tests/render/presenter/apart_texts.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("no two texts of any screen of a session meet", "[unit]") {
    const ReadText read(minimal_protocol,
                        "[[material]]\nid = \"clay\"\nkind = \"diffuse\"\n"
                        "[consent]\ntext = \"# Consent\\nDo you agree?\"\n"
                        "[instructions]\npages = [\"One.\", \"Two.\"]\n"
                        "[[observer_field]]\nid = \"age\"\n[[observer_field]]\nid = \"sex\"\n"
                        "[words]\nspace_bar = \"the long key in the lowest row of them all\"\n");
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    int validations = 0;
    for (const glm::ivec2 screen_px : {glm::ivec2(640, 400), glm::ivec2(1920, 1080)}) {
        for (const double letters_deg : {0.3, 0.8, 3.0}) {
            Protocol protocol = *read.protocol;
            protocol.display.width_px = screen_px.x;
            protocol.display.height_px = screen_px.y;
            protocol.screens.text_height_deg = letters_deg;
            for (const auto& [name, screen] : screens::all_of(protocol)) {
                CAPTURE(name, screen_px.x, letters_deg);
                check_texts(draw_screen(screen, screen_geometry_of(protocol), protocol.screens, 0.0),
                            screen_px);
                validations += screen.kind == Screen::Kind::validation ? 1 : 0;
            }
        }
    }
    CHECK(validations == 12);
}

TEST_CASE("check draws every screen of a session, what a validation found and its targets among them",
          "[session]") {
    const SmallExperiment experiment;
    const std::filesystem::path folder = experiment.folder().path() / "screens";
    const ProgramRun run =
        experiment.overt({"check", experiment.protocol().string(), "--screens", folder.string()});
    CHECK(run.exit_code == 0);
    std::string names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names += entry.path().filename().string() + " ";
    CAPTURE(names);
    for (const char* const name : {"_validation.png", "_validation_poor.png", "_calibration_target.png",
                                   "_drift_check_target.png", "_operator_skip.png", "_response.png"})
        CHECK(names.find(name) != std::string::npos);
}
