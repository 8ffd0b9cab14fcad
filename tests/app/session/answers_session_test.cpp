/// Sessions in which keys answer: what is recorded of it, that planted truth comes back, that a killed one
/// goes on, and that all comes out the same when it is presented again.
#include "tests/app/session/interrupted_run.h"

#include <algorithm>

#include "experiment/base/safe_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/read/pointed_answer.h"
#include "tests/app/replay/replayed_session.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// The small experiment with one task, which is answered so.
std::string answered(std::string_view steps, std::string_view answers) {
    std::string text(small_protocol);
    text.resize(text.find("[[task]]"));
    return text + "[[task]]\nid = \"judge\"\nquestion = \"Judge it.\"\nsteps = [\n" + std::string(steps) +
           "]\n" + std::string(answers);
}

constexpr std::string_view judged_steps = R"(
  { fixation = 0.3 },
  { show = "centre", for_s = 0.5, until = "answer" },
  { answer = "seen", limit_s = 1 },
  { answer = ["gloss", "sure"] },
)";
constexpr std::string_view judgements = R"(
[[task.answer]]
id = "seen"
kind = "choice"
choices = ["metal", "stone"]
keys = ["f", "j"]
correct = "metal"
limit_s = 1
mapping = "crossed"
simulated = { share_correct = 0.75, median_s = 0.35, shift_s = 0.1, early = 0.5, missing = 0.25 }

[[task.answer]]
id = "gloss"
kind = "scale"
question = "How glossy?"
steps = 7
ends = ["matt", "glossy"]
of = ["body", "head"]
order = "drawn"
accept = "at-once"

[[task.answer]]
id = "sure"
kind = "scale"
question = "How sure?"
ends = ["not at all", "very"]
)";

} // namespace

TEST_CASE("answers by keys are recorded, exported and presented again", "[session]") {
    const SmallExperiment experiment(answered(judged_steps, judgements));
    const ProgramRun run = experiment.run();
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const SessionRecord record(experiment.session());
    REQUIRE(record.trials().size() == 4);
    int missed = 0, before = 0, of_mapping[2] = {};
    for (const TrialRecord& trial : record.trials()) {
        const std::vector<GivenAnswer>& given = trial.outcome.given;
        CAPTURE(trial.trial.index);
        REQUIRE(given.size() == 4);
        CHECK(given[0].id == "seen");
        CHECK(given[1].id == "gloss");
        CHECK(given[1].item != given[2].item);
        CHECK(given[3].id == "sure");
        ++of_mapping[given[0].mapping];
        missed += given[0].is_missed ? 1 : 0;
        CHECK(given[0].stimulus_onset == trial.outcome.presentation_onset);
        if (!given[0].is_missed) {
            CHECK(given[0].zero == AnswerZero::stimulus);
            CHECK(given[0].key == ((given[0].value == "metal") == (given[0].mapping == 0) ? "f" : "j"));
            CHECK(given[0].is_correct == (given[0].value == "metal"));
            CHECK(*given[0].answered_at <= *given[0].window_end);
            CHECK(*given[0].response_time() > from_seconds(0.1));
        }
        for (std::size_t i = 1; i < 4; ++i) {
            CHECK_FALSE(given[i].is_missed);
            CHECK_FALSE(given[i].is_correct);
            CHECK(*given[i].answered_at > *given[i].screen_onset);
        }
        CHECK(given[3].number.has_value());
        for (const AnswerInput& input : trial.outcome.inputs)
            before += input.state == InputState::before && input.input.kind == ObserverInput::Kind::key_down;
        // A step that was ended by the answer says so, and its own screen is passed over.
        const bool is_at_stimulus =
            !given[0].is_missed && *given[0].answered_at < *given[0].stimulus_onset + from_seconds(0.49);
        CHECK((trial.outcome.steps[1].ended_by == StepEnd::answer) == is_at_stimulus);
        CHECK(trial.outcome.steps.size() == (is_at_stimulus ? 3 : 4));
    }
    CHECK(of_mapping[0] == 2);
    CHECK(of_mapping[1] == 2);
    CHECK(before + missed > 0);

    REQUIRE(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);
    const auto exported = [&](const std::string& format) {
        const fs::path out = experiment.folder().path() / format;
        const ProgramRun done = experiment.overt(
            {"export", experiment.session().string(), "--format", format, "--out", out.string()});
        INFO(done.err);
        REQUIRE(done.exit_code == 0);
        return out;
    };
    const fs::path tables = exported("tsv");
    const auto table_of = [&](const std::string& name) {
        for (const fs::directory_entry& file : fs::recursive_directory_iterator(tables))
            if (file.path().filename() == name)
                return TsvFile(file.path());
        throw std::runtime_error(name);
    };
    const TsvFile given = table_of("given_answers.tsv");
    REQUIRE(given.size() == 16);
    CHECK(given.text(0, "id") == "seen");
    CHECK(given.has(3, "number"));
    CHECK(table_of("answer_inputs.tsv").size() > 16);
    std::string events;
    for (const fs::directory_entry& file : fs::recursive_directory_iterator(exported("bids")))
        if (file.path().filename().string().ends_with("_events.tsv"))
            events += text_of(file.path());
    CHECK_THAT(events, Contains("response_id") && Contains("gloss/head"));

    const ProgramRun replayed = replay(experiment);
    INFO(replayed.out << replayed.err);
    CHECK(replayed.exit_code == 0);
}

