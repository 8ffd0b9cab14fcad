/// Whole sessions through the program: consent, form, operator and spoken answers.
#include <set>

#include <catch2/catch.hpp>

#include "experiment/base/content_hash.h"
#include "experiment/ports/session_phase.h"
#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

const std::string answers = "[answers]\nrecord = \"optional\"\nsample_rate_hz = 16000\n";

std::vector<std::string> details_of(const SessionRecord& record, std::string_view kind) {
    std::vector<std::string> details;
    for (const RecordedEvent& event : record.events())
        if (event.kind == kind)
            details.push_back(event.detail);
    return details;
}

long count(const std::vector<std::string>& all, std::string_view one) {
    return std::count(all.begin(), all.end(), one);
}

} // namespace

TEST_CASE("a session is led by an operator's keys, and every trial that is not skipped counts once",
          "[session]") {
    const SmallExperiment experiment(
        with(small_protocol, "[screens]", "[repeat]\nrejected = \"end-of-block\"\n\n[screens]"));
    const ProgramRun run = experiment.run(
        {"--simulate-operator", "task screen@1+0.1=pause", "--simulate-operator", "stimulus@2+0.5=skip,2",
         "--simulate-operator", "stimulus@3+0.5=abort,no", "--simulate-operator",
         "response screen@4+0.2=repeat", "--simulate-operator", "task screen@5+0.1=recalibrate",
         "--simulate-operator", "response screen@6+0.1=reject", "--simulate-operator",
         "task screen@7+0.1=skip,no", "--simulate-operator", "task screen@77+0=pause"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("9 of 10 trials completed, 1 skipped"));
    CHECK_THAT(run.err, Contains("skipped: does not come again") &&
                            Contains("rejected: comes again at the end of the block") &&
                            Contains("task screen@77+0=pause: was not pressed"));
    const std::string shown = experiment.overt({"show", experiment.session().string()}).out;
    CHECK_THAT(shown, Contains(" skipped ") && Contains(" rejected ") && Contains(" repeated "));
    const SessionRecord record(experiment.session());
    CHECK(record.damages().empty());
    std::vector<int> attempts(small_trials), completed(small_trials);
    for (const TrialRecord& trial : record.trials()) {
        const auto index = static_cast<std::size_t>(trial.trial.index);
        ++attempts[index];
        completed[index] += trial.status == TrialRecord::Status::completed;
        // What was broken off in its animation keeps its rows.
        if (trial.trial.index == 2 && trial.attempt == 1) {
            CHECK(trial.status == TrialRecord::Status::aborted);
            CHECK(record.flips(trial).size() > 30);
            CHECK(record.flips(trial).size() < 120);
            CHECK(record.samples(trial).size() > 200);
        }
    }
    CHECK(attempts == std::vector<int>{1, 1, 2, 2, 1, 2, 1, 1, 1, 1});
    CHECK(completed == std::vector<int>{1, 0, 1, 1, 1, 1, 1, 1, 1, 1});
    const auto failures = details_of(record, "trial failed");
    REQUIRE(failures.size() == 4);
    CHECK_THAT(failures[0], Contains("skipped: observer's wish"));
    CHECK_THAT(failures[1], Contains("broken off") && Contains("end of the block"));
    CHECK_THAT(failures[2], Contains("repeated") && Contains("comes again now"));
    CHECK(count(details_of(record, "operator answered"), "no") == 2);
    CHECK(count(details_of(record, phase_event), "calibration") == 2);
    CHECK(count(details_of(record, phase_event), "pause") == 1);
    CHECK(count(details_of(record, phase_event), "stimulus") >= 13);
    CHECK(details_of(record, phase_event).back() == "end");
}

TEST_CASE(
    "a session that the operator ends in an animation keeps all trials before it, and is closed in order",
    "[session]") {
    const SmallExperiment experiment;
    const ProgramRun run = experiment.run({"--simulate-operator", "stimulus@3+0.4=abort"});
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.err, Contains("ended early"));
    const SessionRecord record(experiment.session());
    CHECK(record.closed_in_order());
    REQUIRE(record.trials().size() == 3);
    CHECK(record.trials()[1].status == TrialRecord::Status::completed);
    CHECK(record.trials()[2].status == TrialRecord::Status::aborted);
    CHECK(record.flips(record.trials()[2]).size() > 30);
}

TEST_CASE("keys of an operator who is not there are checked, and only for observers who are not",
          "[session]") {
    const SmallExperiment experiment;
    for (const char* wrong : {"stimulus=skip", "stimuli+1=skip", "stimulus@0+1=skip", "stimulus+x=skip",
                              "stimulus+1=jump", "stimulus+1=skip,maybe"}) {
        const ProgramRun run = experiment.run({"--simulate-operator", wrong});
        CHECK(run.exit_code == 2);
        CHECK_THAT(run.err, Contains("PHASE[@TRIAL]"));
    }
    CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
}

