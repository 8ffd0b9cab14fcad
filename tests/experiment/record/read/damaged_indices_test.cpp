/// Numbers of a session file that other numbers of it are looked up by.
#include <catch2/catch.hpp>

#include <SQLiteCpp/SQLiteCpp.h>

#include "experiment/base/error.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;

TEST_CASE("an index that leads out of its table is a damage that is named", "[unit]") {
    const TemporaryFolder root;
    const auto session = make_session(root.path(), example_header());
    {
        SessionStore store(session / session_file_name, patient());
        store.trial_started(example_header().schedule.trials[0], at_ms(0));
        for (int refresh = 0; refresh < 3; ++refresh) {
            FlipRecord flip{0, refresh, {0}, {1}, {2}, {}};
            flip.report.vertical_blank = at_ms(100 + 10 * refresh);
            store.flip(flip);
        }
        store.trial_finished(example_header().schedule.trials[0], outcome_at(0));
        store.close();
    }
    const auto read_all = [](const std::filesystem::path& file) {
        const SessionRecord record(file);
        for (const TrialRecord& trial : record.trials())
            record.flips(trial);
    };
    const auto sound = root.path() / "sound.sqlite", damaged = root.path() / "damaged.sqlite";
    std::filesystem::copy_file(session / session_file_name, sound);
    CHECK_NOTHROW(read_all(sound));
    for (const char* const column : {"trial.task",
                                     "trial.object",
                                     "trial.material",
                                     "schedule.task",
                                     "schedule.object",
                                     "schedule.material",
                                     "stimulus.object",
                                     "stimulus.material",
                                     "map.object",
                                     "map.pose",
                                     "trial.motion",
                                     "trial.view",
                                     "schedule.motion",
                                     "schedule.view",
                                     "stimulus.motion",
                                     "stimulus.view",
                                     "map.view",
                                     "animation_frame.motion",
                                     "animation_frame.pose",
                                     "flip.shown",
                                     "flip.planned",
                                     "flip.pose"})
        for (const int index : {-2, 3, 1'000'000}) {
            CAPTURE(column, index);
            std::filesystem::copy_file(sound, damaged, std::filesystem::copy_options::overwrite_existing);
            const std::string name = column;
            const std::size_t dot = name.find('.');
            {
                SQLite::Database database(damaged.string(), SQLite::OPEN_READWRITE);
                database.exec("PRAGMA foreign_keys = OFF; PRAGMA ignore_check_constraints = ON");
                database.exec(fmt::format("UPDATE OR REPLACE {} SET {} = {}", name.substr(0, dot),
                                          name.substr(dot + 1), index));
            }
            CHECK_THROWS_AS(read_all(damaged), RecordError);
        }
    // A frame without a pose.
    std::filesystem::copy_file(sound, damaged, std::filesystem::copy_options::overwrite_existing);
    SQLite::Database(damaged.string(), SQLite::OPEN_READWRITE)
        .exec("DELETE FROM animation_frame WHERE frame = 2");
    CHECK_THROWS_AS(read_all(damaged), RecordError);
}
