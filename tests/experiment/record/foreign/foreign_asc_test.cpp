#include <fstream>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/record/foreign/foreign_asc.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

namespace {

std::filesystem::path recording_in(const test::TemporaryFolder& folder, const std::string& text) {
    std::ofstream(folder.path() / "p01.asc", std::ios::binary) << text;
    return folder.path() / "p01.asc";
}

/// A recording at 500 Hz of one eye, 100 samples from 1000 ms on at x = 100 + its number; `messages` by time.
std::string recorded_asc(const std::vector<std::pair<int, std::string>>& messages,
                         const std::string& screen = "MSG\t900 DISPLAY_COORDS 0 0 799 599\n") {
    std::string text = "** CONVERTED FROM p01.edf\n** TYPE: EDF_FILE BINARY EVENT SAMPLE TAGGED\n" + screen +
                       "START\t1000 \tRIGHT\tSAMPLES\tEVENTS\nPUPIL\tDIAMETER\n"
                       "EVENTS\tGAZE\tRIGHT\tRATE\t 500.00\tTRACKING\tCR\tFILTER\t2\n"
                       "SAMPLES\tGAZE\tRIGHT\tRATE\t 500.00\tTRACKING\tCR\tFILTER\t2\n";
    for (int i = 0; i < 100; ++i) {
        for (const auto& [at, said] : messages)
            if (at >= 1000 + 2 * (i - 1) && at < 1000 + 2 * i)
                text += "MSG\t" + std::to_string(at) + " " + said + "\n";
        const std::string place =
            i == 50 ? "   .\t   .\t    0.0" : std::to_string(100 + i) + ".0\t 300.0\t 900.0";
        text += std::to_string(1000 + 2 * i) + "\t " + place + "\t...\n";
    }
    return text + "END\t1200 \tSAMPLES\tEVENTS\tRES\t  40.0\t  41.0\n";
}

ScreenGeometry screen_800_600() {
    ScreenGeometry screen;
    screen.screen_px = {800, 600};
    return screen;
}

TrackerTime stamp_ms(double ms) { return TrackerTime(TrackerClock::duration(std::llround(1e3 * ms))); }

GazeSurvey surveyed_asc(const std::filesystem::path& file) {
    const ForeignGaze gaze({file}, std::nullopt, screen_800_600());
    CHECK(gaze.has_messages());
    return gaze.survey({});
}

const std::vector<std::string> asc_factors{"object", "material", "task"};

TrialLog message_trials_of(const std::filesystem::path& file, const std::vector<std::string>& words = {}) {
    return trials_in_messages(surveyed_asc(file), trial_columns_of(words), asc_factors, file);
}

std::string refusal_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

} // namespace

TEST_CASE("an EyeLink's recording is read as gaze with its messages", "[unit]") {
    const test::TemporaryFolder folder;
    const auto file =
        recording_in(folder, recorded_asc({{1010, "TRIALID 3"}, {1041, "-6 SYNCTIME"}, {1050, "7 kg"}}));
    const GazeSurvey survey = surveyed_asc(file);
    CHECK(survey.columns.program == "EyeLink (pupil diameters)");
    CHECK(survey.samples == 100);
    CHECK(survey.without_gaze == 1);
    CHECK(survey.rate_hz == 500.0);
    CHECK((survey.has_right && !survey.has_left));
    CHECK(survey.first == stamp_ms(1000));
    CHECK(survey.last == stamp_ms(1198));
    // The number before SYNCTIME says by how many milliseconds it came too late; others are texts.
    std::vector<std::pair<std::string, TrackerTime>> marks;
    for (const GazeMark& mark : survey.marks)
        marks.emplace_back(mark.text, mark.at);
    CHECK(marks ==
          std::vector<std::pair<std::string, TrackerTime>>{{"DISPLAY_COORDS 0 0 799 599", stamp_ms(900)},
                                                           {"TRIALID 3", stamp_ms(1010)},
                                                           {"SYNCTIME", stamp_ms(1047)},
                                                           {"7 kg", stamp_ms(1050)}});
    int seen = 0;
    ForeignGaze({file}, std::nullopt, screen_800_600()).read([&](const ForeignItem& item) {
        if (!item.sample)
            return;
        const int i = static_cast<int>((item.at - stamp_ms(1000)).count() / 2000);
        CHECK(item.sample->eye == Eye::right);
        if (i == 50)
            CHECK_FALSE(item.sample->gaze);
        else
            CHECK(item.sample->gaze->x_px == 100.0 + i);
        ++seen;
    });
    CHECK(seen == 100);
}

