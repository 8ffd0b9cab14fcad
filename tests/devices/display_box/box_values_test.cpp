/// Numbers and edges of a display box, to their bounds.
#include <catch2/catch.hpp>

#include "devices/display_box/bits_status.h"
#include "tests/devices/display_box/box_bench.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

namespace {

/// "digital 3 down", "analogue 0 1.5".
std::string told(std::span<const BoxEvent> events) {
    std::string all;
    for (const BoxEvent& event : events) {
        constexpr std::array kinds{"trigger", "digital", "infrared", "analogue"};
        all += fmt::format("{}{} {}", all.empty() ? "" : ", ",
                           kinds[static_cast<std::size_t>(event.input.kind)], event.input.index);
        all += event.input.kind == BoxInput::Kind::analogue ? fmt::format(" {}", event.analogue_v)
               : event.active                               ? " on"
                                                            : " off";
        if (event.input.kind != BoxInput::Kind::analogue)
            CHECK(event.analogue_v == 0.0f);
    }
    return all;
}

} // namespace

TEST_CASE("each input's changes are told in the order of the fields, each with both samples' times",
          "[unit]") {
    BoxEdgeDetector edges(0.5f);
    StatusSample sample;
    sample.at = BoxTime(std::chrono::microseconds(1000));
    sample.digital.set();
    sample.infrared.set();
    CHECK(edges.feed(sample).empty()); // from where changes are counted
    StatusSample next = sample;
    next.at = BoxTime(std::chrono::microseconds(1700));
    next.trigger = true;
    next.digital[0] = next.digital[9] = false;
    next.infrared[0] = next.infrared[5] = false;
    next.analogue_v.front() = 0.5f;
    next.analogue_v.back() = -0.75f;
    const auto events = edges.feed(next);
    CHECK(told(events) ==
          "trigger 0 on, digital 0 on, digital 9 on, infrared 0 on, infrared 5 on, analogue 0 0.5, "
          "analogue 5 -0.75");
    for (const BoxEvent& event : events) {
        CHECK(event.at == next.at);
        CHECK(event.not_before == sample.at);
    }
    next.analogue_v.front() = 0.99f; // by less than the threshold from what was told
    CHECK(edges.feed(next).empty());
    next.analogue_v.front() = 1.0f;
    CHECK(told(edges.feed(next)) == "analogue 0 1");
    CHECK(told(edges.feed(sample)) ==
          "trigger 0 off, digital 0 off, digital 9 off, infrared 0 off, infrared 5 off, "
          "analogue 0 0, analogue 5 0");
    BoxEdgeDetector plain; // without a threshold no analogue input is told
    plain.feed(sample);
    CHECK(told(plain.feed(next)) == "trigger 0 on, digital 0 on, digital 9 on, infrared 0 on, infrared 5 on");
}

TEST_CASE("a display box's mode is known as it was set, read away, kept or left", "[unit]") {
    const TemporaryFolder folder;
    Bench bench;
    bench.settings.record_folder = folder.path();
    DisplayPlusPlus display = bench.open();
    CHECK_FALSE(display.mode());
    display.set_mode(BoxMode::mono_plus_plus);
    CHECK(display.mode() == BoxMode::mono_plus_plus);
    display.read_video_line(3, 4);
    CHECK_FALSE(display.mode()); // it shows its status screen
    display.set_mode(BoxMode::color_plus_plus);
    display.restore_desktop();
    CHECK(display.mode() == BoxMode::bits_plus_plus);
    CHECK(std::filesystem::is_empty(folder.path()));
    display.set_mode(BoxMode::bits_plus_plus);
    CHECK(std::filesystem::is_empty(folder.path())); // that is the desktop's own
    CHECK(box_mode_called("mono++") == BoxMode::mono_plus_plus);
    CHECK(box_mode_called("color++") == BoxMode::color_plus_plus);
    CHECK(box_mode_called("bits++") == BoxMode::bits_plus_plus);
    CHECK_FALSE(box_mode_called("Mono++"));
    CHECK(name_of(BoxMode::color_plus_plus) == "Color++");
}

TEST_CASE("a gamma table's name has up to 64 characters, and a rate is below 1000 Hz", "[unit]") {
    Bench bench;
    DisplayPlusPlus display = bench.open();
    display.select_gamma_table(std::string(64, 'a'));
    CHECK(bench.box.model.gamma_table == std::string(64, 'a'));
    CHECK_THROWS_AS(display.select_gamma_table(std::string(65, 'a')), InputError);
    CHECK_THROWS_AS(display.select_gamma_table(""), InputError);
    CHECK_THROWS_AS(display.select_gamma_table("a b"), InputError);
    display.select_gamma_table("azAZ09._-");
    for (const double rate_hz : {0.0, 59.94, 999.9}) {
        bench.box.model.rate_hz = rate_hz;
        CHECK(display.video_rate_hz() == Approx(rate_hz));
    }
    bench.box.model.rate_hz = 1000.0;
    CHECK_THROWS_AS(display.video_rate_hz(), DeviceError);
    bench.box.model.rate_hz = -1.0;
    CHECK_THROWS_AS(display.video_rate_hz(), DeviceError);
}

TEST_CASE("a box that is switched again after the way back is noted again, and so is another mode",
          "[unit]") {
    const TemporaryFolder folder;
    Bench bench;
    bench.settings.record_folder = folder.path();
    DisplayPlusPlus display = bench.open();
    for (int i = 0; i < 2; ++i) {
        display.set_mode(BoxMode::mono_plus_plus);
        CHECK_FALSE(std::filesystem::is_empty(folder.path()));
        display.restore_desktop();
        CHECK(std::filesystem::is_empty(folder.path()));
    }
}

TEST_CASE("of status that nobody fetches the last 4096 samples are kept, and those before are counted",
          "[unit]") {
    Bench bench;
    DisplayPlusPlus display = bench.open();
    display.start_status();
    const std::uint64_t first = bench.box.model.next_sample;
    for (int i = 0; i < 1000 && bench.box.model.next_sample < first + 4200; ++i) {
        bench.clock.wait_until(bench.clock.now() + 15ms);
        display.video_rate_hz(); // an answer is looked for among what comes
    }
    REQUIRE(bench.box.model.next_sample >= first + 4200);
    std::vector<std::uint64_t> numbers;
    std::array<ArrivedStatus, 64> some;
    for (std::size_t count = 1; count > 0 && numbers.size() < 4096;) {
        count = display.poll_status(some);
        for (std::size_t i = 0; i < count; ++i)
            numbers.push_back(some[i].sample.number);
    }
    REQUIRE(numbers.size() == 4096);
    for (std::size_t i = 1; i < numbers.size(); ++i)
        REQUIRE(numbers[i] == numbers[i - 1] + 1);
    CHECK(display.lost_samples() > 0);
    CHECK(numbers.front() > first);
}
