#include "experiment/session/level_watch.h"

#include "tests/experiment/record/plain_session.h"
#include "tests/support/session_times.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Bars of `seconds` of the same level, looked at every four milliseconds.
std::vector<LevelBar> bars_of(LevelWatch& watch, const AudioLevel& level, double from_s, double seconds) {
    std::vector<LevelBar> bars;
    for (double at = from_s; at < from_s + seconds; at += 0.004)
        if (const auto bar = watch.take(level, at_s(at)))
            bars.push_back(*bar);
    return bars;
}

/// Hears somebody at all times.
class LoudRecorder final : public AnswerRecorder {
  public:
    class Recording final : public AnswerRecording {
      public:
        void response_screen_lit(SessionTime) noexcept override {}
        AudioLevel level() const noexcept override { return {1.0f, 0.5f, true}; }
        void end(SessionTime) noexcept override {}
        std::optional<RecordedAnswer> result() override { return RecordedAnswer(); }
    };
    std::unique_ptr<AnswerRecording> begin(const Trial&) override { return std::make_unique<Recording>(); }
};

} // namespace

TEST_CASE("the response screen has a level meter only where the protocol asks for one", "[unit]") {
    LoudRecorder recorder;
    for (const bool is_asked : {false, true}) {
        test::Sitting sitting(test::short_protocol(fmt::format(
            "[answers]\nrecord = \"optional\"\nmeter_on_screen = {}\n[words]\ntoo_loud = \"うるさい\"\n",
            is_asked)));
        sitting.protocol.screens.response_min_s = 1.0;
        sitting.recorder = &recorder;
        CHECK(sitting.run().completed_trials == 2);
        if (!is_asked) {
            CHECK(sitting.presenter.bars.empty());
            continue;
        }
        CHECK(sitting.presenter.bars.size() == Approx(20.0).margin(4.0));
        for (const LevelBar& bar : sitting.presenter.bars)
            CHECK(bar.warning == "うるさい");
    }
}

TEST_CASE("a level meter moves ten times a second, from -60 dB to full scale", "[unit]") {
    const WordSettings words;
    LevelWatch watch(words, at_s(1.0));
    const std::vector<LevelBar> bars = bars_of(watch, {1.0f, 0.0316228f, false}, 1.0, 2.0);
    CHECK(bars.size() == Approx(20.0).margin(1.0));
    CHECK(bars.back().peak == Approx(1.0));
    CHECK(bars.back().mean == Approx(0.5).margin(1e-4)); // -30 dB
    CHECK(bars_of(watch, {}, 3.1, 0.5).back() == LevelBar{});
}

TEST_CASE("clipping is said for two seconds, silence after five in which nothing was heard", "[unit]") {
    WordSettings words;
    words.too_loud = "zu laut";
    LevelWatch watch(words, at_s(0.0));
    CHECK(bars_of(watch, {0.001f, 0.0005f, false}, 0.0, 4.9).back().warning.empty());
    CHECK(bars_of(watch, {0.001f, 0.0005f, false}, 4.9, 1.0).back().warning == words.no_voice);
    CHECK(bars_of(watch, {0.2f, 0.05f, false}, 6.0, 0.3).back().warning.empty());
    CHECK(bars_of(watch, {1.0f, 0.5f, true}, 6.3, 0.3).back().warning == "zu laut");
    CHECK(bars_of(watch, {0.001f, 0.0005f, false}, 6.6, 1.5).back().warning == "zu laut");
    // Who was heard once may be silent.
    CHECK(bars_of(watch, {0.001f, 0.0005f, false}, 8.1, 20.0).back().warning.empty());
}
