#include <catch2/catch.hpp>

#include <fmt/format.h>

#include "experiment/protocol/files/characterisation_file.h"
#include "tests/experiment/protocol/protocol_fixtures.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

using Lines = std::vector<std::string>;

namespace {

constexpr std::string_view sound_file = R"([display]
name = "Lab 3"
[screen]
width_px = 1920
[light]
black = [0.1, 0.1, 0.2]
red = [46.1, 24.1, 2.3]
green = [34.1, 76.1, 11.7]
blue = [20.1, 8.6, 105.2]
[gamma]
signal = [0, 0.5, 1]
red = [0, 0.2, 1]
green = [0, 0.25, 1]
blue = [0, 0.3, 1]
)";

std::string replaced(std::string_view text, std::string_view part, std::string_view instead) {
    std::string changed(text);
    const std::size_t at = changed.find(part);
    REQUIRE(at != std::string::npos);
    return changed.replace(at, part.size(), instead);
}

/// A characterisation read from a folder of its own.
struct ReadFile {
    explicit ReadFile(std::string_view text, std::string_view table = {}) {
        if (!table.empty())
            folder.file("table.csv", table);
        characterisation = read_characterisation(folder.file("d.toml", text), "p.toml", {3, 4}, diagnostics);
    }

    /// "file:line:column: message" of each finding.
    Lines lines() const {
        Lines lines;
        for (const Finding& finding : diagnostics.findings())
            lines.push_back(fmt::format("{}:{}:{}: {}",
                                        std::filesystem::path(finding.file).filename().string(),
                                        finding.place.line, finding.place.column, finding.message));
        return lines;
    }

    TemporaryFolder folder;
    Diagnostics diagnostics;
    std::optional<DisplayCharacterisation> characterisation;
};

std::string with_table() {
    return replaced(sound_file,
                    "signal = [0, 0.5, 1]\nred = [0, 0.2, 1]\ngreen = [0, 0.25, 1]\nblue = [0, "
                    "0.3, 1]\n",
                    "table = \"table.csv\"\n");
}

} // namespace

TEST_CASE("a sound file is read as it stands, with the black taken off", "[unit]") {
    const ReadFile read(sound_file);
    INFO(read.diagnostics.print());
    REQUIRE(read.characterisation);
    const DisplayCharacterisation& display = *read.characterisation;
    CHECK(display.display == "Lab 3");
    CHECK(display.screen.width_px == 1920);
    CHECK(display.primaries_xyz[1].y == Approx(76.0));
    CHECK(display.white_xyz().y == Approx(0.1 + 24.0 + 76.0 + 8.5));
    CHECK(display.curves[0].light_of(0.5) == Approx(0.2));
    CHECK(display.curves[2].light_of(0.5) == Approx(0.3));
    CHECK(display.sha256.size() == 64);
    CHECK(ReadFile(std::string(sound_file) + "# a remark\n").characterisation->sha256 != display.sha256);
}

TEST_CASE("a table beside the file, powers and one number for all channels are read, too", "[unit]") {
    const ReadFile table(with_table(), "# cd/m2\nsignal,blue,green,red\n0,0.5,0.4,0.3\n0.5,1.5,2.4,1.3\n1,"
                                       "2.5,10.4,5.3\n");
    INFO(table.diagnostics.print());
    REQUIRE(table.characterisation);
    CHECK(table.characterisation->curves[0].light_of(0.5) == Approx(0.2));
    CHECK(table.characterisation->curves[1].light_of(0.5) == Approx(0.2));
    CHECK(table.characterisation->curves[2].light_of(0.5) == Approx(0.5));
    REQUIRE(table.characterisation->files.size() == 2);
    CHECK(table.characterisation->files[1].name == "table.csv");
    const std::string light(sound_file.substr(0, sound_file.find("signal")));
    const ReadFile one(light + "exponent = 2.2\n");
    REQUIRE(one.characterisation);
    CHECK(one.characterisation->curves[2].exponent() == 2.2);
    const ReadFile three(light + "exponent = [2.1, 2.2, 2.3]\noffset = -0.02\n");
    REQUIRE(three.characterisation);
    CHECK(three.characterisation->curves[2].exponent() == 2.3);
    CHECK(three.characterisation->curves[0].offset() == -0.02);
}

