/// A spoken answer on its way into a file: its names, levels, gaps and times in numbers.
#include "devices/sound/answer_sink.h"

#include <cmath>

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
