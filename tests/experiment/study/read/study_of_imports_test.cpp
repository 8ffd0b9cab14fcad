/// Sessions that know of no stimulus, as imported recordings do: their areas of the screen, and what
/// is said of them.
#include <algorithm>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/gaze_rows.h"
#include "experiment/record/session_schema.h"
#include "experiment/study/read/study_reader.h"
#include "experiment/study/read/trial_screen_areas.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;

namespace {

/// Three trials, of which the second is no trial proper.
SessionHeader imported_header(const std::string& observer) {
    SessionHeader header = example_header();
    header.schedule.observer.label = observer;
    header.schedule.trials.resize(3);
    header.schedule.trials[1].role = TrialRole::catch_trial;
    header.schedule.trials[2].stimulus = header.schedule.trials[0].stimulus;
    header.tracker.eye = Eye::right;
    header.stimuli.clear();
    header.maps.clear();
    for (RecordedObject& object : header.objects)
        object.mesh_file.clear();
    return header;
}

struct ImportedMessage {
    int trial; ///< from 1
    int after_ms;
    std::string text;
};

/// Gaze of 250 Hz from 0.1 s after the begin of each trial, 0.4 s long; a fixation of 0.25 s, of which the
/// last trial's ends after its last sample. Nothing tells when something was shown, or how long.
fs::path imported_session(const fs::path& root, const SessionHeader& header,
                          const std::vector<ImportedMessage>& messages = {}, bool has_source = true,
                          bool has_events = true) {
    const fs::path session = make_session(root, header);
    {
        SessionStore store(session / session_file_name, patient());
        const auto tracker_at = [](std::int64_t ms) { return tracker_time(7'000'000 + 1000 * ms); };
        for (const std::int64_t second : {0, 100})
            store.clock_pair({at_ms(1000 * second), tracker_at(1000 * second), at_ms(1000 * second)});
        for (const Trial& trial : header.schedule.trials) {
            const std::int64_t begin_ms = 10'000 * (trial.index + 1);
            store.trial_started(trial, at_ms(begin_ms));
            for (int ms = 100; ms <= 500; ms += 4)
                store.sample(trial.index,
                             {tracker_at(begin_ms + ms), Eye::right, ScreenPoint{300.0, 200.0}, 9.0f});
            if (has_events) {
                TrackerEvent event;
                event.start = tracker_at(begin_ms + 200 + 100 * trial.index);
                event.end = tracker_at(begin_ms + 446 + 100 * trial.index);
                event.duration = std::chrono::milliseconds(250);
                event.place = ScreenPoint{300.0, 200.0};
                store.tracker_item(trial.index, event);
            }
            TrialOutcome outcome;
            outcome.presentation_onset = outcome.presentation_end = outcome.task_screen_onset =
                outcome.response_screen_onset = outcome.responded_at = at_ms(begin_ms - 1);
            store.trial_finished(trial, outcome);
        }
        store.close();
    }
    SQLite::Database database((session / session_file_name).string(), SQLite::OPEN_READWRITE);
    int n = 1000;
    for (const ImportedMessage& message : messages)
        database.exec(
            fmt::format("INSERT INTO gaze_event (trial_id, n, kind, start_us, end_us, duration_us, text) "
                        "VALUES ({}, {}, 'message', {}, {}, 0, '{}')",
                        message.trial, ++n, 7'000'000 + 1000 * (10'000 * message.trial + message.after_ms),
                        7'000'000 + 1000 * (10'000 * message.trial + message.after_ms), message.text));
    if (has_source)
        database.exec("INSERT INTO gaze_source VALUES (1, 'a.asc', '" + header.schedule.observer.label +
                      "', '', 'area', 250, 'right', 1, 1, 0)");
    return session;
}

StudyResults study_of_imports(const std::vector<fs::path>& sessions, const StudyOptions& options = {}) {
    return read_study(
               sessions,
               [](const SessionRecord&, std::size_t, const ViewedObject&) -> const SurfaceLookup* {
                   return nullptr;
               },
               options, [](std::string_view, int, int) {})
        .results;
}

bool has_remark(const StudyResults& results, const std::string& wanted) {
    return std::ranges::count(results.remarks, wanted) == 1;
}

std::string area_names_of(const std::vector<std::vector<ScreenArea>>& trials) {
    std::string all;
    for (const std::vector<ScreenArea>& areas : trials) {
        all += "|";
        for (const ScreenArea& area : areas)
            all += " " + area.name;
    }
    return all;
}

const std::string no_file_of_areas =
    "No area of the screen is known: analyze takes a file of them with --areas, and "
    "messages \"!V IAREA\" of a recording.";

std::string not_computed_of(const std::string& who) {
    return who +
           " of no stimulus, as imported recordings do: fixations with their places on the screen, "
           "the "
           "quality of gaze, and trials are in the tables fixations, quality and trials, what gaze did with "
           "areas of the screen in screen_areas, where there are any; saccades and blinks are in the "
           "exports. Maps, shares of parts, comparisons of conditions on a surface, gaze on a moving surface "
           "and light at gaze were not computed of them: that takes the object that was shown, and when.";
}

} // namespace

TEST_CASE("a trial that tells no times lasts from its begin to its last sample or event", "[unit]") {
    const TemporaryFolder root;
    const StudyResults results = study_of_imports({imported_session(root.path(), imported_header("P1"))});
    REQUIRE(results.trials.size() == 2);
    CHECK(results.trials[0].number == 1);
    CHECK(results.trials[1].number == 3);
    CHECK(results.trials[0].presentation_s == Approx(0.5));
    CHECK(results.trials[1].presentation_s == Approx(0.65));
    REQUIRE(results.fixations.size() == 2);
    CHECK(results.fixations[0].why == NotCounted::no_stimulus);
    CHECK(results.fixations[0].onset_s == Approx(0.2));
    CHECK(results.fixations[0].duration_s == Approx(0.25));
    CHECK(results.fixations[0].place.x_px == Approx(300.0));
    CHECK(results.trials[0].has_gaze);
    CHECK(results.glance.samples == 2 * 101);
    CHECK(results.traces.size() == 2);
    // Objects of which nothing is known need no word of their own.
    CHECK(results.remarks == std::vector{not_computed_of("sub-P1_ses-01 knows"), no_file_of_areas});
}

TEST_CASE("sessions without a stimulus are named up to five, and counted from six on", "[unit]") {
    const TemporaryFolder root;
    std::vector<fs::path> sessions;
    std::string named;
    for (int i = 1; i <= 6; ++i) {
        const std::string observer = "P" + std::to_string(i);
        SessionHeader header = imported_header(observer);
        header.schedule.trials.resize(1);
        sessions.push_back(imported_session(root.path(), header));
        named += (i == 1 ? "sub-" : ", sub-") + observer + "_ses-01";
        CAPTURE(i);
        if (i != 3 && i != 4)
            CHECK(has_remark(study_of_imports(sessions), not_computed_of(i == 1  ? named + " knows"
                                                                         : i < 6 ? named + " know"
                                                                                 : "6 sessions know")));
    }
}

TEST_CASE("areas that messages tell are of their trial, from when they say", "[unit]") {
    const TemporaryFolder root;
    const fs::path session = imported_session(root.path(), imported_header("P1"),
                                              {{1, 100, "!V IAREA RECTANGLE 1 10 20 110 220 face"},
                                               {1, 120, "!V IAREA -50 -250 ELLIPSE 2 10 20 110 220 ball"},
                                               {1, 130, "something else"},
                                               {2, 100, "!V IAREA RECTANGLE 1 10 20 110 220 caught"},
                                               {2, 100, "!V IAREA RECTANGLE nonsense"},
                                               {3, 100, "!V IAREA RECTANGLE 1 10 20 110 220 last"}});
    const StudyResults results = study_of_imports({session});
    REQUIRE(area_names_of(results.screen_areas) == "| face ball| last");
    CHECK(results.screen_areas[0][0].from_s == 0.0);
    CHECK(results.screen_areas[0][1].from_s == Approx(0.17));
    CHECK(results.screen_areas[0][1].until_s == Approx(0.37));
    CHECK(results.screen_areas[0][1].points[1] == ScreenPoint{110.0, 220.0});
    CHECK(results.remarks == std::vector{not_computed_of("sub-P1_ses-01 knows")});
    // Of a session whose gaze is its own tracker's, messages are no areas.
    const fs::path own = imported_session(root.path(), imported_header("P2"),
                                          {{1, 100, "!V IAREA RECTANGLE 1 10 20 110 220 face"}}, false);
    CHECK(study_of_imports({own}).screen_areas.empty());
}

TEST_CASE("areas of a file are of the trials that it names, whatever trials were no trials proper",
          "[unit]") {
    const TemporaryFolder root;
    const fs::path session = imported_session(root.path(), imported_header("P1"),
                                              {{3, 100, "!V IAREA RECTANGLE 1 10 20 110 220 last"}});
    StudyOptions options;
    options.screen_areas_file = "areas.csv";
    const auto area = [](const char* name) {
        return ScreenArea{name, ScreenArea::Shape::rectangle, {{0.0, 0.0}, {9.0, 9.0}}};
    };
    options.screen_areas = {{area("all"), {}},
                            {area("third"), {{"trial", "3"}}},
                            {area("first"), {{"trial", "1"}, {"observer", "P1"}}},
                            {area("none"), {{"trial", "1"}, {"observer", "P9"}}}};
    CHECK(area_names_of(study_of_imports({session}, options).screen_areas) == "| all first| last all third");
    options.screen_areas.push_back({area("wrong"), {{"colour", "red"}, {"trial", "1"}, {"size", "8"}}});
    options.screen_areas.push_back({area("wrong"), {{"colour", "blue"}}});
    CHECK_THROWS_WITH(study_of_imports({session}, options),
                      "areas.csv: no trial has a column colour, size: an area is of "
                      "the trials that have the same word there");
}

TEST_CASE("messages that cannot be read, and files that they name, are said with the first", "[unit]") {
    const TemporaryFolder root;
    const ImportedMessage bad{1, 100, "!V IAREA RECTANGLE 1 10 20"},
        worse{3, 100, "!V IAREA CIRCLE 1 2 3 4 5"}, file{1, 110, "!V IAREA FILE one.ias"},
        other{3, 110, "!V IAREA FILE two.ias"};
    const StudyResults one =
        study_of_imports({imported_session(root.path(), imported_header("P1"), {bad, file, file})});
    const auto starts = [](const StudyResults& results, const std::string& begin, const std::string& end) {
        return std::ranges::count_if(results.remarks, [&](const std::string& remark) {
                   return remark.starts_with(begin) && remark.ends_with(end);
               }) == 1;
    };
    CHECK(starts(one,
                 "A message on areas of the screen cannot be read and is left out; the first is \"!V IAREA "
                 "RECTANGLE 1 "
                 "10 20\": ",
                 "."));
    CHECK(has_remark(
        one, "Recordings name a file with areas of the screen, such as one.ias: give such a file with "
             "--areas."));
    CHECK(has_remark(one, no_file_of_areas));
    const fs::path several = imported_session(root.path(), imported_header("P2"), {bad, worse, file, other});
    const StudyResults two = study_of_imports({several});
    CHECK(starts(two,
                 "2 messages on areas of the screen cannot be read and are left out; the first is \"!V IAREA "
                 "RECTANGLE "
                 "1 10 20\": ",
                 "."));
    CHECK(has_remark(
        two, "Recordings name 2 files with areas of the screen, such as one.ias: give such a file with "
             "--areas."));
    // With a file given, nobody needs to be told of another.
    StudyOptions options;
    options.screen_areas = {{{"all", ScreenArea::Shape::rectangle, {{0.0, 0.0}, {9.0, 9.0}}}, {}}};
    for (const std::string& remark : study_of_imports({several}, options).remarks)
        CHECK(remark.find("give such a file") == std::string::npos);
}

TEST_CASE("fixations of imports without any are found in each trial, whoever reads it", "[unit]") {
    const TemporaryFolder root;
    const StudyResults results =
        study_of_imports({imported_session(root.path(), imported_header("P1"), {}, true, false)});
    REQUIRE(results.trials.size() == 2);
    for (const StudyTrial& trial : results.trials) {
        CHECK(trial.fixations == 1);
        CHECK(results.fixations[trial.first_fixation].duration_s == Approx(0.4).margin(0.03));
    }
}

TEST_CASE("variables that messages give a trial are columns of it", "[unit]") {
    const TemporaryFolder root;
    const StudyResults results = study_of_imports(
        {imported_session(root.path(), imported_header("P1"),
                          {{1, 90, "!V TRIAL_VAR colour red"}, {3, 90, "!V TRIAL_VAR colour blue"}})});
    CHECK(results.trials.at(0).key("var_colour") == "red");
    CHECK(results.trials.at(1).key("var_colour") == "blue");
}
