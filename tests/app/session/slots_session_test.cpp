/// A session that shows four stimuli at once, by the commands that a user types.
#include <catch2/catch.hpp>

#include <map>
#include <string>

#include "experiment/record/read/session_record.h"
#include "tests/app/session/interrupted_run.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;

namespace {

/// A large one, and three smaller ones on a circle about it.
std::string four_of_two_sizes() {
    std::string text = with(small_protocol, "duration_s = 1", "duration_s = 8");
    for (const char* const task : {"id = \"face\"", "id = \"clothes\"", "id = \"free\""})
        text = with(text, task, std::string(task) + "\nslots = [\"middle\", \"ring\"]");
    return text + "\n[[slot]]\nid = \"middle\"\nsize_deg = 3\n"
                  "[[slot]]\nid = \"ring\"\ncircle = 3\nradius_deg = 3.2\nsize_deg = 2.2\n";
}

} // namespace

TEST_CASE("four stimuli of two sizes are shown, recorded, resumed, replayed, exported and analysed",
          "[session]") {
    const SmallExperiment experiment(four_of_two_sizes());
    const ProgramRun check = experiment.overt({"check", experiment.protocol().string()});
    CAPTURE(check.out, check.err);
    REQUIRE(check.exit_code == 0);
    // Killed in its fourth trial, and taken up again.
    const std::vector<std::string> arguments = run_arguments(experiment, "P01", {"--virtual-time"});
    REQUIRE(run_and_kill(experiment, arguments,
                         [&] { return attempts_so_far(experiment.session()).size() >= 4; }));
    std::vector<std::string> again = arguments;
    again.insert(again.end(), {"--resume", "redo"});
    const ProgramRun resumed = experiment.overt(again);
    CAPTURE(resumed.out, resumed.err);
    REQUIRE(resumed.exit_code == 0);
    const std::string session = experiment.session().string();
    const SessionRecord record(session);
    CHECK(record.is_complete());
    REQUIRE(record.header().slots.size() == 4);
    CHECK(record.header().slots[1].id == "ring-1");
    CHECK(record.header().slots[0].size_px.x > record.header().slots[1].size_px.x);
    CHECK(record.header().objects[0].cameras.size() == 2);
    const std::vector<TrialRecord> presentations = record.presentations();
    REQUIRE(presentations.size() == 4 * record.trials().size());
    for (const TrialRecord& seen : presentations) {
        CHECK(seen.trial.slot == seen.place);
        if (!seen.counts)
            continue;
        const std::vector<FlipRecord> flips = record.flips(seen);
        CHECK(flips.size() == 960);
        for (const FlipRecord& flip : flips)
            CHECK(flip.shown == flip.planned);
    }
    CHECK(experiment.overt({"verify", session}).exit_code == 0);
    const ProgramRun replay = experiment.overt({"replay", session});
    CAPTURE(replay.out, replay.err);
    CHECK(replay.exit_code == 0);

    const std::filesystem::path tables = experiment.folder().path() / "tables";
    REQUIRE(experiment.overt({"export", session, "--out", tables.string()}).exit_code == 0);
    const TsvFile samples(tables / "samples.tsv");
    std::map<std::string, int> on_surface;
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (samples.has(i, "surface_x"))
            ++on_surface[samples.text(i, "slot")];
    CHECK(on_surface.size() == 4);
    for (const auto& [slot, count] : on_surface)
        CHECK(count > 100);

    // Each slot is an interest area for as long as it was lit.
    const std::filesystem::path asc = experiment.folder().path() / "asc";
    REQUIRE(experiment.overt({"export", session, "--format", "asc", "--out", asc.string()}).exit_code == 0);
    std::string messages;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(asc))
        if (entry.path().extension() == ".asc")
            messages += text_of(entry.path());
    std::size_t areas = 0;
    for (std::size_t place = messages.find("!V IAREA 0 -8000 RECTANGLE"); place != std::string::npos;
         place = messages.find("!V IAREA 0 -8000 RECTANGLE", place + 1))
        ++areas;
    CHECK(areas == 4 * small_trials);
    CHECK(messages.find("!V IAREA RECTANGLE") == std::string::npos);

    const std::filesystem::path study = experiment.folder().path() / "study";
    const ProgramRun analysis =
        experiment.overt({"analyze", session, "--by", "slot", "--format", "tsv", "--out", study.string()});
    CAPTURE(analysis.out, analysis.err);
    REQUIRE(analysis.exit_code == 0);
    const TsvFile trials(study / "trials.tsv");
    CHECK(trials.size() == 4 * small_trials);
}

TEST_CASE("a session with one stimulus has its ledger alone", "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run({"--trials", "1"}).exit_code == 0);
    const SessionRecord record(experiment.session());
    REQUIRE(record.header().slots.size() == 1);
    CHECK(record.header().slots[0].id == "centre");
    CHECK(record.header().slots[0].origin_px == record.header().display.screen.image_origin_px);
    const TrialRecord& trial = record.trials().front();
    CHECK(record.presentations().front().trial == trial.trial);
    TrialRecord further = trial;
    further.place = 1;
    for (const FlipRecord& flip : record.flips(further))
        CHECK(flip.shown == no_frame);
}