TEST_CASE("spectra in place of XYZ give primaries and black", "[unit]") {
    std::string table = "wavelength_nm,red,green,blue,black\n";
    for (int nm = 400; nm <= 700; nm += 10)
        table += fmt::format("{},{},{},{},1e-6\n", nm, nm > 600 ? 0.004 : 1e-6,
                             nm > 500 && nm < 580 ? 0.003 : 1e-6, nm < 480 ? 0.005 : 1e-6);
    const std::string text(sound_file);
    const std::string spectral =
        text.substr(0, text.find("black")) + "spectra = \"table.csv\"\n" + text.substr(text.find("[gamma]"));
    const ReadFile read(spectral, table);
    INFO(read.diagnostics.print());
    REQUIRE(read.characterisation);
    CHECK(read.characterisation->spectra);
    CHECK(read.characterisation->black_xyz.y > 0.0);
    CHECK(read.characterisation->primaries_xyz[1].y > read.characterisation->primaries_xyz[2].y);
    CHECK(ReadFile(replaced(spectral, "spectra", "red = [1, 2, 3]\nspectra"), table).lines() ==
          Lines{"d.toml:6:7: red: the spectra already say it"});
    CHECK(ReadFile(spectral, replaced(table, "\n410,", "\n395,")).lines() ==
          Lines{"table.csv:3:1: wavelengths have to rise"});
    CHECK(ReadFile(spectral, replaced(table, "\n400,", "\n#400,")).lines() ==
          Lines{"table.csv:3:1: the spectra go from 410 to 700 nm: 400 to 700 nm is the least"});
}

TEST_CASE("each thing that is wrong with a characterisation is found at its place", "[unit]") {
    const auto lines = [](std::string_view part, std::string_view instead) {
        return ReadFile(replaced(sound_file, part, instead)).lines();
    };
    CHECK(lines("width_px", "widht_px") == Lines{"d.toml:4:1: unknown key \"widht_px\" in [screen]"});
    CHECK(lines("[gamma]", "[gama]") == Lines{"d.toml:10:2: unknown section [gama]"});
    CHECK(lines("blue = [20.1, 8.6, 105.2]", "blue = [20.1, 8.6]") ==
          Lines{"d.toml:9:8: blue: expected 3 numbers, found 2"});
    CHECK(lines("red = [46.1, 24.1, 2.3]", "red = [46.1, -1, 2.3]").size() == 1);
    CHECK(lines("green = [34.1, 76.1, 11.7]\n", "") == Lines{"d.toml:5:1: [light] has no \"green\""});
    CHECK(
        lines("green = [34.1, 76.1, 11.7]", "green = [92.1, 48.1, 4.4]") ==
        Lines{"d.toml:7:7: the matrix of the primaries has no inverse: two of them, or a mixture of two and "
              "the third, have the same colour"});
    CHECK(lines("green = [34.1, 76.1, 11.7]", "green = [0.1, 0.1, 0.2]") ==
          Lines{"d.toml:8:9: green at full signal has 0.1 cd/m2, no more than black with 0.1"});
    CHECK(lines("red = [0, 0.2, 1]", "red = [0, 0.2, 0.1]") ==
          Lines{"d.toml:12:16: red: light of 0.1 after 0.2: more signal cannot make less light"});
    CHECK(lines("red = [0, 0.2, 1]", "red = [0, -0.2, 1]") ==
          Lines{"d.toml:12:11: red: -0.2 is out of range, which is at least 0"});
    CHECK(lines("red = [0, 0.2, 1]", "red = [0.5, 0.5, 0.5]") ==
          Lines{"d.toml:12:18: red: the light is the same at all signals"});
    CHECK(lines("signal = [0, 0.5, 1]", "signal = [0, 0.5, 0.9]") ==
          Lines{"d.toml:11:19: signals go from 0 to 0.9, and not from 0 to 1"});
    CHECK(lines("signal = [0, 0.5, 1]", "signal = [0, 1, 0.5]") ==
          Lines{"d.toml:11:17: a signal of 0.5 after 1: signals have to rise"});
    CHECK(lines("blue = [0, 0.3, 1]", "blue = [0, 1]") ==
          Lines{"d.toml:14:8: blue: 2 numbers where signal has 3"});
    CHECK(lines("[gamma]", "[gamma]\nexponent = 2") ==
          Lines{"d.toml:10:1: [gamma] says twice how light follows the signal"});
    CHECK(lines("[light]", "[light]\nwhite = [100, 130, 120]") ==
          Lines{"d.toml:6:9: white was measured with 130 cd/m2, but the channels add up to 108.6"});
}

