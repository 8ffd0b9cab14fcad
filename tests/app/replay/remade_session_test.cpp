/// Sessions that ran in real time: what of them is made again from their flips and gaze.
#include "tests/app/replay/replayed_session.h"

#include "tests/app/session/interrupted_run.h"
#include "tests/support/hurried_observer.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("of a session in real time all is made again that does not come from devices", "[session][waits]") {
    const SmallExperiment experiment(Cache::own);
    std::vector<std::string> options = hurried(2);
    options.insert(options.end(), {"--trials", "2"});
    REQUIRE(experiment.overt(run_arguments(experiment, "P01", options)).exit_code == 0);
    fs::remove_all(experiment.cache());
    const ProgramRun run = replay(experiment);
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("not presented again, for it ran in real time") &&
                            Contains("the order of 2 trials") && Contains("with the hashes of all frames") &&
                            Contains("found again in the recorded samples") &&
                            Contains("hidden maps drawn again") && Contains("exports in all formats") &&
                            Contains("not compared: flips, samples, answers") &&
                            Contains("the replay is the same"));

    const fs::path pristine = experiment.folder().path() / "pristine.sqlite";
    const fs::path file = experiment.session() / "session.sqlite";
    fs::copy_file(file, pristine);
    const struct {
        std::string sql, named;
    } changes[] = {
        {"UPDATE schedule SET task = (task + 1) % 2 WHERE trial = 1",
         "table schedule, trial 2, task: recorded "},
        {"UPDATE stimulus SET frames_sha256 = lower(hex(zeroblob(32))) WHERE object = 0 AND material = 1",
         "table stimulus, object 0, material 1, light 0, motion 0, view 0, background 0, frames_sha256: "
         "recorded "
         "000"},
        {"UPDATE object SET axis_x = axis_x + 1 WHERE object = 1",
         "table object, object 1, axis_x: recorded "},
        {"UPDATE gaze_event SET end_us = end_us + 1 WHERE trial_id = 2 AND n = 1",
         "table gaze_event, trial 2, eye movement 2, all: recorded "},
        {"UPDATE sample SET x_px = x_px + 100 WHERE trial_id = 1 AND n = 400", "table gaze_event, trial 1, "},
    };
    for (const auto& [sql, named] : changes) {
        fs::copy_file(pristine, file, fs::copy_options::overwrite_existing);
        change(experiment.session(), sql);
        const ProgramRun changed = replay(experiment);
        INFO(sql << "\n" << changed.out << changed.err);
        CHECK(changed.exit_code == 1);
        CHECK_THAT(changed.out, Contains("first difference: " + named));
    }

    // A session of an earlier program does not tell where the meshes lay.
    fs::copy_file(pristine, file, fs::copy_options::overwrite_existing);
    change(experiment.session(), "DELETE FROM run_option");
    const ProgramRun asked = replay(experiment);
    CHECK(asked.exit_code == 2);
    CHECK_THAT(asked.err, Contains("does not say where") && Contains("--files DIR"));
    const ProgramRun earlier = replay(experiment, {"--files", experiment.folder().path().string()});
    INFO(earlier.out << earlier.err);
    CHECK(earlier.exit_code == 0);
    CHECK_THAT(earlier.out, Contains("did not write down the command's options"));
}
