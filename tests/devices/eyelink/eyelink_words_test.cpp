#include "devices/eyelink/eyelink_words.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/error.h"

using namespace overt;
using namespace std::chrono_literals;

namespace {

TrackerWish wish_of(double rate_hz, bool both) {
    TrackerWish wish;
    wish.rate_hz = rate_hz;
    wish.both_eyes = both;
    return wish;
}

std::string granted(std::string_view list, double rate_hz, bool both) {
    const EyelinkGrant grant = eyelink_grant(eyelink_modes(list), wish_of(rate_hz, both));
    return fmt::format("{}{}", grant.rate_hz, grant.both_eyes ? "B" : "");
}

std::string message(std::string_view text, SessionDuration age) {
    std::array<char, 40> room{};
    return std::string(eyelink_message(text, age, room));
}

} // namespace

TEST_CASE("an EyeLink grants the nearest rate that it has, of both eyes where it can", "[unit]") {
    constexpr std::string_view list = "250RB 500RB 1000B 2000";
    CHECK(granted(list, 2000, false) == "2000");
    CHECK(granted(list, 2000, true) == "1000B");
    CHECK(granted(list, 1000, true) == "1000B");
    CHECK(granted(list, 700, false) == "500");
    CHECK(granted(list, 100, false) == "250");
    CHECK(granted("2000 1000", 1000, true) == "1000"); // one eye only, as the tracker is mounted
    CHECK(granted("2000B", 1000, true) == "2000B");
    // A host that tells nothing, or nonsense.
    CHECK(granted("", 2000, true) == "1000B");
    CHECK(granted("", 2000, false) == "2000");
    CHECK(granted("B -5 99999999999 0 x1000", 500, false) == "500");
}

TEST_CASE("an EyeLink is told the screen in pixels and millimetres", "[unit]") {
    TrackerWish wish = wish_of(1000, false);
    wish.eye = Eye::left;
    EyelinkSettings settings;
    settings.calibration_points = 13;
    const auto commands = eyelink_commands(wish, settings, {1000, false}, 5.12);
    const auto has = [&](std::string_view text) {
        return std::ranges::find(commands, text, &EyelinkCommand::text) != commands.end();
    };
    CHECK(has("screen_pixel_coords = 0 0 1919 1079"));
    CHECK(has("screen_phys_coords = -349.2 196.4 349.2 -196.4"));
    CHECK(has("screen_distance = 1750"));
    CHECK(has("sample_rate = 1000"));
    CHECK(has("binocular_enabled = NO"));
    CHECK(has("active_eye = LEFT"));
    CHECK(has("calibration_type = HV13"));
    CHECK(has("select_parser_configuration = 0"));
    CHECK(eyelink_display_coords(wish.screen) == "DISPLAY_COORDS 0 0 1919 1079");
    CHECK(has("file_sample_data = LEFT,RIGHT,GAZE,HREF,AREA,HTARGET,GAZERES,BUTTON,STATUS,INPUT"));
    for (const EyelinkCommand& command : eyelink_commands(wish, settings, {1000, true}, std::nullopt)) {
        CHECK_FALSE(command.text.starts_with("active_eye"));
        CHECK(command.text.find("HTARGET") == std::string::npos); // an older host refuses it
    }
    CHECK(eyelink_software_version("EYELINK CL 4.56") == 4.56);
    CHECK_FALSE(eyelink_software_version("EYELINK"));
    CHECK_FALSE(eyelink_software_version("EYELINK CL new"));
}

TEST_CASE("an EyeLink's host says the same of a value in words of its own", "[unit]") {
    CHECK(eyelink_variable("sample_rate = 1000").name == "sample_rate");
    CHECK(eyelink_variable("sample_rate = 1000").value == "1000");
    CHECK(eyelink_variable("button_function 5 'accept'").value.empty());
    CHECK(eyelink_means_same("0 0 1919 1079", "0.00, 0.00, 1919.00, 1079.00"));
    CHECK_FALSE(eyelink_means_same("0 0 1919 1079", "0 0 1023 767"));
    CHECK_FALSE(eyelink_means_same("0 0 1919 1079", "0 0 1919"));
    CHECK(eyelink_means_same("LEFT,RIGHT,GAZE", "gaze,right,left"));
    CHECK_FALSE(eyelink_means_same("LEFT,RIGHT,GAZE", "LEFT,RIGHT"));
    CHECK(eyelink_means_same("NO", "OFF"));
    CHECK(eyelink_means_same("YES", "1"));
    CHECK_FALSE(eyelink_means_same("HV9", "HV13"));
    CHECK(eyelink_means_same("1750", "1750.0"));
}

