#include "devices/eyelink/eyelink_items.h"

#include <cstring>
#include <limits>

#include <catch2/catch.hpp>

#include "tests/devices/eyelink/eyelink_bench.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

constexpr float missing_value = -32768.0f;

/// Bytes of an item, as the tables of offsets have them.
struct ItemBytes {
    std::array<std::byte, 128> bytes{};
    template <class Number> ItemBytes& at(std::size_t offset, Number number) {
        std::memcpy(bytes.data() + offset, &number, sizeof number);
        return *this;
    }
};

ItemBytes sample_item(std::uint32_t ms, std::uint16_t flags) {
    ItemBytes item;
    item.at<std::uint32_t>(0, ms).at<std::int16_t>(4, 200).at<std::uint16_t>(6, flags);
    item.at(40, 1001.5f).at(44, 1200.0f).at(48, 100.25f).at(52, 900.0f).at(56, 200.5f).at(60, 700.0f);
    return item;
}

ItemBytes eye_item(std::int16_t type, std::int16_t eye, std::uint32_t start, std::uint32_t end) {
    ItemBytes item;
    item.at<std::uint32_t>(0, end + 1).at(4, type).at(8, eye).at(12, start).at(16, end);
    return item;
}

std::int64_t us(TrackerTime time) { return time.time_since_epoch().count(); }

} // namespace

