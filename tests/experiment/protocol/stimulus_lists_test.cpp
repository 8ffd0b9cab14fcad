/// Lists of lights, motions and views beside objects and materials; columns of their entries, and series.
#include <catch2/catch.hpp>

#include <fstream>

#include "experiment/base/scratch_folder.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/protocol/files/written_series.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using Lines = std::vector<std::string>;
using namespace overt::test;
using Catch::Contains;

namespace {

std::vector<std::string> ids(const Protocol& protocol, std::string_view list) {
    for (std::size_t row = 0; row < stimulus_lists.size(); ++row)
        if (stimulus_lists[row].name == list) {
            const auto known = ids_in_list(protocol, row);
            return {known.begin(), known.end()};
        }
    return {};
}

/// A rough metal in place of the minimal protocol's material; its entry begins in line 10.
std::string with_rough(std::string_view keys) {
    return fmt::format("[protocol]\nname = \"p\"\n[[object]]\nid = \"a\"\nshipped = \"muse\"\n"
                       "[[task]]\nid = \"free\"\nquestion = \"Look.\"\n"
                       "[[material]]\nid = \"gloss\"\nkind = \"rough-conductor\"\n{}",
                       keys);
}

} // namespace

TEST_CASE("a protocol without lights, motions and views has one of each, called by the list's name",
          "[unit]") {
    const ReadText read(minimal_protocol);
    REQUIRE(read.protocol);
    CHECK(ids(*read.protocol, "light") == std::vector<std::string>{"light"});
    CHECK(ids(*read.protocol, "motion") == std::vector<std::string>{"motion"});
    CHECK(ids(*read.protocol, "view") == std::vector<std::string>{"view"});
    CHECK(read.protocol->motions.front().frame_count == Animation().frame_count);
}

TEST_CASE("[light], [animation] and [view] are the list of one", "[unit]") {
    const ReadText read(minimal_protocol, "[light]\nprobe = \"gallery\"\n[animation]\nduration_s = 4\n"
                                          "[view]\nid = \"front\"\nwidth_px = 200\nheight_px = 100\n");
    CHECK(read.lines().empty());
    REQUIRE(read.protocol);
    REQUIRE(read.protocol->lights.size() == 1);
    CHECK(read.protocol->lights[0].probe == "gallery");
    REQUIRE(read.protocol->motions.size() == 1);
    CHECK(read.protocol->motions[0].duration_s == 4.0);
    CHECK(ids(*read.protocol, "view") == std::vector<std::string>{"front"});
    CHECK(read.protocol->views[0].width_px == 200);
}

TEST_CASE("[[light]], [[motion]] and [[view]] make one stimulus of each entry", "[unit]") {
    const ReadText read(minimal_protocol,
                        "[[light]]\nid = \"hall\"\nprobe = \"gallery\"\n[[light]]\nid = \"sky\"\n"
                        "title = \"Cloudy sky\"\n"
                        "[[motion]]\nid = \"wide\"\n[[motion]]\nid = \"narrow\"\namplitude_deg = 5\n"
                        "[[view]]\nid = \"front\"\n[[view]]\nid = \"above\"\nmargin = 0.1\n");
    CHECK(read.lines().empty());
    REQUIRE(read.protocol);
    const Protocol& protocol = *read.protocol;
    CHECK(ids(protocol, "light") == std::vector<std::string>{"hall", "sky"});
    CHECK(protocol.lights[0].title == "hall");
    CHECK(protocol.lights[1].title == "Cloudy sky");
    const Stimulus stimulus{0, 0, 1, 1, 1};
    CHECK(protocol.light_of(stimulus).probe == "overcast");
    CHECK(protocol.motion_of(stimulus).amplitude.value == 5.0);
    CHECK(protocol.view_of(stimulus).margin == 0.1);
    CHECK(factors_of(protocol).stimulus_count() == 8);
    CHECK(stimulus_in_words(protocol, stimulus) == "a, gold, sky, narrow, above");
}