TEST_CASE("an EyeLink's data files have names of eight letters and digits that never come again", "[unit]") {
    using namespace std::chrono;
    const sys_seconds first = sys_days(2020y / January / 1);
    CHECK(eyelink_file_name("P07", first) == "07000000");
    CHECK(eyelink_file_name("P07", first + seconds(1)) == "07000001");
    CHECK(eyelink_file_name("lab-2_b", first + seconds(35)) == "2B00000Z");
    CHECK(eyelink_file_name("x", first + seconds(36)) == "0X000010");
    CHECK(eyelink_file_name("\u00e9", first + seconds(36 * 36)) == "00000100");
    // Every second has a name of its own, and a later one stands behind in the order of names.
    const sys_seconds now = sys_days(2026y / November / 25) + 16h;
    std::string before = eyelink_file_name("01", now - seconds(1));
    for (int second = 0; second < 5000; ++second) {
        const std::string name = eyelink_file_name("01", now + seconds(second));
        REQUIRE(name.size() == 8);
        REQUIRE(name > before);
        before = name;
    }
    CHECK(eyelink_file_name("01", sys_days(2088y / December / 31)).size() == 8);
}

TEST_CASE("messages for an EyeLink's file lead with how long ago it was", "[unit]") {
    CHECK(message("SYNCTIME", 0ms) == "SYNCTIME");
    CHECK(message("SYNCTIME", 6400us) == "6 SYNCTIME");
    CHECK(message("SYNCTIME", -3ms) == "-3 SYNCTIME");
    CHECK(message("12 flips", 0ms) == "0 12 flips"); // not twelve milliseconds
    CHECK(message("-5 deg", 2ms) == "2 -5 deg");
    CHECK(message("TRIALID 4", 9ms) == "TRIALID 4");
    CHECK(message("!V TRIAL_VAR a b", 9ms) == "!V TRIAL_VAR a b");
    CHECK(message(std::string(100, 'x'), 7ms) == "7 " + std::string(38, 'x'));
    std::array<char, 2> small{};
    CHECK(eyelink_message("abc", 1234567ms, small).size() <= 2);
    CHECK(eyelink_message("abc", 0ms, {}).empty());
}

TEST_CASE("accuracy and drift are read from the EyeLink's own sentences", "[unit]") {
    const auto found = eyelink_validation(
        "VALIDATION HV13 R RIGHT GOOD ERROR 0.45 avg. 0.76 max  OFFSET 0.02 deg. -0.7,-0.5 pix.");
    REQUIRE(found);
    CHECK(found->mean_error.value == 0.45);
    CHECK(found->max_error.value == 0.76);
    CHECK_FALSE(eyelink_validation("calibration is good"));
    CHECK_FALSE(eyelink_validation("ERROR nan avg. 1 max"));
    CHECK_FALSE(eyelink_validation("ERROR 2.0 avg. 1.0 max"));
    CHECK(eyelink_drift("DRIFTCORRECT R RIGHT at 512,384  OFFSET 0.35 deg.  11.4,-4.5 pix.").value().value ==
          0.35);
    CHECK_FALSE(eyelink_drift("drift correction aborted"));
    CHECK_FALSE(eyelink_drift("OFFSET"));
}

TEST_CASE("what keeps an EyeLink from connecting or sending its file is said in words", "[unit]") {
    CHECK_FALSE(eyelink_connection_problem(0, "100.1.1.1"));
    CHECK_THAT(*eyelink_connection_problem(-201, "10.0.0.7"),
               Catch::Contains("10.0.0.7") && Catch::Contains("time-out"));
    CHECK_THAT(*eyelink_connection_problem(-202, "100.1.1.1"), Catch::Contains("version"));
    CHECK_THAT(*eyelink_connection_problem(-203, "100.1.1.1"), Catch::Contains("busy"));
    CHECK_THAT(*eyelink_connection_problem(-200, "100.1.1.1"), Catch::Contains("error -200"));
    CHECK_FALSE(eyelink_transfer_problem(1));
    for (const std::int32_t result : {0, -110, -111, -112, -113, -7})
        CHECK(eyelink_transfer_problem(result));
}

