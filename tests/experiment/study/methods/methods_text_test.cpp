/// The text on methods of made-up studies, sentence by sentence.
#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>

#include "experiment/study/methods/methods_text.h"
#include "experiment/study/tables/study_tables.h"
#include "tests/support/methods_laws.h"

using namespace overt;
using Catch::Contains;

namespace {

SessionSetup measured_setup() {
    SessionSetup setup;
    setup.gaze = {GazeOrigin::measured, "eyelink", "EYELINK CL 5.15", 1000.0, Eye::left, true};
    setup.display.screen_px = {1920, 1080};
    setup.display.screen_mm = {531.5, 298.9};
    setup.display.viewing_distance_mm = 700.0;
    setup.display.px_per_deg = 44.13;
    setup.display.refresh_hz = 119.98;
    setup.display.latency_ms = 3.5;
    setup.display.timing = "proven";
    setup.display.light = {121.337, "an i1Display", "2026-03-02"};
    setup.stimuli.image_px = {1024, 768};
    setup.stimuli.image_deg = {22.91, 17.37};
    setup.stimuli.frame_count = 61;
    setup.stimuli.frame_rate_hz = 30.0;
    setup.stimuli.amplitude_deg = 25.0;
    setup.stimuli.duration_s = 8.0;
    setup.materials = {{"gold", "Smooth gold"}, {"clay", ""}, {"unseen", "Unseen"}};
    setup.tasks = {{"free", "Look as you like."}, {"age", "How old is it?"}};
    setup.calibrations = {{"tracker, 9 points", 3, 1, false}, {"polynomial, 13 points", 1, 0, false}};
    setup.program_version = "0.9.1";
    return setup;
}

/// Two observers with two trials each.
struct MadeStudy {
    MadeStudy() {
        results.by = {"material"};
        results.objects.push_back({});
        results.objects[0].id = "vase";
        results.objects[0].title = "A vase";
        results.objects[0].mesh = std::make_shared<Mesh>();
        for (const std::string observer : {"01", "02"}) {
            StudySession& session = results.sessions.emplace_back();
            session.observer = observer;
            session.folder = "sub-" + observer + "_ses-01";
            session.is_complete = true;
            session.trials = 2;
            session.events = "Fixations, saccades and blinks are those of the eye tracker itself.";
            session.setup = measured_setup();
            session.form = {{"age", observer == "01" ? "23" : "31"}, {"dominant_hand", "left"}};
            for (const std::string material : {"gold", "clay"}) {
                StudyTrial& trial = results.trials.emplace_back();
                trial.session = static_cast<int>(results.sessions.size()) - 1;
                trial.keys = {{"task", "free"}, {"material", material}};
                trial.number = material == "gold" ? 1 : 2;
                trial.presentation_s = 8.004;
                trial.quality.accuracy_deg = 0.3 + 0.1 * static_cast<double>(results.trials.size());
                trial.quality.rms_s2s_deg = 0.0213;
                trial.quality.sd_deg = 2.88e-14;
                trial.quality.rate_hz = 999.7;
                trial.quality.samples = 8000.0;
                trial.quality.lost = 120.0;
                trial.quality.refreshes = 960;
                trial.quality.missed_refreshes = 1;
            }
        }
        results.glance.observers = results.glance.sessions = 2;
        results.glance.trials = 4;
        results.glance.fixations = 1200;
        results.glance.counted = 1150;
        results.glance.not_counted = {{NotCounted::began_before_onset, 4}, {NotCounted::not_on_surface, 46}};
    }

    /// By topic; the laws hold of all.
    std::string text(const std::string& topic) {
        results.parameters = parameters_of(options);
        results.methods = methods_text(results, options);
        test::check_methods(nlohmann::json::parse(study_json(results)));
        for (const MethodsParagraph& paragraph : results.methods)
            if (paragraph.topic == topic)
                return paragraph.text;
        return {};
    }
    StudyResults results;
    StudyOptions options;
};

} // namespace