TEST_CASE("what is wrong in an entry of a list is found in that entry", "[unit]") {
    CHECK(
        ReadText(minimal_protocol, "[[light]]\nid = \"a\"\n[[light]]\nid = \"b\"\nexposure = -1\n").lines() ==
        std::vector<std::string>{"16:12: exposure: -1 is out of range, which is 1e-06 … 1000000"});
    CHECK(ReadText(minimal_protocol, "[[motion]]\nid = \"a\"\n[[motion]]\nid = \"b\"\nduration_s = 0.05\n")
              .lines() ==
          std::vector<std::string>{"16:14: 0.05 s hold 1.5 frames at 30 Hz, which is no whole number"});
    CHECK(
        ReadText(minimal_protocol, "[[view]]\nid = \"a\"\n[[view]]\nid = \"b\"\nwidth_px = 512\n").lines() ==
        std::vector<std::string>{
            "16:12: the image has another size or place on the screen than in the first view"});
    CHECK(ReadText(minimal_protocol, "[[light]]\nid = \"a\"\n[[light]]\nid = \"a\"\n").lines() ==
          std::vector<std::string>{"15:6: id \"a\" is taken already"});
    CHECK(
        ReadText(minimal_protocol, "[animation]\nduration_s = 4\n[[motion]]\nid = \"a\"\n").lines() ==
        std::vector<std::string>{"14:3: [animation] and [[motion]] are the same list, and both are written"});
    CHECK(ReadText(minimal_protocol, "[animation]\nfoo = 4\n").lines() ==
          std::vector<std::string>{"13:1: unknown key \"foo\" in [animation]"});
}

TEST_CASE("a series is written out: a value, an id and a column with the number for each entry", "[unit]") {
    const ReadText read(with_rough("title = \"Gloss\"\nseries = { roughness = [0.02, 0.2] }\n"
                                   "columns = { finish = \"high\" }\n"));
    CHECK(read.lines().empty());
    REQUIRE(read.protocol);
    const Protocol& protocol = *read.protocol;
    CHECK(ids(protocol, "material") == std::vector<std::string>{"gloss-0.02", "gloss-0.2"});
    CHECK(protocol.materials[1].roughness == 0.2);
    CHECK(protocol.materials[1].title == "Gloss 0.2");
    CHECK(protocol.materials[1].series.keys == std::vector<std::string>{"roughness"});
    const Factors factors = factors_of(protocol);
    const Factor* roughness = factors.find("roughness");
    REQUIRE(roughness);
    CHECK(roughness->levels == std::vector<FactorLevel>{{"0.02", 0.02}, {"0.2", 0.2}});
    CHECK(factors.level_of(*roughness, {}, Stimulus{0, 1}) == 1);
    CHECK(factors.at("finish").levels == std::vector<FactorLevel>{{"high"}});
}

TEST_CASE("several keys of a series go together, of any list, and of files the name is the level", "[unit]") {
    const ReadText read(std::string(minimal_protocol) +
                        "[light]\nseries = { rotation_deg = [-30, 30], exposure = [1.0, 0.5] }\n"
                        "[[object]]\nid = \"novel\"\nseries = { shipped = [\"runner\", \"scholar\"] }\n");
    CHECK(read.lines().empty());
    REQUIRE(read.protocol);
    CHECK(ids(*read.protocol, "light") == std::vector<std::string>{"light--30-1", "light-30-0.5"});
    CHECK(read.protocol->lights[1].exposure == 0.5);
    CHECK(ids(*read.protocol, "object") == std::vector<std::string>{"a", "novel-runner", "novel-scholar"});
    // Numbers rise; an entry without the column has a level of its own.
    CHECK(factors_of(*read.protocol).at("exposure").levels ==
          std::vector<FactorLevel>{{"0.5", 0.5}, {"1", 1.0}});
    CHECK(factors_of(*read.protocol).at("shipped").levels ==
          std::vector<FactorLevel>{{"n/a"}, {"runner"}, {"scholar"}});
}

TEST_CASE("faults of a series are found where they are written, each once", "[unit]") {
    const auto lines = [](std::string_view keys) { return ReadText(with_rough(keys)).lines(); };
    CHECK(lines("series = { roughness = [0.1, 0.2, 7] }\n") ==
          Lines{"12:35: roughness: 7 is out of range, which is 0.001 … 1"});
    CHECK(lines("series = { roughnes = [0.1, 0.2] }\n") ==
          Lines{"12:12: unknown key \"roughnes\" in the series of [material]"});
    CHECK(lines("series = { roughness = [0.1, 0.2], coat_ior = [1.1] }\n") ==
          Lines{"12:47: series.coat_ior has 1 value, and series.roughness has 2 values"});
    CHECK(lines("series = { roughness = [0.1, 0.10] }\n") ==
          Lines{"12:30: series.roughness: has 0.1 already"});
    CHECK(lines("series = { roughness = [] }\n") ==
          Lines{"12:24: series.roughness: expected a list of values, found an empty one"});
    CHECK(lines("series = { reflectance = [0.1] }\n") ==
          Lines{"12:12: \"reflectance\" takes a list of three numbers: a series is of a number, a word or a "
                "file"});
    CHECK(lines("roughness = 0.3\nseries = { roughness = [0.1, 0.2] }\n") ==
          Lines{"12:1: \"roughness\" is set by the series, too"});
    CHECK(lines("series = 3\n") ==
          Lines{"12:10: series: expected a table of keys with a list each, found a whole number"});
    CHECK(lines("series = { roughness = [0.1, 0.2] }\nfoo = 1\n") ==
          Lines{"13:1: unknown key \"foo\" in [material]"});
    CHECK(
        lines(
            "series = { roughness = [0.1, 0.2] }\n[[material]]\nid = \"gloss-0.2\"\nkind = \"diffuse\"\n") ==
        Lines{"14:6: id \"gloss-0.2\" is taken already"});
}