TEST_CASE("what is wrong with a table is found in the table", "[unit]") {
    const auto lines = [](std::string_view table) { return ReadFile(with_table(), table).lines(); };
    CHECK(lines("signal,red,green\n0,0,0\n1,1,1\n") == Lines{"table.csv:1:1: there is no column \"blue\""});
    CHECK(lines("signal,red,green,bleu\n0,0,0,0\n1,1,1,1\n") ==
          Lines{"table.csv:1:1: there is no column \"blue\"", "table.csv:1:18: unknown column \"bleu\""});
    CHECK(lines("signal,red,green,blue\n0,0,0,0\n0.5,1,1\n1,1,1,1\n") ==
          Lines{"table.csv:3:1: 3 columns where the line of names has 4"});
    CHECK(lines("signal,red,green,blue\n0,0,0,0\n0.5,1,x,1\n1,1,1,1\n") ==
          Lines{"table.csv:3:7: \"x\" is no number"});
    CHECK(lines("signal,red,green,blue\n0,0,0,0\n0.5,1,-1,1\n1,1,1,1\n") ==
          Lines{"table.csv:3:7: green: light of -1 is below 0"});
    CHECK(lines("signal,red,green,blue\n0.1,0,0,0\n1,1,1,1\n") ==
          Lines{"table.csv:2:1: signals go from 0.1 to 1, and not from 0 to 1"});
    CHECK(lines("# nothing\n") == Lines{"table.csv:0:0: the table has no line of column names"});
    const ReadFile missing(with_table());
    REQUIRE(missing.lines().size() == 1);
    CHECK_THAT(missing.lines()[0], Catch::StartsWith("d.toml:11:9: there is no file "));
    const ReadFile quoted(with_table(), "signal,red,green,blue\n0,0,0,0\n0.5,1,x,1\n1,1,1,1\n");
    CHECK_THAT(quoted.diagnostics.print(), Catch::Contains("0.5,1,x,1"));
}

TEST_CASE("a protocol takes the characterisation's light, and contradictions are errors at their keys",
          "[unit]") {
    const TemporaryFolder folder;
    folder.file("d.toml", sound_file);
    const auto read = [&](const std::string& display, const std::string& more = {}) {
        Diagnostics diagnostics;
        const auto protocol = read_protocol(
            folder.file("p.toml", std::string(minimal_protocol) + "[display]\n" + display + more),
            shipped_names, diagnostics);
        Lines lines;
        for (const Finding& finding : diagnostics.findings())
            lines.push_back(
                fmt::format("{}:{}: {}", finding.place.line, finding.place.column, finding.message));
        return std::pair(protocol, lines);
    };
    const std::string key = "characterisation = \"d.toml\"\n";
    const auto [sound, nothing] =
        read(key + "output = \"native-8bit\"\nbackground_cd_m2 = 54.35\n", "[screens]\ntext_cd_m2 = 108.6\n");
    CHECK(nothing.empty());
    REQUIRE(sound);
    REQUIRE(sound->display.characterisation);
    CHECK(sound->display.background == Approx(0.5));
    CHECK(sound->screens.text_grey == Approx(1.0));
    CHECK(read(key + "gamma = 2.2\n").second ==
          Lines{"14:9: the characterisation already says how light follows the signal"});
    CHECK(read(key + "width_px = 1280\nheight_px = 720\n[view]\nwidth_px = 640\nheight_px = 640\n").second ==
          Lines{"14:12: width_px is 1280 px, but d.toml was measured at 1920 px"});
    CHECK(read(key + "background = 0.5\nbackground_cd_m2 = 50\n").second ==
          Lines{"15:20: display.background already says it"});
    CHECK(read(key + "background_cd_m2 = 200\n").second ==
          Lines{"14:20: 200 cd/m2 cannot be shown: black has 0.1 cd/m2, white 108.6"});
    CHECK(read("background_cd_m2 = 20\n").second ==
          Lines{"13:20: cd/m2 need a characterisation of the display"});
    const auto missing = read("characterisation = \"e.toml\"\nbackground_cd_m2 = 20\n").second;
    REQUIRE(missing.size() == 1);
    CHECK_THAT(missing[0], Catch::StartsWith("13:20: there is no file "));
    folder.file("d.toml", replaced(sound_file, "width_px", "widht_px"));
    CHECK(read(key).second == Lines{"4:1: unknown key \"widht_px\" in [screen]"});
}