TEST_CASE("a recording of another screen is refused, and columns are none of an EyeLink's", "[unit]") {
    const test::TemporaryFolder folder;
    const auto file = recording_in(folder, recorded_asc({}, "MSG\t900 DISPLAY_COORDS 0 0 1023 767\n"));
    CHECK(refusal_of([&] {
              surveyed_asc(file);
          }).find("1024 x 768, and the protocol's [display] has 800 x 600") != std::string::npos);
    CHECK(refusal_of([&] {
              ForeignGaze({file}, gaze_columns_of({"time=t,x=a,y=b"}), screen_800_600());
          }).find("leave out --columns") != std::string::npos);
    CHECK(surveyed_asc(recording_in(folder, recorded_asc({}, "MSG\t900 DISPLAY_COORDS 0 0 800 600\n")))
              .samples == 100);
    const GazeSurvey survey = surveyed_asc(recording_in(folder, recorded_asc({}, "")));
    REQUIRE(!survey.remarks.empty());
    CHECK(survey.remarks.front().find("taken for that of the protocol") != std::string::npos);
}

TEST_CASE("messages for Data Viewer are a log of trials", "[unit]") {
    const test::TemporaryFolder folder;
    const auto file = recording_in(folder, recorded_asc({{1002, "TRIALID 1 practice"},
                                                         {1004, "TRIAL_RESULT 0"},
                                                         {1006, "!V TRIAL_VAR object between"},
                                                         {1010, "TRIALID 2"},
                                                         {1021, "3 SYNCTIME"},
                                                         {1030, "-2 PICTURE_OFF"},
                                                         {1032, "!V TRIAL_VAR object ball"},
                                                         {1032, "!V TRIAL_VAR material \"dull gold\""},
                                                         {1033, "!V TRIAL_VAR rt 412.5"},
                                                         {1033, "!V TRIAL_VAR answer old"},
                                                         {1034, "!V TRIAL_VAR where left"},
                                                         {1036, "TRIAL_RESULT 1"},
                                                         {1050, "TRIALID 3"},
                                                         {1061, "SYNCTIME"},
                                                         {1063, "SYNCTIME"},
                                                         {1070, "!V TRIAL_VAR object cube"}}));
    const TrialLog log = message_trials_of(file, {"end=PICTURE_OFF,response_time=rt,side=where"});
    REQUIRE(log.trials.size() == 2);
    const LoggedTrial &first = log.trials[0], &second = log.trials[1];
    CHECK(first.key == "2");
    CHECK(first.onset == std::chrono::milliseconds(1018));
    CHECK(first.end == LogTime(std::chrono::milliseconds(1032)));
    CHECK(first.words == std::map<std::string, std::string>{
                             {"material", "dull gold"}, {"object", "ball"}, {"side", "left"}});
    CHECK(first.answer == "old");
    CHECK(first.response_time == LogTime(std::chrono::microseconds(412500)));
    CHECK(second.onset == std::chrono::milliseconds(1061));
    CHECK_FALSE(second.end);
    CHECK(second.words == std::map<std::string, std::string>{{"object", "cube"}});
    CHECK(second.answer.empty());
    CHECK(log.program.empty());
    REQUIRE(log.remarks.size() == 1);
    CHECK(log.remarks[0] == "1 of 3 trials of the recording have no message SYNCTIME and are left out.");
}

TEST_CASE("trials are told by other programs' messages, by pictures, and by onsets alone", "[unit]") {
    const test::TemporaryFolder folder;
    const TrialLog opensesame =
        message_trials_of(recording_in(folder, recorded_asc({{1002, "start_trial 1"},
                                                             {1004, "var object ball"},
                                                             {1006, "var variance 2"},
                                                             {1010, "start_phase picture"},
                                                             {1020, "end_phase picture"},
                                                             {1024, "stop_trial"},
                                                             {1026, "var object cube"}})),
                          {"onset=start_phase picture,end=end_phase picture"});
    REQUIRE(opensesame.trials.size() == 1);
    CHECK(opensesame.trials[0].onset == std::chrono::milliseconds(1010));
    CHECK(opensesame.trials[0].end == LogTime(std::chrono::milliseconds(1020)));
    CHECK(opensesame.trials[0].words == std::map<std::string, std::string>{{"object", "ball"}});

    const TrialLog pictures = message_trials_of(
        recording_in(folder, recorded_asc({{1002, "TRIALID 1"},
                                           {1003, "!V IMGLOAD CENTER pictures/ball.png 512.5 384"},
                                           {1010, "SYNCTIME"},
                                           {1050, "TRIALID 2"},
                                           {1053, "!V VFRAME 1 0 0 cube.avi"},
                                           {1060, "SYNCTIME"}})));
    REQUIRE(pictures.trials.size() == 2);
    CHECK(pictures.trials[0].words == std::map<std::string, std::string>{{"stimulus", "pictures/ball.png"}});
    CHECK(pictures.trials[1].words == std::map<std::string, std::string>{{"stimulus", "cube.avi"}});

    const TrialLog onsets = message_trials_of(recording_in(folder, recorded_asc({{1010, "stimulus on"},
                                                                                 {1012, "var object ball"},
                                                                                 {1060, "stimulus on"},
                                                                                 {1062, "var object cube"}})),
                                              {"onset=stimulus on"});
    REQUIRE(onsets.trials.size() == 2);
    CHECK(onsets.trials[0].words.at("object") == "ball");
    CHECK(onsets.trials[1].words.at("object") == "cube");
}

