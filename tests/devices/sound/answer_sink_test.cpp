/// A spoken answer on its way into a file: its names, levels, gaps and times in numbers.
#include "devices/sound/answer_sink.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "devices/sound/answer_engine.h"
#include "experiment/base/content_hash.h"
#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

TEST_CASE("an answer's file is named by its trial, from 1, and by its attempt from the second on", "[unit]") {
    const TemporaryFolder folder;
    CHECK(free_answer_name(folder.path(), 0) == "answers/trial_01.wav");
    CHECK(std::filesystem::is_directory(folder.path() / "answers"));
    folder.file("answers/trial_01.wav", "");
    CHECK(free_answer_name(folder.path(), 0) == "answers/trial_01_2.wav");
    folder.file("answers/trial_01_2.wav", "");
    CHECK(free_answer_name(folder.path(), 0) == "answers/trial_01_3.wav");
    CHECK(free_answer_name(folder.path(), 9) == "answers/trial_10.wav");
    CHECK(free_answer_name(folder.path(), 99) == "answers/trial_100.wav");
    CHECK_THROWS_WITH(free_answer_name(folder.path() / "none", 0),
                      Catch::StartsWith((folder.path() / "none/answers").string() + ": cannot be made: "));
}

TEST_CASE("the level is that of the last samples: their peak, their root mean square, and whether they clip",
          "[unit]") {
    const TemporaryFolder folder;
    AnswerSink sink(folder.path(), free_answer_name(folder.path(), 0), {"microphone", 1000, 16, 3ms});
    sink.add(std::vector<float>{0.5f, -0.5f, 0.5f, -0.5f}, SessionTime(1s));
    CHECK(sink.level().peak == 0.5f);
    CHECK(sink.level().rms == 0.5f);
    CHECK_FALSE(sink.level().is_clipping);
    sink.add(std::vector<float>{0.0f, -0.25f, 0.0f, 0.0f}, SessionTime(1s + 4ms));
    CHECK(sink.level().peak == 0.25f); // no higher one before counts
    CHECK(sink.level().rms == 0.125f);
    sink.add(std::vector<float>(8, 1.0f), SessionTime(1s + 8ms));
    CHECK(sink.level().is_clipping);
    sink.add({}, SessionTime(9s)); // nothing is no samples
    sink.add(std::vector<float>(4, 0.0f), SessionTime(1s + 16ms));
    CHECK_FALSE(sink.level().is_clipping);
    CHECK(sink.level().peak == 0.0f);
    sink.count_overrun();
    const RecordedAnswer answer = sink.finish(SessionTime(1s + 4ms), "");
    CHECK(answer.file == "answers/trial_01.wav");
    CHECK(answer.device == "microphone");
    CHECK(answer.sample_rate_hz == 1000);
    CHECK(answer.bits == 16);
    CHECK(answer.input_latency == 3ms);
    CHECK(answer.samples == 20);
    CHECK(answer.overruns == 1);
    CHECK(answer.lost_samples == 0);
    CHECK(answer.clipped_samples == 8);
    CHECK(answer.onset_sample == Approx(4.0));
    CHECK(answer.fault.empty());
    CHECK(answer.sha256 == hash_of_file(folder.path() / answer.file));
    CHECK(read_whole_file(folder.path() / answer.file).size() == 44 + 2 * 20);
}

TEST_CASE("samples that did not come are zeros in the file, however many, and counted", "[unit]") {
    for (const std::int64_t lost : {1, 255, 256, 257, 600}) {
        const TemporaryFolder folder;
        AnswerSink sink(folder.path(), free_answer_name(folder.path(), 2), {"microphone", 1000, 16, {}});
        sink.add(std::vector<float>(10, 0.5f), SessionTime(1s));
        sink.add_gap(lost);
        sink.add(std::vector<float>(10, 0.5f), SessionTime(1s + (10 + lost) * 1ms));
        const RecordedAnswer answer = sink.finish(SessionTime(1s), "it was cut");
        CAPTURE(lost);
        CHECK(answer.lost_samples == lost);
        CHECK(answer.overruns == 1);
        CHECK(answer.samples == 20 + lost);
        CHECK(answer.fault == "it was cut");
        const std::string bytes = read_whole_file(folder.path() / answer.file);
        REQUIRE(bytes.size() == static_cast<std::size_t>(44 + 2 * (20 + lost)));
        for (std::int64_t i = 0; i < 20 + lost; ++i) {
            const bool is_zero = bytes[static_cast<std::size_t>(44 + 2 * i)] == 0 &&
                                 bytes[static_cast<std::size_t>(45 + 2 * i)] == 0;
            REQUIRE(is_zero == (i >= 10 && i < 10 + lost));
        }
    }
}

