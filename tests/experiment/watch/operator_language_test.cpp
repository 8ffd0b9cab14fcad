/// The language of the operator's socket.
#include <catch2/catch.hpp>

#include "experiment/ports/event_kinds.h"
#include "experiment/watch/operator_command.h"
#include "experiment/watch/session_view.h"
#include "experiment/watch/view_news.h"
#include "experiment/watch/view_text.h"

using namespace overt;

namespace {

SessionView some_view() {
    SessionView view;
    view.time_s = 61.25;
    view.phase = "stimulus";
    view.trial = 3;
    view.task = "age";
    view.question = "How <b>old</b>?\nSay it \"aloud\" – 好";
    view.shown = {{0, "bust", "matt", "stimuli/bust_matt.exr", 0, 15, 12, 3},
                  {1, "tall", "matt", "", 1, 0, -1, -1}};
    view.done = 3;
    view.failed = 1;
    view.first_trial_s = 21.25;
    view.done_before = 1;
    view.refresh = 480;
    view.missed = 4;
    view.missed_in_trial = 2;
    view.samples = 1000;
    view.lost = 50;
    view.samples_in_trial = 100;
    view.lost_in_trial = 10;
    view.validation_mean_deg = 0.25;
    view.validation_max_deg = 0.75;
    view.drift_deg = 1.5;
    view.tracker_is_lost = true;
    view.asks = "Go on?";
    view.level_rms = 0.1;
    view.level_peak = 0.5;
    view.is_clipping = true;
    view.answer = "thirty";
    view.dropped = 7;
    view.is_over = true;
    return view;
}

SessionFacts some_facts() {
    return {"small",
            "P01",
            "/data/s",
            10,
            120.0,
            544,
            192,
            {{"left", 208, 32, 128, 128}, {"right", 400, 64, 100, 64}},
            31,
            true,
            false,
            1.0,
            0.5,
            1.0,
            {"sleepy", "a \"noise\""},
            4711.25};
}

/// A trial that shows one bust.
ViewedTrial bust_trial() {
    ViewedStimulus bust;
    bust.object = "bust";
    bust.material = "matt";
    return {"task", "What?", {bust}};
}

ViewNews news_of(ViewNews::Kind kind, double at_s) {
    ViewNews news;
    news.kind = kind;
    news.at = SessionTime(from_seconds(at_s));
    return news;
}

} // namespace

TEST_CASE("a state comes out of its line as it went in", "[unit]") {
    const SessionView view = some_view();
    const std::string line = line_of(view);
    CHECK(line.find('\n') == line.size() - 1);
    const ViewLine read = read_view_line(line);
    REQUIRE(read.view);
    // Every member is in the line, so that equal lines are equal states.
    CHECK(line_of(*read.view) == line);
    CHECK(read.view->drift_deg == view.drift_deg);
    CHECK(line_of(*read.view) != line_of(SessionView()));

    const ViewLine facts = read_view_line(line_of(some_facts()));
    REQUIRE(facts.facts);
    CHECK(facts.version == view_version);
    CHECK(line_of(*facts.facts) == line_of(some_facts()));
    CHECK(facts.facts->clock_zero_s == 4711.25);
    const ViewLine event = read_view_line(line_of(ViewedEvent{1.5, 2, "kind", "de\ntail"}));
    REQUIRE(event.event);
    CHECK(event.event->detail == "de\ntail");
}

TEST_CASE("no state makes a line that is longer than the language allows", "[unit]") {
    SessionView view = some_view();
    const std::string endless(100'000, '\x01');
    view.task = view.question = view.asks = view.answer = endless;
    view.shown.assign(1000, {0, endless, endless, endless, 1 << 30, 1 << 30, 1 << 30, 1 << 30});
    const std::string line = line_of(view);
    CHECK(line.size() <= longest_view_line);
    REQUIRE(read_view_line(line).view);
    const std::vector<ViewedGaze> gaze(10'000, ViewedGaze{true, ScreenPoint{-1234.56789012345, 1e-300},
                                                          1 << 30, 1 << 30, 1 << 30, -1e-300, INT64_MIN});
    const std::string points = line_of(std::span(gaze));
    CHECK(points.size() <= longest_view_line);
    CHECK(read_view_line(points).gaze.size() == longest_gaze);
    ViewedCamera camera{ViewedCamera::most_width_px, ViewedCamera::most_height_px, {}, endless};
    camera.rgb.resize(3 * 192 * 144);
    const std::string image = line_of(camera);
    CHECK(image.size() <= longest_camera_line);
    REQUIRE(read_view_line(image).camera);
}

