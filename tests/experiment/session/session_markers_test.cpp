#include "experiment/session/session_markers.h"

#include <catch2/catch.hpp>

#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Takes all that it is given, and tells of it when it is asked, late by a millisecond.
class NotingSink final : public MarkerSink {
  public:
    const std::string& name() const noexcept override { return name_; }
    void mark(const Marker& marker) noexcept override {
        codes.push_back(marker.code);
        texts.emplace_back(marker.text);
        fates_.push_back({true, marker.code, marker.at, marker.at + std::chrono::milliseconds(1),
                          marker.at + std::chrono::milliseconds(2), marker.number});
    }
    std::size_t poll(std::span<SentMarker> into) noexcept override {
        const std::size_t count = std::min(into.size(), fates_.size());
        std::copy_n(fates_.begin(), count, into.begin());
        fates_.erase(fates_.begin(), fates_.begin() + static_cast<std::ptrdiff_t>(count));
        return count;
    }
    std::vector<std::string> finish() override { return {"noted: 1 marker could not be sent"}; }

    std::vector<int> codes;
    std::vector<std::string> texts;

  private:
    std::string name_ = "noting sink";
    std::vector<SentMarker> fates_;
};

class MarkerLog final : public SessionLog {
  public:
    void flip(const FlipRecord&) noexcept override {}
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override {}
    void clock_pair(const ClockPair&) noexcept override {}
    void event(const SessionEvent& event) override { events.push_back(event.detail); }
    void markers(const std::vector<RecordedMarker>& more) override {
        all.insert(all.end(), more.begin(), more.end());
    }
    void trial_started(const Trial&, SessionTime) override {}
    void trial_finished(const Trial&, const TrialOutcome&) override {}
    std::vector<RecordedMarker> all;
    std::vector<std::string> events;
};

class RaisingPresenter final : public Presenter {
  public:
    DisplayTiming timing() const override { return {}; }
    void load_slots(std::span<const PlacedStimulus>) override {}
    FlipReport show(const Screen&) override { return {}; }
    FlipReport flip_slots(std::span<const AnimationFrameIndex>) noexcept override { return {}; }
    bool closed() const noexcept override { return false; }
    void raise_with_next_flip(std::uint16_t outputs, double pulse_ms) noexcept override {
        raised.emplace_back(outputs, pulse_ms);
    }
    std::vector<std::pair<int, double>> raised;
};

Protocol marked_protocol(const std::string& outputs) {
    return short_protocol("[display]\nrefresh_hz = 120\n" + outputs);
}

FlipRecord flip_at(int refresh, int frame) {
    FlipRecord flip;
    flip.refresh_in_trial = refresh;
    flip.planned.value = flip.shown.value = frame;
    flip.report.vertical_blank = SessionTime(std::chrono::milliseconds(1000 + 8 * refresh));
    return flip;
}

} // namespace

TEST_CASE("a trial's events go to every output with its own codes, and stimuli add to the onset's",
          "[unit]") {
    const Protocol protocol = marked_protocol(
        "[[marker_output]]\nid = \"eeg\"\naddress = \"/dev/ttyS0\"\ncodes = [\"trial 1\", \"onset 10\", "
        "\"response 3\", \"result 4\"]\ncondition_codes = [\"material clay 20\"]\n"
        "[[marker_output]]\nid = \"texts\"\nkind = \"lsl\"\n");
    Sitting sitting(protocol);
    NotingSink eeg, texts;
    MarkerLog log;
    const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
    Session session(protocol, schedule, {960.0, 540.0},
                    {.clock = sitting.clock,
                     .presenter = sitting.presenter,
                     .tracker = sitting.tracker,
                     .panel = sitting.panel,
                     .log = log,
                     .listeners = {},
                     .markers = {&eeg, &texts}},
                    {});
    const SessionResult result = session.run({});
    REQUIRE_FALSE(result.aborted);
    const int clay = static_cast<int>(protocol.materials.size()) - 1;
    // Each trial, in the order of the schedule.
    std::vector<int> expected;
    for (const Trial& trial : schedule.trials)
        expected.insert(expected.end(), {1, trial.stimulus.material == clay ? 30 : 10, 3, 4});
    std::vector<int> coded;
    for (const int code : eeg.codes)
        if (code != 0)
            coded.push_back(code);
    CHECK(coded == expected);
    CHECK(texts.texts.front() == "TRIALID 1");
    CHECK(std::ranges::count(texts.texts, "SYNCTIME") == static_cast<long>(schedule.trials.size()));
    CHECK(std::ranges::count(texts.texts, "PRESENTATION_OFFSET") ==
          static_cast<long>(schedule.trials.size()));
    CHECK(std::ranges::count(texts.texts, "!V TRIAL_VAR material clay") > 0);

    // Every fate is in the record, with the output, the text and the refresh.
    CHECK(log.all.size() == eeg.codes.size() + texts.codes.size());
    int onsets = 0;
    for (const RecordedMarker& marker : log.all) {
        CHECK(marker.is_sent);
        CHECK(marker.not_before == marker.at + std::chrono::milliseconds(1));
        CHECK_FALSE(marker.text.empty());
        CHECK(marker.trial >= 0);
        if (marker.text == "SYNCTIME") {
            ++onsets;
            CHECK(marker.planned_refresh == 0);
            CHECK(marker.shown_refresh == 0);
        }
        if (marker.text == "RESPONSE")
            CHECK_FALSE(marker.planned_refresh);
    }
    CHECK(onsets == 2 * static_cast<int>(schedule.trials.size()));
    CHECK(std::ranges::count(log.events, "noted: 1 marker could not be sent") == 2);
    // And is told to the operator.
    CHECK(result.marker_warnings == std::vector<std::string>(2, "noted: 1 marker could not be sent"));
}