TEST_CASE("columns hold words or numbers, under names of their own", "[unit]") {
    const auto lines = [](std::string_view columns, std::string_view more = "") {
        return ReadText(with_rough(fmt::format("columns = {{ {} }}\n{}", columns, more))).lines();
    };
    CHECK(lines("gloss = \"high\", size_cm = 12").empty());
    CHECK(lines("object = 1") == Lines{"12:22: tables have a column \"object\" already"});
    CHECK(lines("angle_deg = 1") == Lines{"12:25: tables have a column \"angle_deg\" already"});
    CHECK(lines("task = 1") == Lines{"12:20: tables have a column \"task\" already"});
    CHECK(lines("\"a b\" = 1") == Lines{"12:21: \"a b\" is no name for a column"});
    CHECK(lines("gloss = true") ==
          Lines{"12:21: columns.gloss: expected a word or a number, found a truth value"});
    CHECK(lines("gloss = \"\"") == Lines{"12:21: columns.gloss: the word is empty"});
    CHECK(
        lines("gloss = 1", "[[material]]\nid = \"b\"\nkind = \"diffuse\"\ncolumns = { gloss = \"low\" }\n") ==
        Lines{"16:21: the column \"gloss\" has a word here and a number in line 12"});
    CHECK(lines("gloss = 1", "[light]\ncolumns = { gloss = 2 }\n") ==
          Lines{"14:21: entries of [[material]] have a column \"gloss\", too"});
}

TEST_CASE("a pattern in a series stands for the files that fit, and a record keeps which they were",
          "[unit]") {
    CHECK(fits_pattern("a.ply", "*.ply"));
    CHECK(fits_pattern("shape-07.ply", "shape-??.ply"));
    CHECK_FALSE(fits_pattern("a.ply.bak", "*.ply"));
    CHECK_FALSE(fits_pattern("shape-7.ply", "shape-??.ply"));

    const ScratchFolder folder("series");
    std::filesystem::create_directories(folder.path() / "shapes");
    for (const char* const name : {"b.ply", "a.ply", "a.labels", "b.labels", ".hidden.ply", "notes.txt"})
        std::ofstream(folder.path() / "shapes" / name) << "x";
    const std::string text =
        std::string(minimal_protocol) +
        "[[object]]\nid = \"novel\"\nseries = { mesh = \"shapes/*.ply\", labels = \"shapes/*.labels\" }\n";
    const std::filesystem::path file = folder.path() / "p.toml";
    std::ofstream(file) << text;
    const auto novel = [](const Protocol& protocol) {
        return std::vector<std::string>{protocol.objects.at(1).id, protocol.objects.at(2).id};
    };
    Diagnostics diagnostics;
    // From the disk; the meshes themselves are no meshes.
    read_protocol(file, shipped_names, diagnostics);
    for (const Finding& finding : diagnostics.findings())
        CHECK(finding.message.find("series") == std::string::npos);
    // From a record: what is in the folder by now does not matter.
    Diagnostics kept;
    const auto again =
        read_protocol_text(text, file, shipped_names, kept,
                           {{"shapes/*.ply", "c.ply\nd.ply\n"}, {"shapes/*.labels", "c.labels\nd.labels\n"}});
    CAPTURE(kept.print());
    REQUIRE(again);
    CHECK(novel(*again) == std::vector<std::string>{"novel-c", "novel-d"});
    CHECK(again->objects[2].mesh == folder.path() / "shapes/d.ply");
    CHECK(again->objects[2].labels == folder.path() / "shapes/d.labels");

    std::filesystem::remove(folder.path() / "shapes/b.labels");
    Diagnostics lacking;
    CHECK_FALSE(read_protocol(file, shipped_names, lacking));
    REQUIRE(lacking.error_count() == 1);
    CHECK(lacking.findings()[0].message == "series.labels: \"shapes/*.labels\" has no file for b");
    std::filesystem::remove_all(folder.path() / "shapes");
    std::filesystem::create_directories(folder.path() / "shapes");
    Diagnostics none;
    CHECK_FALSE(read_protocol(file, shipped_names, none));
    CHECK(none.findings()[0].message == "\"shapes/*.labels\": no file has such a name");
}