TEST_CASE("samples of an EyeLink are those of the eyes that they name, to the half millisecond", "[unit]") {
    EyelinkDecoder decoder(EyelinkEyes::right, 2000.0);
    KeptItems kept;
    decoder.take(EyelinkItem::sample, sample_item(5'000'123, 0x8000 | 0x4000).bytes, kept);
    decoder.take(EyelinkItem::sample, sample_item(5'000'123, 0x8000 | 0x0002).bytes, kept);
    decoder.take(EyelinkItem::sample, sample_item(4'294'967'295u, 0x4000).bytes, kept);
    const auto samples = kept.all<GazeSample>();
    REQUIRE(samples.size() == 4);
    CHECK(us(samples[0].sampled_at) == 5'000'123'000);
    CHECK(samples[0].eye == Eye::left);
    CHECK(samples[0].gaze == ScreenPoint{100.25, 200.5});
    CHECK(samples[0].pupil_area == 1001.5f);
    CHECK(us(samples[1].sampled_at) == 5'000'123'000);
    CHECK(samples[1].eye == Eye::right);
    CHECK(samples[1].gaze == ScreenPoint{900.0, 700.0});
    CHECK(us(samples[2].sampled_at) == 5'000'123'500);
    CHECK(samples[2].eye == Eye::left);
    CHECK(us(samples[3].sampled_at) == 4'294'967'295'000);
    CHECK(samples[3].eye == Eye::right);
    CHECK(decoder.last_sample() == samples[3].sampled_at);
}

TEST_CASE("a sample that names no eye is that of the recorded ones", "[unit]") {
    const auto [recorded, count] = GENERATE(
        table<EyelinkEyes, int>({{EyelinkEyes::left, 1}, {EyelinkEyes::right, 1}, {EyelinkEyes::both, 2}}));
    EyelinkDecoder decoder(recorded, 1000.0);
    KeptItems kept;
    decoder.take(EyelinkItem::sample, sample_item(1, 0).bytes, kept);
    const auto samples = kept.all<GazeSample>();
    REQUIRE(static_cast<int>(samples.size()) == count);
    CHECK((samples.front().eye == Eye::left) == (recorded != EyelinkEyes::right));
}

TEST_CASE("an EyeLink's missing values are a lost eye", "[unit]") {
    EyelinkDecoder decoder(EyelinkEyes::left, 1000.0);
    KeptItems kept;
    const std::uint16_t left = 0x8000;
    decoder.take(EyelinkItem::sample, sample_item(1, left).at(48, missing_value).bytes, kept);
    decoder.take(EyelinkItem::sample, sample_item(2, left).at(56, missing_value).bytes, kept);
    decoder.take(EyelinkItem::sample, sample_item(3, left).at(40, 0.0f).bytes, kept);
    decoder.take(EyelinkItem::sample, sample_item(4, left).at(40, missing_value).bytes, kept);
    decoder.take(EyelinkItem::sample,
                 sample_item(5, left).at(48, std::numeric_limits<float>::quiet_NaN()).bytes, kept);
    const auto samples = kept.all<GazeSample>();
    REQUIRE(samples.size() == 5);
    for (const GazeSample& sample : samples) {
        CHECK_FALSE(sample.gaze);
        CHECK(sample.pupil_area == 0.0f);
    }
}

TEST_CASE("an EyeLink's fixations, saccades and blinks come with the durations of its file", "[unit]") {
    KeptItems kept;
    EyelinkDecoder decoder(EyelinkEyes::both, 250.0);
    // The lines of a file at 250 Hz: EFIX L 1000 1200 204, by the rule that was measured on 2229 events.
    decoder.take(EyelinkItem::fixation_end,
                 eye_item(8, 0, 1000, 1200).at(68, 512.5f).at(72, 300.0f).at(76, 850.0f).bytes, kept);
    // 300 px and 400 px at 30 and 40 px per degree: 10 deg on each axis.
    decoder.take(EyelinkItem::saccade_end,
                 eye_item(6, 1, 1204, 1240)
                     .at(28, 100.0f)
                     .at(32, 100.0f)
                     .at(48, 400.0f)
                     .at(52, 500.0f)
                     .at(96, 29.0f)
                     .at(100, 31.0f)
                     .at(104, 39.0f)
                     .at(108, 41.0f)
                     .at(84, 420.5f)
                     .bytes,
                 kept);
    decoder.take(EyelinkItem::blink_end, eye_item(4, 1, 1300, 1396).bytes, kept);
    const auto events = kept.all<TrackerEvent>();
    REQUIRE(events.size() == 3);
    CHECK(events[0].kind == GazeEvent::Kind::fixation);
    CHECK(events[0].eye == Eye::left);
    CHECK(us(events[0].start) == 1'000'000);
    CHECK(us(events[0].end) == 1'200'000);
    CHECK(events[0].duration == 204ms);
    CHECK(events[0].place == ScreenPoint{512.5, 300.0});
    CHECK(events[0].pupil == 850.0f);
    CHECK(events[1].kind == GazeEvent::Kind::saccade);
    CHECK(events[1].eye == Eye::right);
    CHECK(events[1].duration == 40ms);
    CHECK(events[1].place == ScreenPoint{100.0, 100.0});
    CHECK(events[1].arrival == ScreenPoint{400.0, 500.0});
    CHECK(events[1].amplitude_deg.value() == Approx(14.1421));
    CHECK(events[1].peak_velocity_deg_s == 420.5f);
    CHECK(events[2].kind == GazeEvent::Kind::blink);
    CHECK(events[2].duration == 100ms);
    CHECK_FALSE(events[2].place);
}

TEST_CASE("of a saccade without resolution no amplitude is made up", "[unit]") {
    KeptItems kept;
    EyelinkDecoder decoder(EyelinkEyes::right, 1000.0);
    decoder.take(EyelinkItem::saccade_end, eye_item(6, 1, 1, 9).at(48, 400.0f).bytes, kept);
    decoder.take(EyelinkItem::saccade_end, eye_item(6, 1, 1, 9).at(28, missing_value).bytes, kept);
    REQUIRE(kept.items.size() == 2);
    CHECK_FALSE(kept.all<TrackerEvent>()[0].amplitude_deg);
    CHECK_FALSE(kept.all<TrackerEvent>()[1].place);
}

TEST_CASE("buttons and inputs of an EyeLink's host come one by one", "[unit]") {
    KeptItems kept;
    EyelinkDecoder decoder(EyelinkEyes::right, 1000.0);
    ItemBytes buttons, input;
    buttons.at<std::uint32_t>(0, 777).at<std::int16_t>(4, 25).at<std::uint16_t>(6, 0b0001'0010'0001'0000);
    input.at<std::uint32_t>(0, 778).at<std::int16_t>(4, 28).at<std::uint16_t>(6, 0xA5);
    decoder.take(EyelinkItem::button, buttons.bytes, kept);
    decoder.take(EyelinkItem::input, input.bytes, kept);
    const auto changed = kept.all<TrackerButton>();
    REQUIRE(changed.size() == 2);
    CHECK(changed[0].number == 2);
    CHECK_FALSE(changed[0].is_down);
    CHECK(changed[1].number == 5);
    CHECK(changed[1].is_down);
    CHECK(us(changed[1].at) == 777'000);
    REQUIRE(kept.all<TrackerInput>().size() == 1);
    CHECK(kept.all<TrackerInput>()[0].value == 0xA5);
}

TEST_CASE("lost data of an EyeLink's link are a gap that counts the samples", "[unit]") {
    KeptItems kept;
    EyelinkDecoder decoder(EyelinkEyes::both, 1000.0);
    decoder.take(EyelinkItem::lost_data, {}, kept); // before any sample: how many is not known
    decoder.take(EyelinkItem::sample, sample_item(100, 0x4000).bytes, kept);
    decoder.take(EyelinkItem::lost_data, {}, kept);
    decoder.take(EyelinkItem::sample, sample_item(151, 0x4000).bytes, kept);
    decoder.take(EyelinkItem::sample, sample_item(152, 0x4000).bytes, kept);
    const auto gaps = kept.all<TrackerGap>();
    REQUIRE(gaps.size() == 2);
    CHECK(gaps[0].lost_samples == 0);
    CHECK(gaps[1].lost_samples == 50);
    CHECK(us(gaps[1].after) == 100'000);
    CHECK(gaps[1].reason == TrackerGap::Reason::overflow);
    CHECK(std::holds_alternative<TrackerGap>(kept.items[2]));
}

TEST_CASE("items of an EyeLink that are cut off or of other kinds are passed over", "[unit]") {
    KeptItems kept;
    EyelinkDecoder decoder(EyelinkEyes::both, 1000.0);
    const ItemBytes sample = sample_item(100, 0xC000);
    for (std::size_t length = 0; length < 80; ++length)
        decoder.take(EyelinkItem::sample, std::span(sample.bytes).first(length), kept);
    const ItemBytes fixation = eye_item(8, 0, 1, 2);
    for (std::size_t length = 0; length < 114; ++length)
        decoder.take(EyelinkItem::fixation_end, std::span(fixation.bytes).first(length), kept);
    for (std::size_t length = 0; length < 8; ++length) {
        decoder.take(EyelinkItem::button, std::span(sample.bytes).first(length), kept);
        decoder.take(EyelinkItem::input, std::span(sample.bytes).first(length), kept);
    }
    decoder.take(EyelinkItem::fixation_end, eye_item(8, 2, 1, 2).bytes, kept);
    decoder.take(static_cast<EyelinkItem>(24), sample.bytes, kept);
    decoder.take(static_cast<EyelinkItem>(-1), sample.bytes, kept);
    CHECK(kept.items.empty());
}

TEST_CASE("a saccade of an EyeLink has an amplitude where both its ends and their resolutions are known",
          "[unit]") {
    const auto amplitude_without = [](int missing) {
        EyelinkDecoder decoder(EyelinkEyes::right, 1000.0);
        KeptItems kept;
        ItemBytes item = eye_item(6, 1, 100, 140);
        // From (100, 200) to (130, 240): 30 px at 10, and 40 px at 20 px to a degree.
        const std::pair<std::size_t, float> values[] = {{28, 100.0f}, {32, 200.0f}, {48, 130.0f},
                                                        {52, 240.0f}, {96, 8.0f},   {100, 12.0f},
                                                        {104, 15.0f}, {108, 25.0f}};
        for (int i = 0; i < 8; ++i)
            item.at(values[i].first, i == missing ? missing_value : values[i].second);
        decoder.take(EyelinkItem::saccade_end, item.bytes, kept);
        return kept.all<TrackerEvent>().at(0).amplitude_deg;
    };
    REQUIRE(amplitude_without(-1));
    CHECK(*amplitude_without(-1) == Approx(std::hypot(3.0, 2.0)));
    for (int missing = 0; missing < 8; ++missing) {
        CAPTURE(missing);
        CHECK_FALSE(amplitude_without(missing));
    }
}

TEST_CASE("an item of an EyeLink that is cut off by a byte tells nothing, and a whole one all", "[unit]") {
    for (const auto& [kind, size] :
         {std::pair{EyelinkItem::fixation_end, 114u}, {EyelinkItem::button, 8u}, {EyelinkItem::input, 8u}}) {
        EyelinkDecoder decoder(EyelinkEyes::right, 1000.0);
        KeptItems kept;
        ItemBytes item = eye_item(8, 1, 100, 140);
        if (kind != EyelinkItem::fixation_end)
            item.at<std::uint32_t>(0, 77).at<std::uint16_t>(6, 0x8181); // buttons 1 and 8 went down
        decoder.take(kind, std::span(item.bytes).first(size - 1), kept);
        CHECK(kept.items.empty());
        decoder.take(kind, std::span(item.bytes).first(size), kept);
        CHECK(kept.items.size() == (kind == EyelinkItem::button ? 2u : 1u));
        for (const TrackerButton& button : kept.all<TrackerButton>())
            CHECK((button.is_down && us(button.at) == 77'000));
        if (kind == EyelinkItem::button) {
            CHECK(kept.all<TrackerButton>()[0].number == 1);
            CHECK(kept.all<TrackerButton>()[1].number == 8);
        }
        if (kind == EyelinkItem::input)
            CHECK(kept.all<TrackerInput>()[0].value == 0x8181);
    }
}

TEST_CASE("an EyeLink's item is read where it is as long as what is read of it, and passed over where not",
          "[unit]") {
    const auto told = [](EyelinkItem kind, const ItemBytes& item, std::size_t bytes) {
        EyelinkDecoder decoder(EyelinkEyes::left, 1000.0);
        KeptItems kept;
        decoder.take(kind, std::span(item.bytes).first(bytes), kept);
        return kept.items.size();
    };
    const ItemBytes sample = sample_item(5, 0x8000), fixation = eye_item(8, 0, 5, 9);
    CHECK(told(EyelinkItem::sample, sample, 80) == 1);
    CHECK(told(EyelinkItem::sample, sample, 79) == 0);
    CHECK(told(EyelinkItem::fixation_end, fixation, 114) == 1);
    CHECK(told(EyelinkItem::fixation_end, fixation, 113) == 0);
    ItemBytes port;
    port.at<std::uint32_t>(0, 7).at<std::uint16_t>(6, 0x0101);
    CHECK(told(EyelinkItem::button, port, 8) == 1);
    CHECK(told(EyelinkItem::button, port, 7) == 0);
    CHECK(told(EyelinkItem::input, port, 8) == 1);
    CHECK(told(EyelinkItem::input, port, 7) == 0);
}

TEST_CASE("an event lasts from its start to its end and one sample, where the rate is known", "[unit]") {
    const auto lasts = [](double rate_hz) {
        EyelinkDecoder decoder(EyelinkEyes::left, rate_hz);
        KeptItems kept;
        decoder.take(EyelinkItem::blink_end, eye_item(4, 0, 100, 150).bytes, kept);
        return kept.all<TrackerEvent>().at(0).duration;
    };
    CHECK(lasts(0.0) == 50ms);
    CHECK(lasts(-1.0) == 50ms);
    CHECK(lasts(1000.0) == 51ms);
    CHECK(lasts(2000.0) == 50ms);
    CHECK(lasts(500.0) == 52ms);
    CHECK(lasts(0.5) == 2050ms);
    // Half a pixel a degree is a resolution, too; none is none.
    for (const float resolution : {0.5f, 0.0f, -1.0f}) {
        ItemBytes saccade = eye_item(6, 0, 100, 150);
        saccade.at(28, 10.0f).at(32, 20.0f).at(48, 13.0f).at(52, 24.0f);
        for (const std::size_t offset : {96u, 100u, 104u, 108u})
            saccade.at(offset, resolution);
        EyelinkDecoder decoder(EyelinkEyes::left, 1000.0);
        KeptItems kept;
        decoder.take(EyelinkItem::saccade_end, saccade.bytes, kept);
        const auto amplitude = kept.all<TrackerEvent>().at(0).amplitude_deg;
        CHECK(amplitude.has_value() == (resolution > 0.0f));
        if (amplitude)
            CHECK(*amplitude == Approx(10.0));
    }
}