TEST_CASE("methods of measured gaze are told with every value", "[unit]") {
    MadeStudy study;
    CHECK(
        study.text("Observers and trials") ==
        "2 observers took part in 2 sessions with 4 trials that came to an end. The age was 23 to 31, with a "
        "median of 27 (2 observers). The dominant hand was \"left\" for 2 observers.");
    CHECK(
        study.text("Apparatus") ==
        "The display had 1920 x 1080 pixels, was 531.5 x 298.9 mm large, was refreshed at 119.98 Hz and was "
        "seen from 700 mm, so that 44.1 pixels in its middle were 1 deg of visual angle. The white of the "
        "display had 121 cd/m2, measured with an i1Display on 2026-03-02. Light came 3.5 ms after the "
        "vertical "
        "blank, and the times of pictures are proven by the display's vertical blanks. Gaze of both eyes, of "
        "which the left is analysed, was measured at 1000 Hz with an eye tracker, EyeLink (EYELINK CL 5.15). "
        "How the head was held, how the eye tracker works and what its software filters, and the room and "
        "its "
        "light, are not on record. Presentation and recording were by overt 0.9.1.");
    CHECK(
        study.text("Stimuli") ==
        "1 object (A vase) was shown, in 2 materials (Smooth gold and clay). Pictures had 1024 x 768 "
        "pixels "
        "or 22.9 x 17.4 deg; in each presentation, planned for 8 s, the object turned to and fro about the "
        "vertical, as a sine of time, by 25 deg to each side, in 61 frames of one period at 30 Hz. "
        "Presentations lasted 8.00 s (the same in 4 trials). Before a presentation observers read \"Look as "
        "you like.\"");
    CHECK(
        study.text("Quality of the gaze data") ==
        "Gaze was calibrated 6 times by the eye tracker itself (9 points) and 2 times by overt (polynomial, "
        "13 "
        "points). 2 of 8 calibrations were accepted though the validation was beyond the limits of the "
        "protocol. The mean error of the validation before a trial was 0.550 deg (median over 4 trials; "
        "0.400 "
        "to 0.700 deg). Precision within fixations was 0.0213 deg (the same in 4 trials) "
        "from sample to sample (RMS-S2S). As standard deviation within fixations (SD), around the eye's own "
        "motion (a line through "
        "each fifth of a second), it was below 0.0001 deg (the same in 4 "
        "trials). The sampling rate by the time stamps was 1000 Hz (the same in 4 trials). Of the samples of "
        "a "
        "trial, 1.50 % (the same in 4 trials) had no gaze outside of blinks, and 0 % (the same in 4 trials) "
        "had none in blinks. 4 of 3,840 refreshes of the display were missed.");
    CHECK(study.text("Fixations, saccades and blinks") ==
          "Fixations, saccades and blinks are those of the eye tracker itself.");
    CHECK_THAT(
        study.text("Places on the surface"),
        Contains("if 50 % of its samples or more had a place. 1,150 of 1,200 fixations were counted. Left "
                 "out were 4 that began before the onset and 46 with too few samples each on the object."));
    study.options.least_on_surface = 0.35;
    study.options.shortest_fixation_s = 0.08;
    study.options.reach_deg = 0.75;
    CHECK_THAT(study.text("Places on the surface"), Contains("by no more than 0.75 deg was given") &&
                                                        Contains("lasted 0.08 s or longer,") &&
                                                        Contains("if 35 % of its samples"));
}