TEST_CASE(
    "outputs that ride on the picture are raised with the flip they belong to, and missed ones are data",
    "[unit]") {
    const Protocol protocol =
        marked_protocol("[[marker_output]]\nid = \"box\"\nkind = \"t-lock\"\npulse_ms = 2\n"
                        "codes = [\"onset 1\", \"frame 2\"]\n"
                        "refresh_codes = [\"5 8\", \"2 4\", \"7 16\"]\n");
    const std::vector<MarkerSink*> none{nullptr};
    SessionMarkers markers(protocol, none);
    RaisingPresenter presenter;
    MarkerLog log;
    const auto show = [&](int planned, int shown, int frame) {
        markers.before_flip(planned, {frame}, presenter);
        markers.flipped(flip_at(shown, frame), shown);
    };
    markers.begin_trial({}, true); // practice
    markers.begin_presentation("SYNCTIME");
    show(0, 0, 0);
    CHECK(presenter.raised.empty());

    markers.begin_trial({}, false);
    markers.begin_presentation("SYNCTIME");
    show(0, 0, 0); // the onset
    show(1, 1, 0);
    show(2, 2, 0); // a refresh of its own
    show(4, 5, 1); // a new frame, which came a refresh late
    show(6, 6, 1); // refresh 5 was never flipped to
    show(7, 7, 2); // both at once
    using Raised = std::vector<std::pair<int, double>>;
    CHECK(presenter.raised == Raised{{1, 2.0}, {4, 2.0}, {2, 2.0}, {18, 2.0}});
    markers.write_down(log);
    struct Row {
        int code, planned, shown;
        bool is_sent;
        auto operator<=>(const Row&) const = default;
    };
    std::vector<Row> rows;
    for (const RecordedMarker& marker : log.all)
        rows.push_back({marker.code, marker.planned_refresh.value_or(-1), marker.shown_refresh.value_or(-1),
                        marker.is_sent});
    CHECK(rows ==
          std::vector<Row>{
              {1, 0, 0, true}, {4, 2, 2, true}, {2, 4, 5, true}, {8, 5, -1, false}, {18, 7, 7, true}});
    // The box acts a refresh later, where the protocol does not say what was measured.
    CHECK(log.all[2].not_after ==
          flip_at(5, 1).report.vertical_blank + from_seconds(1.0 / protocol.display.refresh_hz));
    log.all.clear();
    markers.write_down(log);
    CHECK(log.all.empty());
}

TEST_CASE("outputs of the picture have on record when they rose, by the offset that was measured", "[unit]") {
    const auto risen_after = [](const std::string& offset) {
        const Protocol protocol = marked_protocol("[[marker_output]]\nid = \"box\"\nkind = \"t-lock\"\n"
                                                  "codes = [\"onset 1\"]\n" +
                                                  offset);
        const std::vector<MarkerSink*> none{nullptr};
        SessionMarkers markers(protocol, none);
        RaisingPresenter presenter;
        MarkerLog log;
        markers.begin_trial({}, false);
        markers.begin_presentation("SYNCTIME");
        markers.before_flip(0, {0}, presenter);
        markers.flipped(flip_at(0, 0), 0);
        markers.write_down(log);
        REQUIRE(log.all.size() == 1);
        CHECK(log.all[0].at == flip_at(0, 0).report.vertical_blank);
        return log.all[0].not_after - log.all[0].at;
    };
    CHECK(risen_after("offset_ms = 11.5\n") == from_seconds(0.0115));
    CHECK(risen_after("offset_ms = 0\n") == SessionDuration::zero());
}

