#include "experiment/session/level_watch.h"

#include <cmath>

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

TEST_CASE("a level beyond the ends of the meter stands at its ends", "[unit]") {
    const WordSettings words;
    LevelWatch watch(words, test::at_s(0.0));
    auto bar = [&, at = 0.0](float peak, float rms) mutable {
        at += 0.2;
        return watch.take({peak, rms, false}, test::at_s(at)).value();
    };
    CHECK(bar(0.0f, 0.0f).peak == 0.0);
    CHECK(bar(1e-6f, 1e-7f).peak == 0.0);
    CHECK(bar(0.01f, 0.001f).peak == Approx(1.0 / 3.0).margin(1e-6)); // -40 dB
    CHECK(bar(0.01f, 0.001f).mean == Approx(0.0).margin(1e-6));
    CHECK(bar(2.0f, 1.0f).peak == 1.0);
    CHECK(bar(0.1f, 0.1f).mean == Approx(2.0 / 3.0).margin(1e-6));
    // No bar comes earlier than a tenth of a second after the one before, and then the loudest since.
    CHECK_FALSE(watch.take({0.5f, 0.4f, false}, test::at_s(1.25)));
    CHECK(watch.take({0.1f, 0.1f, false}, test::at_s(1.32))->peak ==
          Approx(1.0 + std::log10(0.5) / 3.0).margin(1e-6));
    // A voice of exactly -40 dB is heard, and silence said only after five seconds without one.
    LevelWatch quiet(words, test::at_s(0.0)), heard(words, test::at_s(0.0));
    heard.take({0.01f, 0.001f, false}, test::at_s(0.01));
    CHECK(quiet.take({0.009f, 0.001f, false}, test::at_s(5.0))->warning.empty());
    CHECK(quiet.take({0.009f, 0.001f, false}, test::at_s(5.2))->warning == words.no_voice);
    CHECK(heard.take({0.0f, 0.0f, false}, test::at_s(5.2))->warning.empty());
    CHECK(heard.take({1.0f, 1.0f, true}, test::at_s(6.0))->warning == words.too_loud);
    CHECK(heard.take({0.1f, 0.1f, false}, test::at_s(7.9))->warning == words.too_loud);
    CHECK(heard.take({0.1f, 0.1f, false}, test::at_s(8.1))->warning.empty());
}

namespace {

/// Its answers are complete so long after their end; never, where that is negative.
class SlowRecorder final : public AnswerRecorder {
  public:
    SlowRecorder(const Clock& clock, double after_s) : clock_(clock), after_s_(after_s) {}
    class Recording final : public AnswerRecording {
      public:
        Recording(SlowRecorder& of, int trial) : of_(of), trial_(trial) {}
        void response_screen_lit(SessionTime at) noexcept override { of_.lit.push_back(at); }
        AudioLevel level() const noexcept override { return {0.5f, 0.25f, false}; }
        void end(SessionTime at) noexcept override {
            of_.ended.push_back(at);
            ended_ = at;
        }
        std::optional<RecordedAnswer> result() override {
            if (of_.after_s_ < 0.0 || of_.clock_.now() < ended_ + from_seconds(of_.after_s_))
                return std::nullopt;
            RecordedAnswer answer;
            answer.trial = trial_;
            answer.samples = 100;
            answer.voice_onset = SessionDuration{};
            return answer;
        }

      private:
        SlowRecorder& of_;
        int trial_;
        SessionTime ended_;
    };
    std::unique_ptr<AnswerRecording> begin(const Trial& trial) override {
        begun.push_back(trial.index);
        return std::make_unique<Recording>(*this, trial.index);
    }
    std::vector<int> begun;
    std::vector<SessionTime> lit, ended;

  private:
    const Clock& clock_;
    double after_s_;
};

} // namespace

TEST_CASE("a spoken answer is recorded from its screen to its end, and waited for two seconds", "[unit]") {
    for (const double after_s : {0.0, 0.5, 1.9, 2.5, -1.0}) {
        CAPTURE(after_s);
        test::Sitting sitting(
            test::short_protocol("[answers]\nrecord = \"optional\"\n[[practice]]\ntask = \"free\"\n"
                                 "object = \"a\"\nmaterial = \"clay\"\n"));
        SlowRecorder recorder(sitting.clock, after_s);
        sitting.recorder = &recorder;
        CHECK(sitting.run().completed_trials == 2);
        CHECK(recorder.begun == std::vector<int>{0, 1}); // not in practice
        REQUIRE(recorder.lit.size() == 2);
        REQUIRE(recorder.ended.size() == 2);
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK(recorder.lit[i] == sitting.log.outcomes[i].response_screen_onset);
            CHECK(recorder.ended[i] == sitting.log.outcomes[i].responded_at);
        }
        const bool comes = after_s >= 0.0 && after_s < 2.0;
        CHECK(sitting.log.answers.size() == (comes ? 2 : 0));
        CHECK(sitting.log.details_of("answer recording") ==
              std::vector<std::string>(comes ? 0 : 2,
                                       "was not complete two seconds after its end: the file may be short"));
        if (comes)
            CHECK(sitting.log.answers[1].trial == 1);
    }
}