TEST_CASE("methods say what is not known, of each thing that a session can lack", "[unit]") {
    MadeStudy study;
    for (StudySession& session : study.results.sessions) {
        session.setup = {};
        session.form.clear();
        session.events.clear();
    }
    for (StudyTrial& trial : study.results.trials) {
        trial.quality = {};
        trial.presentation_s = 0.0;
    }
    study.results.objects[0].mesh.reset();
    study.results.glance.fixations = study.results.glance.counted = 0;
    study.results.glance.not_counted.clear();
    CHECK_THAT(
        study.text("Apparatus"),
        Contains("Of the display its resolution, its size, its refresh rate and the viewing distance are "
                 "not on record, so that degrees of visual angle are not known.") &&
            Contains("The luminance of the display is not on record.") &&
            Contains("How long after the vertical blank light comes was not measured, and what proves the "
                     "times of pictures is not on record.") &&
            Contains("Gaze of the right eye was measured at a rate that is not on record with an eye "
                     "tracker, of unknown make.") &&
            Contains("in a version that is not on record"));
    CHECK(study.text("Stimuli") == "What was shown is not on record.");
    CHECK(
        study.text("Quality of the gaze data") ==
        "No calibration is on record. No trial follows a validation, so that the accuracy of gaze is not "
        "known. The precision of gaze is not known. There are no samples of gaze. How many refreshes of the "
        "display were missed is not on record.");
    CHECK(study.text("Fixations, saccades and blinks") == "There are no fixations, saccades and blinks.");
    CHECK(study.text("Places on the surface") ==
          "The sessions have no surfaces, so that no fixation was placed on one. There are no fixations.");
    CHECK(study.text("Analysis").empty());
    for (StudySession& session : study.results.sessions)
        session.setup.gaze.origin = GazeOrigin::none;
    CHECK_THAT(study.text("Apparatus"), Contains("No gaze was recorded.") && !Contains("head was held"));
}

TEST_CASE("methods call each source of gaze by its name, and count the sessions that differ", "[unit]") {
    MadeStudy study;
    study.results.sessions[1].setup.gaze = {GazeOrigin::measured, "tobii", "", 120.0, Eye::right, false};
    CHECK_THAT(
        study.text("Apparatus"),
        Contains("In 1 of 2 sessions, gaze of both eyes, of which the left is analysed, was measured at "
                 "1000 Hz with an eye tracker, EyeLink (EYELINK CL 5.15). In 1 of 2 sessions, gaze of the "
                 "right eye was measured at 120 Hz with an eye tracker, Tobii."));
    const auto of_all = [&](const GazeSetup& gaze) {
        for (StudySession& session : study.results.sessions)
            session.setup.gaze = gaze;
        return study.text("Apparatus");
    };
    CHECK_THAT(of_all({GazeOrigin::simulated, "simulated", "", 500.0}),
               Contains("Gaze of the right eye was simulated at 500 Hz.") && !Contains("tracker"));
    CHECK_THAT(study.text("Observers and trials"), Contains("2 simulated observers took part"));
    CHECK_THAT(
        of_all({GazeOrigin::played_back, "replay", "gaze of sub-07, by eyelink", 500.0}),
        Contains("No eye was measured: gaze of the right eye was played back from a recording at 500 Hz "
                 "(gaze of sub-07, by eyelink)."));
    CHECK_THAT(of_all({GazeOrigin::pointer, "mouse", "", 60.0}),
               Contains("No eye was measured, and the mouse pointer stood in for it at 60 Hz."));
    CHECK_THAT(of_all({GazeOrigin::imported, "EyeLink CL", "", 500.0}),
               Contains("Gaze of the right eye was imported from a recording, at 500 Hz, of an eye tracker, "
                        "EyeLink CL."));
    // Another program presented.
    for (StudySession& session : study.results.sessions)
        session.setup.presenter = "PsychoPy";
    CHECK_THAT(
        study.text("Apparatus"),
        Contains("When pictures were lit is what the imported log and the protocol say: how many refreshes "
                 "were missed is not known, and light is taken to have come 3.5 ms after an onset.") &&
            Contains("Pictures were presented by PsychoPy, and gaze and trials were imported into overt") &&
            !Contains("vertical blank"));
    for (StudySession& session : study.results.sessions) {
        session.setup.presenter = "";
        session.setup.display.latency_ms = 0.0;
    }
    CHECK_THAT(study.text("Apparatus"),
               Contains("0 ms after an onset, since nobody knows how long it took.") &&
                   Contains("presented by another program, which is not on record"));
    for (StudySession& session : study.results.sessions) {
        session.setup.presenter.reset();
        session.setup.display.latency_ms = 3.5;
    }
    // The display of another session was another one.
    study.results.sessions[1].setup.display.refresh_hz = 60.0;
    study.results.sessions[0].setup.display.timing = "unproven";
    CHECK_THAT(
        of_all(measured_setup().gaze),
        Contains("In 1 of 2 sessions, the display had 1920 x 1080 pixels, was 531.5 x 298.9 mm large, was "
                 "refreshed at 60 Hz") &&
            Contains("In 1 of 2 sessions, light came 3.5 ms after the vertical blank, and nothing proves "
                     "when pictures were lit."));
}