TEST_CASE(
    "the rate that is granted is the nearest below the wish, or the lowest, of the modes with both eyes",
    "[unit]") {
    const std::vector<EyelinkMode> modes{{.rate_hz = 250, .can_both_eyes = true},
                                         {.rate_hz = 2000, .can_both_eyes = false},
                                         {.rate_hz = 500, .can_both_eyes = true},
                                         {.rate_hz = 1000, .can_both_eyes = false}};
    const auto granted = [&](double rate_hz, bool both_eyes, bool knows = true) {
        TrackerWish wish;
        wish.rate_hz = rate_hz;
        wish.both_eyes = both_eyes;
        const EyelinkGrant grant =
            eyelink_grant(knows ? std::span(modes) : std::span<const EyelinkMode>(), wish);
        return std::pair(grant.rate_hz, grant.both_eyes);
    };
    CHECK(granted(1000, false) == std::pair(1000, false));
    CHECK(granted(999, false) == std::pair(500, false));
    CHECK(granted(5000, false) == std::pair(2000, false));
    CHECK(granted(100, false) == std::pair(250, false));
    CHECK(granted(1, false) == std::pair(250, false));
    CHECK(granted(2000, true) == std::pair(500, true));
    CHECK(granted(250, true) == std::pair(250, true));
    CHECK(granted(100, true) == std::pair(250, true));
    // A host that does not tell its modes has 1000 Hz with both eyes.
    CHECK(granted(2000, false, false) == std::pair(2000, false));
    CHECK(granted(2000, true, false) == std::pair(1000, true));
    CHECK(granted(500, true, false) == std::pair(500, true));
}

TEST_CASE("a message has how long ago it was, but for those that viewers read, and is cut at its room",
          "[unit]") {
    std::array<char, 24> room{};
    const auto message = [&](std::string_view text, double ms, std::size_t length = 24) {
        return std::string(eyelink_message(text, from_seconds(1e-3 * ms), std::span(room).first(length)));
    };
    CHECK(message("SYNCTIME", 0.0) == "SYNCTIME");
    CHECK(message("SYNCTIME", 0.4) == "SYNCTIME");
    CHECK(message("SYNCTIME", 12.0) == "12 SYNCTIME");
    CHECK(message("SYNCTIME", 12.6) == "13 SYNCTIME");
    CHECK(message("SYNCTIME", -3.0) == "-3 SYNCTIME");
    // What begins with a number would be taken for a time.
    for (const char* number : {"0 a", "9 a", "-a", "+a"})
        CHECK(message(number, 0.0) == std::string("0 ") + number);
    CHECK(message("/a", 0.0) == "/a");
    CHECK(message(":a", 0.0) == ":a");
    CHECK(message("", 0.0).empty());
    CHECK(message("!V TRIAL_VAR a b", 12.0) == "!V TRIAL_VAR a b");
    CHECK(message("SYNCTIME", 0.0, 4) == "SYNC");
    CHECK(message("SYNCTIME", 12.0, 6) == "12 SYN");
    CHECK(message("SYNCTIME", 12.0, 2) == "12");
    CHECK(message("SYNCTIME", 12.0, 0).empty());
}

TEST_CASE("a validation's sentence tells mean and largest error, or nothing", "[unit]") {
    const auto found =
        eyelink_validation("VALIDATION HV9 LR LEFT GOOD ERROR 0.35 avg. 0.80 max OFFSET 0.1 deg.");
    REQUIRE(found);
    CHECK(found->mean_error.value == 0.35);
    CHECK(found->max_error.value == 0.8);
    CHECK(eyelink_validation("ERROR 0.5 avg. 0.5 max")->max_error.value == 0.5);
    CHECK(eyelink_validation("ERROR 0 avg. 0 max")->mean_error.value == 0.0);
    CHECK_FALSE(eyelink_validation("ERROR 0.9 avg. 0.8 max"));
    CHECK_FALSE(eyelink_validation("ERROR -0.1 avg. 0.8 max"));
    CHECK_FALSE(eyelink_validation("ABORTED"));
}