TEST_CASE("gaze comes out of its line as it went in, an eye that was lost too", "[unit]") {
    const std::vector<ViewedGaze> gaze{{true, ScreenPoint{12.5, -3.0}, 4, 1, 17, 61.25, 8'000'500},
                                       {false, {}, -1, -1, -1, 61.254, 8'004'500}};
    const ViewLine read = read_view_line(line_of(std::span(gaze)));
    REQUIRE(read.gaze.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(read.gaze[i].is_right == gaze[i].is_right);
        CHECK(read.gaze[i].place == gaze[i].place);
        CHECK(read.gaze[i].trial == gaze[i].trial);
        CHECK(read.gaze[i].shown == gaze[i].shown);
        CHECK(read.gaze[i].pose == gaze[i].pose);
        CHECK(read.gaze[i].at_s == gaze[i].at_s);
        CHECK(read.gaze[i].sampled_us == gaze[i].sampled_us);
    }
    CHECK(read_view_line(R"({"gaze":[["right",0,0,0,1.5,2,3,4],["right",0.5,0,0,1,2,3,4],["right",0],[],7]})")
              .gaze.size() == 1);
}

TEST_CASE("a camera's image comes out of its line as it went in, or not at all", "[unit]") {
    ViewedCamera camera{2, 3, {}, "right eye, 85 \xc2\xb0"};
    for (int i = 0; i < 18; ++i)
        camera.rgb.push_back(static_cast<std::byte>(13 * i));
    const ViewLine read = read_view_line(line_of(camera));
    REQUIRE(read.camera);
    CHECK(read.camera->width_px == 2);
    CHECK(read.camera->height_px == 3);
    CHECK(read.camera->rgb == camera.rgb);
    CHECK(read.camera->title == camera.title);
    for (const char* const line :
         {R"({"camera":{"width_px":2,"height_px":3,"rgb":"AAAA"}})",
          R"({"camera":{"width_px":-1,"height_px":-1,"rgb":"AAAA"}})",
          R"({"camera":{"width_px":100000,"height_px":100000,"rgb":""}})", R"({"camera":{"rgb":"A"}})"})
        CHECK(!read_view_line(line).camera);
}

TEST_CASE("a point of gaze has the pose that was lit when it came, and none between animations", "[unit]") {
    ViewBuilder builder({bust_trial()}, 0);
    const auto placed_at = [&](double at_s) {
        return builder.placed({SessionTime(from_seconds(at_s)), tracker_time(7), false, true, {3.0, 4.0}});
    };
    CHECK(placed_at(0.5).pose == -1);
    ViewNews news = news_of(ViewNews::Kind::phase, 1.0);
    news.phase = SessionPhase::stimulus;
    news.trial = 0;
    builder.apply(news);
    news.kind = ViewNews::Kind::trial_started;
    builder.apply(news);
    for (int frame = 0; frame < 5; ++frame) {
        news = news_of(ViewNews::Kind::flip, 2.0 + frame);
        news.pose = 10 + frame;
        builder.apply(news);
    }
    CHECK(placed_at(3.0).shown == 0);
    CHECK(placed_at(1.999).pose == -1);
    CHECK(placed_at(2.0).pose == 10);
    // News of a flip may come before gaze from the time before it.
    CHECK(placed_at(4.999).pose == 12);
    CHECK(placed_at(5.0).pose == 13);
    CHECK(placed_at(100.0).pose == 14);
    CHECK(placed_at(100.0).trial == 0);
    CHECK(placed_at(100.0).sampled_us == 7);
    CHECK(placed_at(100.0).place == ScreenPoint{3.0, 4.0});
    CHECK(!placed_at(100.0).is_right);
    news = news_of(ViewNews::Kind::phase, 7.0);
    news.phase = SessionPhase::response_screen;
    builder.apply(news);
    CHECK(placed_at(6.9).pose == 14);
    CHECK(placed_at(7.0).pose == -1);
}