TEST_CASE("a criterion ends practice, feedback tells how it went, and keys stay an observer's own",
          "[session]") {
    const SmallExperiment experiment(answered(R"(
  { show = "centre", for_s = 0.2, until = "answer" },
  { answer = "seen", limit_s = 1 },
)",
                                              R"([[task.answer]]
id = "seen"
kind = "choice"
choices = ["metal", "stone"]
keys = ["f", "j"]
correct = "metal"
limit_s = 0.8
mapping = "observer"
simulated = { share_correct = 0.8, median_s = 0.35, shift_s = 0.1, missing = 0.1 }
[[block]]
id = "practice"
tasks = "judge"
repetitions = 6
criterion = { correct = 3, of_last = 4, at_least = 5 }
feedback = "{percent_correct} % in {median_s} s, {missed} missed, {trials} trials"
[[block]]
id = "test"
tasks = "judge"
feedback = "{correct} of {trials}"
[[observer_field]]
id = "effort"
kind = "scale"
steps = 5
when = "block:practice"
[[observer_field]]
id = "remarks"
kind = "text"
required = false
when = "end"
)"));
    const auto ran = [&](const std::string& observer, int number) {
        const ProgramRun run = experiment.run({"--observer", observer, "--no-pictures"});
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        return SessionRecord(experiment.session(number, observer));
    };
    // From what is on record, as the protocol says it.
    const auto mapping_of = [](const SessionRecord& record) {
        std::vector<bool> correct;
        std::size_t practised = 0;
        bool is_met = false;
        int mapping = -1;
        for (const TrialRecord& trial : record.trials()) {
            REQUIRE(trial.outcome.given.size() == 1);
            const GivenAnswer& given = trial.outcome.given.front();
            mapping = given.mapping;
            if (!given.is_missed)
                CHECK(given.key == ((given.value == "metal") == (mapping == 0) ? "f" : "j"));
            if (trial.trial.block != 0)
                continue;
            CHECK_FALSE(is_met); // nothing comes after that
            ++practised;
            correct.push_back(given.is_correct.value_or(false));
            is_met = correct.size() >= 5 && std::count(correct.end() - 4, correct.end(), true) >= 3;
        }
        CHECK(is_met);
        CHECK(practised >= 5);
        CHECK(record.trials().size() == practised + 4);
        return mapping;
    };
    const SessionRecord first = ran("P01", 1);
    const int own = mapping_of(first);
    CHECK(mapping_of(ran("P01", 2)) == own);
    CHECK(mapping_of(ran("P02", 1)) == 1 - own);
    // Feedback on a block, its questions, the next block, and the questions of the end.
    std::vector<std::string> shown;
    first.read_events([&](const RecordedEvent& event) {
        if (event.kind == "text shown" && event.detail.starts_with("feedback"))
            shown.push_back(event.detail);
    });
    CHECK(shown == std::vector<std::string>{"feedback on block practice", "feedback on block test"});
    std::vector<std::string> filled;
    for (const RecordedObserverField& field : first.observer_fields())
        filled.push_back(field.id);
    CHECK(filled == std::vector<std::string>{"effort", "remarks"});
    REQUIRE(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);
}

TEST_CASE("what is pointed at is a place of the surface, with how exact that is", "[session]") {
    const SmallExperiment experiment(answered(R"(
  { show = "centre", for_s = 2, until = "answer" },
  { answer = "where", limit_s = 1 },
)",
                                              "[[task.answer]]\nid = \"where\"\nkind = \"point\"\n"));
    const ProgramRun run = experiment.run();
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const fs::path out = experiment.folder().path() / "tables";
    const ProgramRun done =
        experiment.overt({"export", experiment.session().string(), "--format", "tsv", "--out", out.string()});
    INFO(done.err);
    REQUIRE(done.exit_code == 0);
    std::optional<TsvFile> given;
    for (const fs::directory_entry& file : fs::recursive_directory_iterator(out))
        if (file.path().filename() == "given_answers.tsv")
            given.emplace(file.path());
    REQUIRE(given);
    const SessionRecord record(experiment.session());
    const ScreenGeometry screen = record.header().screen_of_slot(0);
    REQUIRE(given->size() == record.trials().size());
    int on_object = 0;
    for (std::size_t row = 0; row < given->size(); ++row) {
        CAPTURE(row);
        // The place in the image is the one on the screen.
        const std::string value = record.trials()[row].outcome.given.front().value;
        // Left of the middle it begins with a minus, and is no number: to a spreadsheet a formula.
        CHECK(given->text(row, "answer") == without_formula(value));
        const auto px = read_pointed_px(value);
        REQUIRE(px);
        const glm::dvec2 image =
            screen.image_from_screen({screen.centre().x_px + px->x, screen.centre().y_px + px->y});
        CHECK(given->number(row, "point_image_x_px") == Approx(image.x).margin(1e-3));
        CHECK(given->number(row, "point_image_y_px") == Approx(image.y).margin(1e-3));
        CHECK(given->has(row, "point_frame"));
        if (!given->has(row, "point_x"))
            continue;
        ++on_object;
        // A place that is seen obliquely is less exact along one way, by the cosine.
        const double major = given->number(row, "point_sd_major"),
                     minor = given->number(row, "point_sd_minor");
        CHECK(minor > 0.0);
        const double oblique = std::cos(given->number(row, "point_incidence_deg") * 0.017453292519943295);
        CHECK(minor / major == Approx(oblique).epsilon(0.02).margin(0.05));
    }
    CHECK(on_object > 0);
}