TEST_CASE("a simulated observer's answers are heard where the observer began to speak", "[session]") {
    const SmallExperiment experiment(std::string(small_protocol) + answers);
    const ProgramRun run =
        experiment.run({"--trials", "4", "--simulate-operator", "response screen@2+0.3=repeat"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("spoken answers: simulated sound device"));
    const SessionRecord record(experiment.session());
    REQUIRE(record.trials().size() == 5);
    std::set<std::string> files;
    for (const TrialRecord& trial : record.trials()) {
        const auto answer = record.answer_recording(trial);
        REQUIRE(answer);
        files.insert(answer->file);
        const std::filesystem::path file = experiment.session() / answer->file;
        CHECK(hash_of_file(file) == answer->sha256);
        CHECK(answer->fault.empty());
        CHECK(answer->bits == 16);
        CHECK(answer->overruns == 0);
        CHECK(to_seconds(answer->onset_uncertainty) < 1e-3);
        if (trial.status != TrialRecord::Status::completed)
            continue;
        const double answered_s =
            to_seconds(trial.outcome.responded_at - trial.outcome.response_screen_onset);
        CHECK((static_cast<double>(answer->samples) - answer->onset_sample) / answer->measured_rate_hz ==
              Approx(answered_s).margin(0.002));
        REQUIRE(answer->voice_onset);
        CHECK(to_seconds(*answer->voice_onset) > 0.24);
        CHECK(to_seconds(*answer->voice_onset) < answered_s);
    }
    CHECK(files.size() == 5);
    CHECK(files.contains("answers/trial_02_2.wav"));
}

TEST_CASE("the same seeds speak the same bytes", "[session]") {
    const SmallExperiment experiment(std::string(small_protocol) + answers);
    for (int i = 0; i < 2; ++i)
        REQUIRE(experiment.run({"--trials", "2"}).exit_code == 0);
    for (const char* name : {"answers/trial_01.wav", "answers/trial_02.wav"})
        CHECK(hash_of_file(experiment.session(1) / name) == hash_of_file(experiment.session(2) / name));
}

TEST_CASE("consent is in the record with the hash of its text, before the form", "[session]") {
    const SmallExperiment experiment(std::string(small_protocol) +
                                     "[consent]\ntext = \"Stimmen Sie zu? ✓ J/N\"\naccept_key = \"j\"\n"
                                     "[[observer_field]]\nid = \"age\"\n");
    REQUIRE(experiment.run({"--trials", "1"}).exit_code == 0);
    const auto consents = SessionRecord(experiment.session()).consents();
    REQUIRE(consents.size() == 1);
    CHECK(consents[0].accepted);
    CHECK(consents[0].observer == "P01");
    CHECK(consents[0].text_sha256 == hash_of_text("Stimmen Sie zu? ✓ J/N"));
    CHECK(consents[0].utc.size() == 20);
}

TEST_CASE("a machine without a sound device may not run what requires one, and says so for what does not",
          "[session]") {
    const SmallExperiment required(with(std::string(small_protocol) + answers, "\"optional\"",
                                        "\"required\"\ndevice = \"no such device\""));
    const ProgramRun check = required.overt({"check", required.protocol().string()});
    CHECK(check.exit_code == 2);
    CHECK_THAT(check.err, Contains("no such device") && Contains("record = \"optional\""));
    const SmallExperiment optional(with(std::string(small_protocol) + answers, "\"optional\"",
                                        "\"optional\"\ndevice = \"no such device\""));
    const ProgramRun noted = optional.overt({"check", optional.protocol().string()});
    CHECK(noted.exit_code == 0);
    CHECK_THAT(noted.out, Contains("are not recorded here") && Contains("no such device"));
}

TEST_CASE("texts that no font has or that are too long for the screen are found before a session",
          "[session]") {
    std::string text;
    for (int i = 0; i < 60; ++i)
        text += "line\\n";
    const SmallExperiment experiment(
        with(small_protocol, "[screens]",
             "[screens]\nwelcome_text = \"" + text + "\"\nfarewell_text = \"\\U0003FF00\""));
    const ProgramRun check = experiment.overt({"check", experiment.protocol().string()});
    CHECK(check.exit_code == 2); // its end would be cut off
    CHECK_THAT(check.err, Contains("screens.welcome_text: too long for the screen"));
    CHECK_THAT(check.err, Contains("screens.farewell_text: no font"));
}