TEST_CASE("an answer whose file cannot be had keeps its times and says why, once", "[unit]") {
    const TemporaryFolder folder;
    AnswerSink sink(folder.path(), "none/trial_01.wav", {"microphone", 1000, 16, {}});
    sink.add(std::vector<float>(100, 0.5f), SessionTime(2s));
    const RecordedAnswer answer = sink.finish(SessionTime(2s + 50ms), "another reason");
    CHECK_THAT(answer.fault, Catch::Contains("trial_01.wav"));
    CHECK(answer.samples == 100);
    CHECK(answer.onset_sample == Approx(50.0));
    // Without any sample there is no time either.
    AnswerSink empty(folder.path(), free_answer_name(folder.path(), 0), {"microphone", 1000, 16, {}});
    const RecordedAnswer none = empty.finish(SessionTime(2s), "");
    CHECK(none.samples == 0);
    CHECK(none.onset_sample == RecordedAnswer().onset_sample);
    CHECK_FALSE(none.voice_onset);
}

TEST_CASE("an answer's end is exactly where it was ended, also at the end of a block, or before all sound",
          "[unit]") {
    for (const int end_ms : {0, 16, 24, 64}) {
        const TemporaryFolder folder;
        SteadyClock clock;
        SoundRing ring(sound_ring_blocks);
        AnswerEngine engine(clock, ring, {"counting", 16000, 16, {}});
        engine.keep_in(folder.path());
        const auto recording = engine.begin({0, 0, {}});
        const SessionTime begun = clock.now();
        recording->response_screen_lit(begun);
        // Sixteen milliseconds a block. It is known where it ends before the sound comes.
        recording->end(end_ms == 0 ? SessionTime{} : begun + end_ms * 1ms);
        for (int i = 0; i < 4; ++i) {
            SoundBlock block;
            block.first_sample = 256 * i;
            block.at = begun + i * 16ms;
            block.count = 256;
            std::fill_n(block.samples.begin(), 256, 0.25f);
            REQUIRE(ring.try_push(block));
        }
        std::optional<RecordedAnswer> answer;
        for (int tries = 0; tries < 1000 && !(answer = recording->result()); ++tries)
            std::this_thread::sleep_for(2ms);
        REQUIRE(answer);
        CAPTURE(end_ms);
        CHECK(answer->fault.empty());
        CHECK(answer->samples == 16 * end_ms);
        CHECK(answer->overruns == 0);
        CHECK(answer->trial == 0);
        if (end_ms > 0)
            CHECK(recording->level().peak == 0.25f);
    }
}

TEST_CASE("sound beyond full scale is kept at full scale, of either depth, and does not turn over",
          "[unit]") {
    for (const int bits : {16, 24}) {
        const TemporaryFolder folder;
        {
            WavFile file(folder.path() / "loud.wav", 1000, bits);
            file.write(std::vector<float>{0.0f, 1.5f, -1.5f, 40.0f, -40.0f, 0.5f, 1.0f, -1.0f});
            file.close();
        }
        const std::string bytes = read_whole_file(folder.path() / "loud.wav");
        const std::size_t width = static_cast<std::size_t>(bits) / 8;
        REQUIRE(bytes.size() == 44 + 8 * width);
        std::vector<int> tops; // the highest byte of each sample
        for (std::size_t i = 0; i < 8; ++i)
            tops.push_back(static_cast<signed char>(bytes[44 + i * width + width - 1]));
        CHECK(tops == std::vector<int>{0, 127, -128, 127, -128, 64, 127, -128});
        CHECK_THROWS_WITH(WavFile(folder.path() / "loud.wav", 1000, bits),
                          Catch::Contains("there is such a file already"));
        CHECK_THROWS_WITH(WavFile(folder.path() / "none" / "a.wav", 1000, bits),
                          Catch::Contains("a.wav: cannot be written: "));
    }
}

namespace {

/// An engine in a time that a test sets, and blocks of 256 samples at 16 kHz, which take 16 ms each.
struct EngineInTime {
    EngineInTime() { engine.keep_in(folder.path()); }
    void push(std::int64_t first_sample, SessionTime at, bool is_after_overflow = false,
              float value = 0.25f) {
        SoundBlock block;
        block.first_sample = first_sample;
        block.at = at;
        block.count = 256;
        block.is_after_overflow = is_after_overflow;
        std::fill_n(block.samples.begin(), 256, value);
        REQUIRE(ring.try_push(block));
    }
    /// Until the engine has taken all that was pushed, and what it does of it.
    void settle() {
        for (int tries = 0; tries < 2000 && ring.size() > 0; ++tries)
            std::this_thread::sleep_for(1ms);
        std::this_thread::sleep_for(20ms);
    }
    static RecordedAnswer await(AnswerRecording& recording) {
        std::optional<RecordedAnswer> answer;
        for (int tries = 0; tries < 2000 && !(answer = recording.result()); ++tries)
            std::this_thread::sleep_for(1ms);
        REQUIRE(answer);
        return *answer;
    }