TEST_CASE(
    "an EyeLink's file takes the last two letters or digits, in capitals, and seconds to the base of 36",
    "[unit]") {
    using namespace std::chrono;
    const sys_seconds begin = sys_days(year(2020) / January / 1);
    CHECK(eyelink_file_name("", begin) == "00000000");
    CHECK(eyelink_file_name("x", begin) == "0X000000");
    CHECK(eyelink_file_name("observer_az", begin) == "AZ000000");
    CHECK(eyelink_file_name("AZ", begin) == "AZ000000");
    CHECK(eyelink_file_name("0-9", begin) == "09000000");
    CHECK(eyelink_file_name("p@[`{/:", begin) == "0P000000"); // the neighbours of letters and digits
    CHECK(eyelink_file_name("ab", begin + seconds(35)) == "AB00000Z");
    CHECK(eyelink_file_name("ab", begin + seconds(36)) == "AB000010");
    CHECK(eyelink_file_name("ab", begin + seconds(36 * 36 * 36 * 36 * 36)) == "AB100000");
}

TEST_CASE("numbers of an EyeLink's sentences are taken to their bounds", "[unit]") {
    CHECK(eyelink_validation("ERROR 0.0 avg. 0.0 max"));
    CHECK(eyelink_validation("ERROR 0.5 avg. 0.5 max"));
    CHECK_FALSE(eyelink_validation("ERROR 0.6 avg. 0.5 max"));
    CHECK_FALSE(eyelink_validation("ERROR -0.1 avg. 0.5 max"));
    CHECK_FALSE(eyelink_validation("ERROR x avg. 0.5 max"));
    CHECK(eyelink_targets("CAL HV1 R") == 1);
    CHECK_FALSE(eyelink_targets("CAL HV0 R"));
    CHECK_FALSE(eyelink_targets("CAL HVx R"));
    CHECK(eyelink_drift("OFFSET 0.0 deg").value().value == 0.0);
    CHECK_FALSE(eyelink_drift("OFFSET -0.1 deg"));
    CHECK_FALSE(eyelink_drift("OFFSET"));
    const auto modes = eyelink_modes("0R 1B, 100000 100001\r\n2000 x");
    REQUIRE(modes.size() == 3);
    CHECK((modes[0].rate_hz == 1 && modes[0].can_both_eyes));
    CHECK((modes[1].rate_hz == 100'000 && !modes[1].can_both_eyes));
    CHECK(modes[2].rate_hz == 2000);
    TrackerWish wish;
    wish.rate_hz = 1.0;
    CHECK(eyelink_grant(modes, wish).rate_hz == 1);
    wish.rate_hz = 0.0;
    CHECK(eyelink_grant(modes, wish).rate_hz == 1); // none is as slow
    wish.rate_hz = 2000.0;
    wish.both_eyes = true;
    CHECK(eyelink_grant(modes, wish).rate_hz == 1);
    CHECK(eyelink_grant({}, wish).rate_hz == 1000);
    CHECK(eyelink_grant({}, wish).both_eyes);
    for (const auto& [told, is_same] :
         {std::pair{"10.5", true}, {"9.5", true}, {"10.6", false}, {"9.4", false}})
        CHECK(eyelink_means_same("10", told) == is_same);
}

TEST_CASE("an EyeLink's host is told all that a recording needs, and is asked what may not be otherwise",
          "[unit]") {
    TrackerWish wish = wish_of(500, false);
    const auto told = [&](const EyelinkGrant& grant, double software) {
        std::vector<std::string> lines;
        for (const EyelinkCommand& command : eyelink_commands(wish, {}, grant, software))
            lines.push_back(fmt::format("{}{} {}", command.is_needed ? "needed" : "wished",
                                        command.is_read_back ? " and asked" : "", command.text));
        return lines;
    };
    const std::vector<std::string> known{
        "needed and asked screen_pixel_coords = 0 0 1919 1079",
        "needed screen_phys_coords = -349.2 196.4 349.2 -196.4",
        "needed and asked screen_distance = 1750",
        "needed and asked sample_rate = 500",
        "wished binocular_enabled = NO",
        "needed and asked active_eye = RIGHT",
        fmt::format("needed and asked calibration_type = HV{}", EyelinkSettings{}.calibration_points),
        "wished randomize_calibration_order = YES",
        "wished randomize_validation_order = YES",
        "wished select_parser_configuration = 0",
        "needed and asked pupil_size_diameter = NO",
        "needed file_event_filter = LEFT,RIGHT,FIXATION,SACCADE,BLINK,MESSAGE,BUTTON,INPUT",
        "wished file_event_data = GAZE,GAZERES,HREF,AREA,VELOCITY,STATUS",
        "needed and asked file_sample_data = LEFT,RIGHT,GAZE,HREF,AREA,HTARGET,GAZERES,BUTTON,STATUS,INPUT",
        "needed link_event_filter = LEFT,RIGHT,FIXATION,SACCADE,BLINK,BUTTON,INPUT",
        "wished link_event_data = GAZE,GAZERES,HREF,AREA,VELOCITY,STATUS",
        "needed and asked link_sample_data = LEFT,RIGHT,GAZE,GAZERES,AREA,STATUS,INPUT",
        "wished button_function 5 'accept_target_fixation'"};
    wish.eye = Eye::right;
    CHECK(told({500, false}, 4.0) == known);
    std::vector<std::string> older = known;
    older[13] = "needed and asked file_sample_data = LEFT,RIGHT,GAZE,HREF,AREA,GAZERES,BUTTON,STATUS,INPUT";
    CHECK(told({500, false}, 3.99) == older);
    std::vector<std::string> both = known;
    both[4] = "wished binocular_enabled = YES";
    both.erase(both.begin() + 5);
    CHECK(told({500, true}, 5.0) == both);
    wish.eye = Eye::left;
    CHECK(told({500, false}, 4.0)[5] == "needed and asked active_eye = LEFT");
}

TEST_CASE("why an EyeLink is not connected, and a file does not come, is said in these words", "[unit]") {
    CHECK(eyelink_connection_problem(-203, "10.0.0.7") ==
          "The EyeLink at 10.0.0.7 is busy: another program is connected to it. End that program, or restart "
          "the host's software.");
    CHECK(eyelink_connection_problem(-202, "10.0.0.7") ==
          "The EyeLink's host runs another version than its library understands: install the library that "
          "belongs to the host's software.");
    const std::string last =
        " Is the host running its tracking software, is the network cable in, and has this "
        "computer's network card an address on the same net, such as 100.1.1.2 with mask "
        "255.255.255.0?";
    CHECK(eyelink_connection_problem(-201, "10.0.0.7") ==
          "No EyeLink answers at 10.0.0.7 (time-out)." + last);
    CHECK(eyelink_connection_problem(-1, "10.0.0.7") == "No EyeLink answers at 10.0.0.7 (error -1)." + last);
    CHECK(eyelink_connection_problem(1, "10.0.0.7") == "No EyeLink answers at 10.0.0.7 (error 1)." + last);
    CHECK(eyelink_transfer_problem(0) == "it was cancelled, or the file is empty");
    CHECK(eyelink_transfer_problem(-110) == "it was broken off");
    CHECK(eyelink_transfer_problem(-111) == "the file cannot be opened");
    CHECK(eyelink_transfer_problem(-112) == "the host does not answer");
    CHECK(eyelink_transfer_problem(-113) == "bad data arrived");
    CHECK(eyelink_transfer_problem(-1) == "error -1");
    CHECK_FALSE(eyelink_transfer_problem(1));
}

TEST_CASE("numbers that a host tells are the same within half of one, and words of truth are numbers",
          "[unit]") {
    for (const auto& [asked, told, is_same] : {std::tuple{"10", "10.5", true},
                                               {"10", "10.51", false},
                                               {"10", "9.5", true},
                                               {"10", "9.49", false},
                                               {"YES", "ON", true},
                                               {"YES", "true", true},
                                               {"yes", "1", true},
                                               {"NO", "off", true},
                                               {"NO", "FALSE", true},
                                               {"NO", "0", true},
                                               {"NO", "YES", false},
                                               {"OFF", "ON", false},
                                               {"TRUE", "FALSE", false},
                                               {"A,B", "b\ta", true},
                                               {"A,B", "A\r\nB\r\n", true},
                                               {" A", "A ,", true},
                                               {"", " ,", true},
                                               {"A", "", false},
                                               {"A", "1", false},
                                               {"1x", "1", false},
                                               {"A A", "A B", false}})
        CHECK(eyelink_means_same(asked, told) == is_same);
}