TEST_CASE("of several slots gaze is in the one that is lit where it lies", "[unit]") {
    ViewedTrial trial = bust_trial();
    trial.shown.push_back(trial.shown.front());
    trial.shown[1].slot = 1;
    trial.shown.push_back(trial.shown.front());
    trial.shown[2].slot = 2; // where the first is, later
    ViewBuilder builder({trial}, 0,
                        {{"left", 0, 0, 100, 100}, {"right", 200, 50, 60, 60}, {"again", 0, 0, 100, 100}});
    ViewNews news = news_of(ViewNews::Kind::trial_started, 1.0);
    news.trial = 0;
    builder.apply(news);
    const auto lit = [&](int shown, double at_s, int pose) {
        news = news_of(ViewNews::Kind::flip, at_s);
        news.shown = shown;
        news.pose = pose;
        builder.apply(news);
    };
    lit(0, 2.0, 5);
    lit(1, 2.0, 9);
    lit(0, 3.0, -1);
    lit(2, 3.0, 7);
    const auto at = [&](double at_s, double x, double y) {
        return builder.placed({SessionTime(from_seconds(at_s)), tracker_time(7), true, true, {x, y}});
    };
    CHECK(at(2.5, 50.0, 50.0).shown == 0);
    CHECK(at(2.5, 50.0, 50.0).pose == 5);
    CHECK(at(2.5, 259.0, 109.0).shown == 1);
    CHECK(at(2.5, 259.0, 109.0).pose == 9);
    CHECK(at(2.5, 150.0, 50.0).shown == -1);
    CHECK(at(2.5, 150.0, 50.0).pose == -1);
    CHECK(at(3.5, 50.0, 50.0).shown == 2);
    CHECK(at(3.5, 50.0, 50.0).pose == 7);
    CHECK(builder.view().is_lit());
    const SessionFacts facts = some_facts();
    CHECK(words_of_shown(facts, some_view()) == "left: bust, matt; right: tall, matt");
}

TEST_CASE("what is no line of the language is nothing, whatever it is", "[unit]") {
    for (const char* const line :
         {"", "{", "[]", "null", "{\"state\":3}", "{\"overt_watch\":99,\"trials\":3}", "GET / HTTP/1.1",
          "\xff\xfe", "{\"event\":[]}"}) {
        const ViewLine read = read_view_line(line);
        CHECK((!read.facts && !read.view && !read.event));
        const CommandLine command = read_command_line(line);
        CHECK(!command.command);
    }
    CHECK(read_view_line("{\"overt_watch\":99}").version == 99);
    // Members of another kind than they should be leave the state as it begins.
    const ViewLine odd = read_view_line(
        R"({"state":{"trial":"x","phase":4,"lost":null,"pose":1e81,"done":1.5,"failed":4294967296}})");
    REQUIRE(odd.view);
    CHECK(odd.view->trial == -1);
    CHECK(odd.view->shown.empty());
    CHECK(odd.view->done == 0);
    CHECK(odd.view->failed == 0);
}

TEST_CASE("a command is read as it is written, and nothing else is one", "[unit]") {
    for (const char* const words : {"pause", "recalibrate", "drift check", "repeat", "reject", "skip",
                                    "skip 2", "abort", "yes", "no", "note moved the chair – 好"}) {
        const auto command = operator_command(words);
        REQUIRE(command);
        CHECK(words_of(*command) == words);
        const CommandLine read = read_command_line(line_of(*command));
        REQUIRE(read.command);
        CHECK(words_of(*read.command) == words);
    }
    CHECK(read_command_line(line_of_greeting()).greeting == view_version);
    const std::string too_long = "note " + std::string(longest_note + 1, 'x');
    for (const std::string& words :
         {std::string("skip 0"), std::string("skip 12"), std::string("Pause"), std::string("note "), too_long,
          std::string("note \xff"), std::string("note a\nb"), std::string("pause now"), std::string()})
        CHECK(!operator_command(words));
}

TEST_CASE("a view is the sum of its news, and counts stay right where some were dropped", "[unit]") {
    ViewBuilder all({bust_trial(), {}}, 0), some({bust_trial(), {}}, 0);
    std::vector<ViewNews> news;
    news.push_back(news_of(ViewNews::Kind::phase, 1.0));
    news.back().phase = SessionPhase::stimulus;
    news.back().trial = 0;
    news.push_back(news_of(ViewNews::Kind::trial_started, 1.0));
    news.back().trial = 0;
    for (int i = 1; i <= 40; ++i) {
        news.push_back(news_of(ViewNews::Kind::samples, 1.0 + 0.1 * i));
        news.back().samples = news.back().samples_in_trial = 100 * i;
        news.back().lost = news.back().lost_in_trial = i;
    }
    for (const ViewNews& one : news)
        all.apply(one);
    for (std::size_t i = 0; i < news.size(); ++i)
        if (i < 2 || i % 7 == 0 || i + 1 == news.size())
            some.apply(news[i]);
    CHECK(all.view().samples == 4000);
    CHECK(all.view().lost == 40);
    REQUIRE(all.view().shown.size() == 1);
    CHECK(all.view().shown[0].object == "bust");
    CHECK(all.view().phase == "stimulus");
    CHECK(some.view().samples == all.view().samples);
    CHECK(some.view().lost == all.view().lost);
    CHECK(some.view().time_s == all.view().time_s);
}