TEST_CASE("markers that find no room are counted, and those after them are told apart", "[unit]") {
    const Protocol protocol = marked_protocol("[[marker_output]]\nid = \"texts\"\nkind = \"lsl\"\n");
    NotingSink sink;
    const std::vector<MarkerSink*> sinks{&sink};
    SessionMarkers markers(protocol, sinks);
    MarkerLog log;
    Trial trial;
    trial.index = 4;
    markers.begin_trial(trial, false);
    const auto tell = [&](int from, int to) {
        for (int i = from; i < to; ++i)
            markers.tell(SessionTime(std::chrono::milliseconds(i)), "MARK " + std::to_string(i));
    };
    tell(0, 4096 + 3);
    markers.write_down(log);
    CHECK(log.events == std::vector<std::string>{"3 markers came too fast for all of it to be recorded"});
    REQUIRE(log.all.size() == 4096 + 3);
    for (int i = 0; i < 4096; ++i) {
        REQUIRE(log.all[static_cast<std::size_t>(i)].text == "MARK " + std::to_string(i));
        REQUIRE(log.all[static_cast<std::size_t>(i)].trial == 4);
    }
    CHECK(log.all.back().text.empty()); // it was sent, and nobody knows what it was
    // Said once; room was made, and numbers go on.
    log.events.clear();
    log.all.clear();
    tell(5000, 7000);
    markers.write_down(log);
    CHECK(log.events.empty());
    REQUIRE(log.all.size() == 2000);
    for (int i = 0; i < 2000; ++i)
        REQUIRE(log.all[static_cast<std::size_t>(i)].text == "MARK " + std::to_string(5000 + i));
    log.all.clear();
    tell(8000, 8001);
    markers.write_down(log);
    REQUIRE(log.all.size() == 1);
    CHECK(log.all[0].text == "MARK 8000");
    CHECK(log.all[0].at == SessionTime(std::chrono::milliseconds(8000)));
    CHECK(log.all[0].output == "texts");
}

TEST_CASE("a marker's text is cut at its longest, and practice marks nothing", "[unit]") {
    const Protocol protocol = marked_protocol("[[marker_output]]\nid = \"texts\"\nkind = \"lsl\"\n");
    NotingSink sink;
    const std::vector<MarkerSink*> sinks{&sink};
    SessionMarkers markers(protocol, sinks);
    MarkerLog log;
    markers.begin_trial({}, true);
    markers.tell(SessionTime(), "practice");
    CHECK(sink.texts.empty());
    markers.begin_trial({}, false);
    const std::string text(longest_marker + 5, 'x');
    markers.tell(SessionTime(), text);
    markers.write_down(log);
    REQUIRE(log.all.size() == 1);
    CHECK(log.all[0].text == text.substr(0, longest_marker));
    CHECK_FALSE(log.all[0].planned_refresh);
    CHECK_FALSE(log.all[0].shown_refresh);
}

TEST_CASE("what outputs tell at their end is recorded, too", "[unit]") {
    const Protocol protocol = marked_protocol("[[marker_output]]\nid = \"texts\"\nkind = \"lsl\"\n"
                                              "[[marker_output]]\nid = \"none\"\nkind = \"lsl\"\n");
    NotingSink sink;
    const std::vector<MarkerSink*> sinks{&sink, nullptr}; // the second is left out
    SessionMarkers markers(protocol, sinks);
    MarkerLog log;
    markers.begin_trial({}, false);
    markers.tell(SessionTime(std::chrono::seconds(1)), "LAST");
    CHECK(markers.finish(log) == std::vector<std::string>{"noted: 1 marker could not be sent"});
    REQUIRE(log.all.size() == 1);
    CHECK(log.all[0].text == "LAST");
    CHECK(log.all[0].output == "texts");
    CHECK(log.all[0].not_after == SessionTime(std::chrono::milliseconds(1002)));
}
