/// Keys that are pressed at a question: their names and times in the record and in all that is made of it.
#include <algorithm>
#include <fstream>

#include <SQLiteCpp/SQLiteCpp.h>
#include <catch2/catch.hpp>

#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// 7 in the first trial and 3 in the second, a key that does nothing before the 3, and one at a question.
const std::vector<std::string> seven_and_three{"--trials",
                                               "2",
                                               "--no-pictures",
                                               "--simulate-operator",
                                               "response screen@1+0.4=press 7",
                                               "--simulate-operator",
                                               "response screen@2+0.3=press left shift",
                                               "--simulate-operator",
                                               "response screen@2+0.5=press 3",
                                               "--simulate-operator",
                                               "stimulus@2+0.5=press 9"};

std::vector<RecordedKeyPress> on_response_screens(const SessionRecord& record) {
    std::vector<RecordedKeyPress> presses;
    for (const RecordedKeyPress& press : record.key_presses())
        if (press.screen == SessionPhase::response_screen)
            presses.push_back(press);
    return presses;
}

} // namespace

TEST_CASE("keys pressed at a question for a number are on record with their names and times", "[session]") {
    const SmallExperiment experiment(Cache::own);
    const ProgramRun run = experiment.run(seven_and_three);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const SessionRecord record(experiment.session());
    REQUIRE(record.trials().size() == 2);
    const std::vector<RecordedKeyPress> presses = on_response_screens(record);
    REQUIRE(presses.size() == 3);
    const char* const names[] = {"7", "left shift", "3"};
    const double after_s[] = {0.4, 0.3, 0.5};
    for (std::size_t i = 0; i < 3; ++i) {
        const TrialRecord& trial = record.trials()[i == 0 ? 0 : 1];
        CHECK(presses[i].name == names[i]);
        CHECK(presses[i].device == "simulated observer");
        CHECK(presses[i].meaning == (i == 1 ? "" : "next"));
        CHECK(presses[i].trial == trial.trial.index);
        CHECK(presses[i].attempt_id == trial.id);
        // The phase begins at the refresh before the screen is lit.
        CHECK(to_seconds(presses[i].at - trial.outcome.response_screen_onset) ==
              Approx(after_s[i]).margin(0.02));
    }
    CHECK(presses[0].at == record.trials()[0].outcome.responded_at);
    CHECK(record.trials()[0].response_key == "7");
    CHECK(record.trials()[1].response_key == "3");
    // Each question was left by a key, too, and what is pressed at a stimulus does nothing.
    const auto all = record.key_presses();
    CHECK(std::ranges::count(all, SessionPhase::task_screen, &RecordedKeyPress::screen) == 2);
    const auto at_stimulus = std::ranges::find(all, SessionPhase::stimulus, &RecordedKeyPress::screen);
    REQUIRE(at_stimulus != all.end());
    CHECK(at_stimulus->name == "9");
    CHECK(at_stimulus->meaning.empty());
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);

    // Tables, BIDS, and the tracker's own format.
    const fs::path out = experiment.folder().path();
    const auto exported = [&](const std::string& format) {
        REQUIRE(experiment
                    .overt({"export", experiment.session().string(), "--format", format, "--out",
                            (out / format).string()})
                    .exit_code == 0);
        return out / format;
    };
    const TsvFile presses_table(exported("tsv") / "key_presses.tsv");
    REQUIRE(presses_table.size() == all.size());
    const TsvFile responses(out / "tsv/responses.tsv");
    CHECK(responses.text(0, "response_key") == "7");
    CHECK(responses.text(1, "response_key") == "3");
    const std::string asc = [&] {
        for (const auto& file : fs::directory_iterator(exported("asc")))
            if (file.path().extension() == ".asc")
                return text_of(file.path());
        return std::string();
    }();
    CHECK_THAT(asc, Contains(" KEY 7\n") && Contains(" KEY 3\n"));
    std::string events;
    for (const auto& file : fs::recursive_directory_iterator(exported("bids")))
        if (file.path().filename().string().ends_with("run-01_events.tsv") &&
            file.path().string().find("derivatives") == std::string::npos)
            events = text_of(file.path());
    CHECK_THAT(events, Contains("\tkey\t"));

    const ProgramRun replayed = experiment.overt({"replay", experiment.session().string()});
    INFO(replayed.out);
    CHECK(replayed.exit_code == 0);
}

TEST_CASE("a key press that is changed afterwards is found, and named", "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run(seven_and_three).exit_code == 0);
    {
        SQLite::Database database((experiment.session() / "session.sqlite").string(), SQLite::OPEN_READWRITE);
        database.exec("UPDATE key_press SET name = '6' WHERE name = '7'");
    }
    const ProgramRun verified = experiment.overt({"verify", experiment.session().string()});
    CHECK(verified.exit_code == 1);
    CHECK_THAT(verified.out, Contains("key_press"));
}

TEST_CASE("a session of a program that knew no key presses is read, exported and gone on with", "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run({"--trials", "2", "--no-pictures", "--simulate-operator", "stimulus@2+0.2=abort"})
                .exit_code == 1);
    {
        SQLite::Database database((experiment.session() / "session.sqlite").string(), SQLite::OPEN_READWRITE);
        for (const char* const table : {"key_press", "trial_gaze"})
            database.exec(std::string("DROP TABLE ") + table);
    }
    const SessionRecord before(experiment.session());
    CHECK(before.key_presses().empty());
    CHECK_FALSE(before.trials().front().outcome.gaze);
    const fs::path tables = experiment.folder().path() / "tables";
    REQUIRE(experiment.overt({"export", experiment.session().string(), "--out", tables.string()}).exit_code ==
            0);
    CHECK(TsvFile(tables / "key_presses.tsv").size() == 0);
    // Of what came, where nobody wrote down what should have come.
    CHECK(TsvFile(tables / "trials.tsv").number(0, "gaze_share") > 0.5);
    REQUIRE(experiment.run({"--trials", "2", "--no-pictures", "--resume", "redo"}).exit_code == 0);
    const SessionRecord after(experiment.session());
    CHECK_FALSE(after.key_presses().empty());
    CHECK(after.trials().back().outcome.gaze);
}