TEST_CASE("what the session asks stands in the view until it is answered", "[unit]") {
    ViewBuilder builder({}, 0);
    ViewNews asked = news_of(ViewNews::Kind::event, 2.0);
    asked.set_word(operator_asked_event);
    asked.set_text("Connect again?");
    const auto event = builder.apply(asked);
    REQUIRE(event);
    CHECK(event->detail == "Connect again?");
    CHECK(builder.view().asks == "Connect again?");
    ViewNews answered = news_of(ViewNews::Kind::event, 3.0);
    answered.set_word(operator_answered_event);
    builder.apply(answered);
    CHECK(builder.view().asks.empty());
}

TEST_CASE("a text that is too long for a piece of news is cut between two characters", "[unit]") {
    ViewNews news;
    std::string text(254, 'a');
    text += "é";
    news.set_text(text);
    CHECK(std::string(news.text.data()) == std::string(254, 'a'));
}

TEST_CASE("the time that is left is that of the trials to come at the pace of those that are done",
          "[unit]") {
    SessionFacts facts = some_facts();
    SessionView view = some_view();
    // Two trials of this sitting took 40 s; seven are to come.
    CHECK(time_left_s(facts, view) == Approx(140.0));
    view.done = view.done_before;
    CHECK(!time_left_s(facts, view));
    CHECK(duration_text(140.0) == "2 min 20 s");
    CHECK(duration_text({}) == "-");
}

TEST_CASE("the view as text fits the terminal, says what is wrong and shows gaze on the stimulus", "[unit]") {
    SessionFacts facts = some_facts();
    SessionView view = some_view();
    view.is_over = false;
    ViewedPicture picture{4, 4, std::vector<float>(16, 1.0f)};
    picture.lightness[0] = 0.0f;
    // The middle of the stimulus, which is in the middle of the display.
    const std::deque<ViewedGaze> gaze{{true, ScreenPoint{272.0, 96.0}}};
    std::deque<ViewedEvent> events;
    for (int i = 0; i < 50; ++i)
        events.push_back({1.0 * i, 0, "phase", std::string(200, 'x')});
    const ViewText text{facts, view, events, gaze, picture};
    const std::string screen = screen_of(text, 80, 40);
    int rows = 0, in_row = 0;
    for (const char letter : screen) {
        in_row =
            letter == '\n' ? 0 : in_row + ((static_cast<unsigned char>(letter) & 0xC0u) != 0x80u ? 1 : 0);
        rows += letter == '\n' ? 1 : 0;
        CHECK(in_row < 80);
    }
    CHECK(rows <= 38);
    for (const char* const word :
         {"trial 4 of 10", "3 of 10 trials", "2 min 20 s left", "LOST", "10.0 %", "5.0 %",
          "1.50 deg, more than 1", "too loud", "Go on?", "How old? Say it", "7 pieces"}) {
        INFO(word << "\n" << screen);
        CHECK(screen.find(word) != std::string::npos);
    }
    const std::size_t gaze_at = screen.find('O', screen.find("@@@@"));
    REQUIRE(gaze_at != std::string::npos);
    CHECK(screen[gaze_at - 1] == '@');
    CHECK(screen[gaze_at + 1] == '@');
    CHECK(summary_of(text).find("3 of 10 done") != std::string::npos);
}

TEST_CASE("missed refreshes are counted for the operator only where times are proven", "[unit]") {
    SessionFacts facts;
    SessionView view;
    view.missed_in_trial = 1;
    view.missed = 3;
    CHECK(missed_text(facts, view) == "1 in this trial, 3 in all");
    facts.is_timing_unproven = true;
    CHECK(missed_text(facts, view) == "unproven");
    // The fact travels with the others.
    const std::optional<SessionFacts> read = read_view_line(line_of(facts)).facts;
    REQUIRE(read);
    CHECK(read->is_timing_unproven);
}
