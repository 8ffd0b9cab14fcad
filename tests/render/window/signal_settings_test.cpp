#include "render/window/signal_settings.h"

#include <algorithm>
#include <cstring>
#include <fstream>

#include <catch2/catch.hpp>

#include "render/window/program_answer.h"
#include "render/window/screen_check.h"
#include "tests/support/output_properties.h"
#include "tests/support/skip.h"
#include "tests/support/two_monitors.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;
using Source = SignalSetting::Source;
using Weight = ScreenFinding::Weight;

namespace {

constexpr OutputMode packed = OutputMode::color_plus_plus;

std::string value_of(const std::vector<SignalSetting>& settings, const std::string& name) {
    const auto found = std::ranges::find(settings, name, &SignalSetting::name);
    return found == settings.end() ? "(none)" : found->value;
}

Weight weight_of(const SignalSetting& setting, OutputMode mode = packed) {
    return judge_signal(std::vector{setting}, mode, "DP-1").front().weight;
}

std::string finding_of(const SignalSetting& setting) {
    return judge_signal(std::vector{setting}, packed, "DP-1").front().finding;
}

} // namespace

TEST_CASE("the settings of an output's driver are read from the server, each in its own words", "[gl]") {
    const auto desk = TwoMonitors::start();
    if (!desk)
        OVERT_SKIP("no Xorg with the dummy driver (packages.txt), or it may not be started here");
    CHECK(value_of(read_signal_settings("DUMMY1"), "rotation") == "normal");
    CHECK(value_of(read_signal_settings("DUMMY1"), "transformation") == "none");
    CHECK(value_of(read_signal_settings("DUMMY1"), "max bpc") == "(none)");
    CHECK(read_signal_settings("DP-7").empty());

    OutputProperties driver("DUMMY1");
    driver.put_numbers("max bpc", {12});
    driver.put_word("Broadcast RGB", "Limited 16:235");
    const std::vector<std::int32_t> identity{0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1};
    driver.put_numbers("CTM", identity);
    driver.put_numbers("GAMMA_LUT", std::vector<std::int32_t>(256, 7)); // a table is no setting
    driver.put_numbers("below zero", {-3});
    const std::vector<SignalSetting> settings = read_signal_settings("DUMMY1");
    CHECK(value_of(settings, "max bpc") == "12");
    CHECK(value_of(settings, "Broadcast RGB") == "Limited 16:235");
    CHECK(value_of(settings, "CTM") == "0 1 0 0 0 0 0 0 0 1 0 0 0 0 0 0 0 1");
    CHECK(value_of(settings, "GAMMA_LUT") == "(none)");
    CHECK(value_of(settings, "below zero") == "-3");
    CHECK(value_of(read_signal_settings("DUMMY0"), "max bpc") == "(none)"); // the other monitor's own

    const std::vector<ScreenFinding> findings = judge_signal(settings, packed, "DUMMY1");
    CHECK_THROWS_WITH(refuse_unfit_screen(findings),
                      Contains("xrandr --output DUMMY1 --set \"max bpc\" 8") &&
                          Contains("xrandr --output DUMMY1 --set \"Broadcast RGB\" Full") &&
                          !Contains("CTM"));
    // The command that is given mends it.
    REQUIRE(TwoMonitors::xrandr("--output DUMMY1 --set \"max bpc\" 8"));
    CHECK(value_of(read_signal_settings("DUMMY1"), "max bpc") == "8");
}