    TemporaryFolder folder;
    VirtualClock clock{SessionTime(100s)};
    SoundRing ring{sound_ring_blocks};
    AnswerEngine engine{clock, ring, {"microphone", 16000, 16, 3ms}};
};

} // namespace

TEST_CASE(
    "an answer has what was taken since it was begun, of the last 96 blocks before the engine knew of it",
    "[unit]") {
    EngineInTime bench;
    const SessionTime begun = bench.clock.now();
    for (int i = 0; i < 120; ++i)
        bench.push(256 * i, begun + (i - 60) * 16ms); // sixty of them before it was begun
    bench.settle();
    const auto recording = bench.engine.begin({2, 0, {}});
    recording->response_screen_lit(begun);
    recording->end(begun + 60 * 16ms);
    bench.push(256 * 120, begun + 60 * 16ms);
    const RecordedAnswer answer = EngineInTime::await(*recording);
    CHECK(answer.samples == 60 * 256);
    CHECK(answer.trial == 2);
    CHECK(answer.device == "microphone");
    CHECK(answer.onset_sample == Approx(0.0).margin(1e-3));
    CHECK(answer.fault.empty());
    CHECK(answer.overruns == 0);
    // More than 96 are not kept.
    EngineInTime other;
    for (int i = 0; i < 120; ++i)
        other.push(256 * i, other.clock.now() + i * 16ms);
    other.settle();
    const auto late = other.engine.begin({2, 0, {}});
    late->end(other.clock.now() + 120 * 16ms);
    other.push(256 * 120, other.clock.now() + 120 * 16ms);
    CHECK(EngineInTime::await(*late).samples == 96 * 256);
}

TEST_CASE("what is lost within an answer is a gap or an overrun, and what was lost before it is none",
          "[unit]") {
    EngineInTime bench;
    const auto recording = bench.engine.begin({0, 0, {}});
    const SessionTime begun = bench.clock.now();
    recording->response_screen_lit(begun);
    bench.settle();
    bench.push(1000, begun, true);                       // before it
    bench.push(1256, begun + 16ms);                      // follows
    bench.push(1512, begun + 32ms, true, 0.75f);         // the system lost something, how much is not known
    bench.push(1512 + 256 + 100, begun + 54250us, true); // a hundred samples, which the system tells too
    bench.push(1512 + 512 + 100, begun + 70250us);
    bench.settle();
    CHECK(recording->level().peak == 0.25f);
    CHECK(recording->level().rms == Approx(0.25f));
    CHECK_FALSE(recording->result());
    recording->end(begun + 86250us);
    bench.push(1512 + 768 + 100, begun + 86250us);
    const RecordedAnswer answer = EngineInTime::await(*recording);
    CHECK(answer.samples == 5 * 256 + 100);
    CHECK(answer.overruns == 2);
    CHECK(answer.lost_samples == 100);
    CHECK(answer.input_latency == 3ms);
    CHECK(answer.peak_dbfs == Approx(20.0 * std::log10(0.75)).margin(0.01));
}

TEST_CASE("an answer that another follows, that a session ends or a device leaves alone, says so", "[unit]") {
    std::unique_ptr<AnswerRecording> last;
    {
        EngineInTime bench;
        const auto first = bench.engine.begin({0, 0, {}});
        bench.settle();
        auto second = bench.engine.begin({1, 0, {}});
        CHECK(EngineInTime::await(*first).fault == "the next one began");
        // A second without sound is not too long, more is.
        bench.clock.wait_until(bench.clock.now() + 1s);
        bench.settle();
        CHECK_FALSE(second->result());
        bench.push(0, bench.clock.now());
        bench.settle();
        bench.clock.wait_until(bench.clock.now() + 1s);
        bench.settle();
        CHECK_FALSE(second->result());
        bench.clock.wait_until(bench.clock.now() + 1ns);
        const RecordedAnswer stopped = EngineInTime::await(*second);
        CHECK(stopped.fault == "the sound device gave nothing for a second");
        CHECK(stopped.samples == 256);
        CHECK(stopped.trial == 1);
        last = bench.engine.begin({2, 0, {}});
        bench.settle();
        CHECK_FALSE(last->result());
    }
    const auto ended = last->result();
    REQUIRE(ended);
    CHECK(ended->fault == "the session ended");
    EngineInTime blocked;
    blocked.folder.file("file", "no folder");
    blocked.engine.keep_in(blocked.folder.path() / "file");
    const auto refused = blocked.engine.begin({3, 0, {}});
    const RecordedAnswer none = EngineInTime::await(*refused);
    CHECK_THAT(none.fault, Catch::Contains("cannot be made"));
    CHECK(none.device == "microphone");
    CHECK(none.trial == 3);
    blocked.push(0, blocked.clock.now()); // of which nothing is written
    blocked.settle();
}
