/// Stimuli that do not fit into the frame store, through a whole session and in `overt check`.
#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>

#include "tests/app/session/exported_tables.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

const std::string sixty_a_second =
    with(small_protocol, "frame_count = 31\nframe_rate_hz = 30\n", "frame_count = 61\nframe_rate_hz = 60\n");
/// 15 of the 31 pictures fit.
const std::string streamed =
    with(sixty_a_second, "latency_ms = 3.5\n", "latency_ms = 3.5\nframe_store_mb = 1\n");

} // namespace

TEST_CASE("a session whose frames come from disk shows and records what one with room for them does",
          "[session]") {
    const SmallExperiment all_fit(sixty_a_second), few_fit(streamed);
    REQUIRE(all_fit.run({"--trials", "4"}).exit_code == 0);
    const ProgramRun run = few_fit.run({"--trials", "4", "--verify-output"});
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    const Tables expected = exported(all_fit, 1), found = exported(few_fit, 1);
    for (const char* table : {"flips.tsv", "samples.tsv", "trials.tsv", "gaze_events.tsv"}) {
        CAPTURE(table);
        CHECK((expected.at(table) == found.at(table)));
    }
    const ProgramRun replayed = few_fit.overt({"replay", few_fit.session().string()});
    INFO(replayed.out << replayed.err);
    CHECK(replayed.exit_code == 0);
}

TEST_CASE("what comes from disk is told by `check`, with the pace that was measured", "[session]") {
    const SmallExperiment experiment(streamed, Cache::own);
    const ProgramRun before = experiment.overt({"check", experiment.protocol().string(), "--json"});
    INFO(before.err);
    REQUIRE(before.exit_code == 0);
    const auto unrendered = nlohmann::json::parse(before.out);
    CHECK(unrendered.at("design").at("memory").at("streamed_pages_kept") == 15);
    CHECK(unrendered.at("from_disk").at("needed_hz") == 60.0);
    CHECK(unrendered.at("from_disk").at("found_hz").is_null());
    REQUIRE(experiment.run({"--trials", "1"}).exit_code == 0);
    const ProgramRun after = experiment.overt({"check", experiment.protocol().string(), "--json"});
    REQUIRE(after.exit_code == 0);
    const auto rendered = nlohmann::json::parse(after.out);
    CHECK(rendered.at("from_disk").at("found_hz").get<double>() > 0.0);
    CHECK(rendered.at("from_disk").at("disk_mb_s").get<double>() > 0.0);
    const ProgramRun text = experiment.overt({"check", experiment.protocol().string()});
    CHECK_THAT(text.out, Contains("15 pictures are kept on the graphics card"));
    CHECK_THAT(text.out, Contains("pictures a second arrive while it is shown, 60 are needed"));
    // Without streaming nothing is said of it.
    const SmallExperiment fits;
    CHECK_FALSE(nlohmann::json::parse(fits.overt({"check", fits.protocol().string(), "--json"}).out)
                    .contains("from_disk"));
}