TEST_CASE("what changes bytes is refused where they are packed, and is a risk elsewhere", "[unit]") {
    struct Case {
        SignalSetting safe;
        std::string unsafe, command;
    };
    const Case cases[] = {
        {{"max bpc", "8"}, "10", "xrandr --output DP-1 --set \"max bpc\" 8"},
        {{"max bpc", "8"}, "6", "xrandr --output DP-1 --set \"max bpc\" 8"},
        {{"Broadcast RGB", "Full"}, "Automatic", "xrandr --output DP-1 --set \"Broadcast RGB\" Full"},
        {{"dither", "off"}, "on", "xrandr --output DP-1 --set dither off"},
        {{"dithering mode", "off"}, "auto", "xrandr --output DP-1 --set \"dithering mode\" off"},
        {{"underscan", "off"}, "auto", "xrandr --output DP-1 --set underscan off"},
        {{"Colorspace", "Default"}, "BT2020_YCC", "--set Colorspace Default"},
        {{"CTM", "0 1 0 0 0 0 0 0 0 1 0 0 0 0 0 0 0 1"},
         "0 1 0 0 0 0 0 0 0 2 0 0 0 0 0 0 0 1",
         "--set CTM 0,1,0,0,0,0,0,0,0,1,0,0,0,0,0,0,0,1"},
        {{"rotation", "normal", Source::randr_crtc}, "left", "--rotate normal"},
        {{"transformation", "none", Source::randr_crtc}, "another", "--transform none"},
        {{"ColorRange", "0", Source::nvidia}, "1", "nvidia-settings -a '[dpy:DP-1]/ColorRange=0'"},
        {{"CurrentDithering", "0", Source::nvidia}, "1", "nvidia-settings -a '[dpy:DP-1]/Dithering=2'"},
    };
    for (const Case& one : cases) {
        CAPTURE(one.safe.name);
        CHECK(weight_of(one.safe) == Weight::good);
        const SignalSetting unsafe{one.safe.name, one.unsafe, one.safe.source};
        CHECK(weight_of(unsafe) == Weight::refusal);
        CHECK(weight_of(unsafe, OutputMode::native_8bit) == Weight::risk);
        CHECK_THAT(finding_of(unsafe), Contains(one.unsafe) && Contains(one.command));
    }
    CHECK(weight_of({"audio", "auto"}) == Weight::good);
    CHECK(weight_of({"max bpc", "10"}, OutputMode::native_10bit) == Weight::good);
    CHECK(weight_of({"max bpc", "8"}, OutputMode::native_10bit) == Weight::risk);
    CHECK(judge_signal({}, packed, "DP-1").front().weight == Weight::risk);
    CHECK(judge_signal({}, OutputMode::native_8bit, "DP-1").empty());
}

TEST_CASE("NVIDIA's settings are asked of its own program, and its silence is told", "[unit]") {
    const TemporaryFolder folder;
    const std::filesystem::path program = folder.path() / "nvidia-settings";
    std::ofstream(program) << "#!/bin/sh\n"
                              "[ \"$1 $2\" = \"-t -q\" ] || exit 1\n"
                              "case $3 in\n"
                              "'[dpy:DP-4]/ColorRange') echo 1 ;;\n"
                              "'[dpy:DP-4]/ColorSpace') echo 0 ;;\n"
                              "'[dpy:DP-4]/CurrentDithering') echo 0 ;;\n"
                              "*) exit 1 ;;\n"
                              "esac\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    CHECK(read_nvidia_settings("DP-4", program) ==
          std::vector<SignalSetting>{{"ColorRange", "1", Source::nvidia},
                                     {"ColorSpace", "0", Source::nvidia},
                                     {"CurrentDithering", "0", Source::nvidia}});
    for (const auto& [output, asked] :
         {std::pair{"DP-5", program.string()}, std::pair{"DP-4", std::string("no-such-program-here")}}) {
        const std::vector<SignalSetting> none = read_nvidia_settings(output, asked);
        REQUIRE(none.size() == 1);
        CHECK(weight_of(none.front()) == Weight::refusal);
        CHECK_THAT(finding_of(none.front()), Contains("apt-get install nvidia-settings"));
    }
}

TEST_CASE("a program's answer comes whole, or not at all", "[unit]") {
    using namespace std::chrono_literals;
    CHECK(program_answer({"printf", "a\\nb"}) == "a\nb");
    CHECK_FALSE(program_answer({}));
    CHECK_FALSE(program_answer({"false"}));
    CHECK_FALSE(program_answer({"no-such-program-here"}));
    CHECK_FALSE(program_answer({"sleep", "1000"}, 50ms));
    CHECK_FALSE(program_answer({"sh", "-c", "yes | head -c 200000"})); // more than anybody reads
    CHECK(program_answer({"cat"}) == "");                              // there is nothing to read
}