TEST_CASE("methods name the rules of exclusion, and how many trials each of them cost", "[unit]") {
    MadeStudy study;
    const auto exclude = [&](const ExclusionRules& rules) {
        study.options.exclude = rules;
        study.results.glance.excluded_trials = study.results.glance.without_gaze = 0;
        std::map<ExclusionRule, int> counts;
        for (StudyTrial& trial : study.results.trials) {
            const std::optional<ExclusionRule> rule = broken_rule(trial.quality, rules);
            trial.excluded = rule.has_value() || !trial.has_gaze;
            study.results.glance.excluded_trials += trial.excluded;
            study.results.glance.without_gaze += !trial.has_gaze;
            if (rule && trial.has_gaze)
                ++counts[*rule];
        }
        study.results.glance.excluded_by.assign(counts.begin(), counts.end());
        return study.text("Observers and trials");
    };
    CHECK_THAT(exclude({{}, {}, {}, {}}), !Contains("exclu"));
    CHECK_THAT(
        exclude({{}, 1.0, {}, {}}),
        Contains("A trial was to be excluded if the validation before it had a mean error above 1 deg. This "
                 "excluded no trial."));
    CHECK_THAT(exclude({{}, 0.65, {}, {}}), Contains("above 0.65 deg. 1 of 4 trials was excluded."));
    study.results.trials[0].quality.lost = 2400.0;
    study.results.trials[1].quality.missed_refreshes.reset();
    CHECK_THAT(
        exclude({0.25, 0.65, {}, 2}),
        Contains("if more than 25 % of its samples were lost outside of blinks, or if the validation before "
                 "it had a mean error above 0.65 deg, or if more than 2 of its refreshes were missed, or "
                 "their number is not proven. 3 of 4 trials were excluded, 1 for lost samples, 1 for the "
                 "validation and 1 for missed refreshes. A trial that breaks several of these limits is "
                 "counted with the first."));
    CHECK_THAT(exclude({{}, 0.0, {}, {}}), Contains("All 4 trials were excluded."));
    // A trial without gaze is no case of a rule.
    study.results.trials[3].has_gaze = false;
    CHECK_THAT(exclude({{}, {}, {}, {}}),
               Contains("1 of 4 trials was excluded, since no gaze was recorded in it."));
    study.results.glance.observers = 1;
    CHECK_THAT(exclude({{}, {}, {}, {}}),
               Contains("The results are of 1 of 2 observers, since of the others there "
                        "is no trial to analyse."));
    study.results.glance.observers = 2;
    study.results.trials[3].has_gaze = true;
    // A session without words of its own that could break out of a sentence.
    study.results.sessions[0].form = {{"remark", "I <b>like</b> {it}"}};
    CHECK_THAT(exclude({{}, {}, {}, {}}), Contains("The remark is on record of 1 observer."));
}

TEST_CASE("methods say how maps of differences were tested, and only where there are any", "[unit]") {
    MadeStudy study;
    study.results.differences.clear();
    CHECK_THAT(study.text("Analysis"), !Contains("clusters of neighbouring"));
    DifferenceMap& map = study.results.differences.emplace_back();
    map.column = "material";
    map.absent = "one observer alone saw it in both levels";
    CHECK_THAT(study.text("Analysis"), !Contains("clusters of neighbouring"));
    map.absent.clear();
    CHECK_THAT(study.text("Analysis"),
               Contains("levels of material differ was tested within observers by clusters") &&
                   !Contains("threshold-free"));
    study.options.threshold_free = true;
    CHECK_THAT(study.text("Analysis"), Contains("by threshold-free cluster enhancement"));
}