TEST_CASE("overt's own messages say when a stimulus came and went, in their earlier form, too", "[unit]") {
    const test::TemporaryFolder folder;
    for (const std::string word : {"PRESENTATION_OFFSET", "PRESENTATION_END"}) {
        const TrialLog log = message_trials_of(recording_in(
            folder, recorded_asc({{1002, "TRIALID 1"}, {1010, "PRESENTATION_ONSET"}, {1030, "-3 " + word}})));
        REQUIRE(log.trials.size() == 1);
        CHECK(log.trials[0].onset == std::chrono::milliseconds(1010));
        CHECK(log.trials[0].end == LogTime(std::chrono::milliseconds(1033)));
    }
}

TEST_CASE("a recording that does not say its trials is refused with its messages", "[unit]") {
    const test::TemporaryFolder folder;
    const auto file =
        recording_in(folder, recorded_asc({{1002, "TRIALID 1"}, {1010, "go"}, {1020, "go"}, {1030, "stop"}}));
    const std::string fault = refusal_of([&] { message_trials_of(file); });
    CHECK(fault.find("no message SYNCTIME says when a stimulus came") != std::string::npos);
    CHECK(fault.find("go (2), DISPLAY_COORDS (1), TRIALID (1), stop (1)") != std::string::npos);
    CHECK(refusal_of([&] { message_trials_of(file, {"onset=begin"}); }).find("no message begin says") !=
          std::string::npos);
    CHECK(refusal_of([&] {
              message_trials_of(file, {"onset=go,answer=key"});
          }).find("no trial has a variable \"key\" for the answer; there are none") != std::string::npos);
    CHECK(refusal_of([&] {
              message_trials_of(file, {"onset=go,marker=a,marker_text=b"});
          }).find("give one of them") != std::string::npos);
}

TEST_CASE("validations that an EyeLink's messages tell are taken, of both eyes as one", "[unit]") {
    const auto said = [](double ms, const std::string& text) { return GazeMark{stamp_ms(ms), text, false}; };
    const std::vector<GazeMark> marks{
        said(100, "VALIDATE R 4POINT 0 RIGHT  at 1,2  OFFSET 9.00 deg.  1.0,1.0 pix."), // of none
        said(5000,
             "!CAL VALIDATION HV5 LR LEFT  GOOD ERROR 0.36 avg. 0.47 max  OFFSET 0.22 deg. 2.1,7.7 pix."),
        said(5000,
             "!CAL VALIDATION HV5 LR RIGHT GOOD ERROR 0.30 avg. 0.62 max  OFFSET 0.18 deg. -2.4,5.8 pix."),
        said(9000, "!CAL VALIDATION HV9 R RIGHT ABORTED"),
        said(20000, "!CAL VALIDATION HV9 R RIGHT  FAIR ERROR 0.90 avg. 1.20 max"),
        said(20000, "VALIDATE R 4POINT 0 RIGHT  at 512,384  OFFSET 0.45 deg.  -5.6,15.3 pix."),
        said(20001, "VALIDATE R POINT 1  RIGHT  at 61.5,384  OFFSET 1.20 deg.  3.0,-9.7 pix."),
        said(20001, "VALIDATE R 4POINT 2 RIGHT  at 962,384  MISSING"),
        said(20002, "VALIDATE R 4POINT 3 LEFT  somewhere"),
        said(90000, "VALIDATE R 4POINT 4 RIGHT  at 1,2  OFFSET 9.00 deg.  1.0,1.0 pix.")};
    const std::vector<ToldValidation> told = validations_in_messages(marks);
    REQUIRE(told.size() == 2);
    CHECK(told[0].at == stamp_ms(5000));
    CHECK(told[0].found.mean_error.value == Approx(0.33));
    CHECK(told[0].found.max_error.value == 0.62);
    CHECK(told[0].found.targets.empty());
    // Targets tell more than the tracker's sums.
    const ValidationResult& found = told[1].found;
    CHECK(found.mean_error.value == Approx((0.45 + 1.2) / 2));
    CHECK(found.max_error.value == 1.2);
    REQUIRE(found.targets.size() == 3);
    CHECK(found.targets[0].eye == Eye::right);
    CHECK(found.targets[0].target.x_px == 512.0);
    CHECK(found.targets[0].gaze->x_px == Approx(506.4));
    CHECK(found.targets[0].gaze->y_px == Approx(399.3));
    CHECK(found.targets[1].target.x_px == 61.5);
    CHECK(found.targets[1].gaze->y_px == Approx(374.3));
    CHECK_FALSE(found.targets[2].gaze);
}
