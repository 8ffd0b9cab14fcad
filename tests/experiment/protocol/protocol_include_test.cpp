#include <catch2/catch.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

constexpr std::string_view experiment_text = "include = \"rig/lab.toml\"\n";

/// A protocol and the files it includes, in a folder.
struct Files {
    const TemporaryFolder temporary;
    std::filesystem::path folder = temporary.path();

    void write(const std::string& name, std::string_view text) const {
        std::filesystem::create_directories((folder / name).parent_path());
        std::ofstream(folder / name) << text;
    }
    std::optional<Protocol> read(const std::string& name = "p.toml") {
        diagnostics = {};
        return read_protocol(folder / name, shipped_names, diagnostics);
    }
    std::string print() const {
        std::string text = diagnostics.print();
        const std::string path = folder.string() + "/";
        for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path))
            text.erase(at, path.size());
        return text;
    }
    Diagnostics diagnostics;
};

} // namespace

TEST_CASE("what a file includes completes it; where both say something, the including file holds", "[unit]") {
    Files files;
    files.write("p.toml",
                std::string(experiment_text) + std::string(minimal_protocol) +
                    "[display]\nrefresh_hz = 60\n[[material]]\nid = \"clay\"\nkind = \"diffuse\"\n");
    files.write("rig/lab.toml",
                "[display]\nrefresh_hz = 120\nwidth_px = 1280\nwidth_mm = 520\nheight_mm = 438.75\n"
                "[tracker]\nrate_hz = 500\n[[material]]\nid = \"tin\"\nkind = \"diffuse\"\n");
    const auto protocol = files.read();
    CHECK(files.print() == "");
    REQUIRE(protocol);
    CHECK(protocol->display.refresh_hz == 60.0);
    CHECK(protocol->display.width_px == 1280);
    CHECK(protocol->tracker.rate_hz == 500.0);
    // Lists are put together, included entries first.
    REQUIRE(protocol->materials.size() == 3);
    CHECK(protocol->materials[0].id == "tin");
    CHECK(protocol->materials[2].id == "clay");
    REQUIRE(protocol->included.size() == 1);
    CHECK(protocol->included[0].name == "rig/lab.toml");
    CHECK(protocol->included[0].text == text_of_file(files.folder / "rig/lab.toml"));
}

TEST_CASE("each finding names the file in which it is, with its line", "[unit]") {
    Files files;
    files.write("p.toml", std::string(experiment_text) + std::string(minimal_protocol) +
                              "[animation]\nframe_rate = 30\n");
    files.write("rig/lab.toml",
                "# a rig\n[display]\nrefresh_hz = 0\nwidth_pix = 3\n[tracker]\nrate_hz = \"much\"\n");
    CHECK_FALSE(files.read());
    CHECK_THAT(files.print(), Contains("p.toml:14:1: error: unknown key \"frame_rate\" in [animation]") &&
                                  Contains("rig/lab.toml:3:14: error: refresh_hz: 0 is out of range") &&
                                  Contains("3 | refresh_hz = 0\n") &&
                                  Contains("rig/lab.toml:4:1: error: unknown key \"width_pix\"") &&
                                  Contains("rig/lab.toml:6:11: error: rate_hz: expected a number"));
    // Between the keys of two files: at the one that is to be changed.
    files.write("p.toml", std::string(experiment_text) + std::string(minimal_protocol));
    files.write("rig/lab.toml", "[display]\nrefresh_hz = 100\n");
    CHECK_FALSE(files.read());
    CHECK_THAT(files.print(),
               Contains("rig/lab.toml:2:14: error: a refresh rate of 100 Hz is no whole multiple"));
    // A syntax error in either file stops what could only be false alarm.
    files.write("rig/lab.toml", "[display]\nrefresh_hz = \n");
    CHECK_FALSE(files.read());
    CHECK_THAT(files.print(), Contains("rig/lab.toml:2:") && Contains("1 error"));
}

TEST_CASE("paths count from the folder of the file that they stand in", "[unit]") {
    Files files;
    files.write("p.toml", std::string(experiment_text) + std::string(minimal_protocol) +
                              "[[object]]\nid = \"here\"\nmesh = \"m.ply\"\n");
    files.write("rig/lab.toml",
                "[[object]]\nid = \"there\"\nmesh = \"m.ply\"\n[light]\nprobe = \"../sky.exr\"\n");
    files.write("m.ply", "\n");
    files.write("rig/m.ply", "\n");
    files.write("sky.exr", "\n");
    const auto protocol = files.read();
    CHECK(files.print() == "");
    REQUIRE(protocol);
    CHECK(protocol->objects[0].mesh == files.folder / "rig/m.ply");
    CHECK(protocol->objects[2].mesh == files.folder / "m.ply");
    CHECK(protocol->lights.front().probe == (files.folder / "rig/../sky.exr").string());
}

TEST_CASE("a file that includes itself is refused over any way; one included twice counts once", "[unit]") {
    Files files;
    files.write("p.toml", "include = \"a.toml\"\n" + std::string(minimal_protocol));
    files.write("a.toml", "include = [\"b.toml\"]\n");
    files.write("b.toml", "\ninclude = \"sub/../p.toml\"\n");
    CHECK_FALSE(files.read());
    CHECK_THAT(files.print(),
               Contains("b.toml:2:11: error: a file cannot include itself: p.toml includes a.toml "
                        "includes b.toml includes p.toml"));
    files.write("p.toml", "include = [\"a.toml\", \"b.toml\"]\n" + std::string(minimal_protocol));
    files.write("a.toml", "include = \"common.toml\"\n");
    files.write("b.toml", "include = \"common.toml\"\n");
    files.write("common.toml", "[[material]]\nid = \"clay\"\nkind = \"diffuse\"\n");
    const auto protocol = files.read();
    CHECK(files.print() == "");
    REQUIRE(protocol);
    CHECK(protocol->materials.size() == 2);
    CHECK(protocol->included.size() == 3);
}

TEST_CASE("two files side by side may not set the same key", "[unit]") {
    Files files;
    files.write("p.toml", "include = [\"a.toml\", \"b.toml\"]\n" + std::string(minimal_protocol));
    files.write("a.toml", "[display]\nwidth_px = 1920\n");
    files.write("b.toml", "[display]\nheight_px = 1080\nwidth_px = 1921\n");
    CHECK_FALSE(files.read());
    CHECK_THAT(files.print(),
               Contains("b.toml:3:1: error: display.width_px is set in line 2 of a.toml, too"));
}

TEST_CASE("an include that cannot be read, or that stands or is something else, is said", "[unit]") {
    Files files;
    files.write("p.toml", "include = \"none.toml\"\n" + std::string(minimal_protocol));
    CHECK_FALSE(files.read());
    CHECK_THAT(files.print(),
               Contains("p.toml:1:11: error: include \"none.toml\": cannot be read: No such file") &&
                   Contains("1 error"));
    files.write("p.toml", "include = 7\n" + std::string(minimal_protocol));
    CHECK_FALSE(files.read());
    CHECK_THAT(files.print(), Contains("p.toml:1:11: error: include: expected the path of a file"));
    files.write("p.toml", std::string(minimal_protocol) + "include = \"a.toml\"\n");
    CHECK_FALSE(files.read());
    CHECK_THAT(files.print(), Contains("p.toml:12:1: error: unknown key \"include\" in [task]") &&
                                  Contains("stands before the first section"));
}

TEST_CASE("what is included lies in the protocol's folder, or in one within", "[unit]") {
    Files files;
    files.write("lab.toml", "[tracker]\nrate_hz = 250\n");
    files.write("study/p.toml", "include = \"../lab.toml\"\n" + std::string(minimal_protocol));
    CHECK_FALSE(files.read("study/p.toml"));
    CHECK_THAT(
        files.print(),
        Contains("study/p.toml:1:11: error: include \"../lab.toml\": leads out of the protocol's folder"));
    files.write("study/p.toml", "include = \"/etc/hostname\"\n" + std::string(minimal_protocol));
    CHECK_FALSE(files.read("study/p.toml"));
    CHECK_THAT(files.print(), Contains("leads out of the protocol's folder"));
    // From a folder within back to another: the protocol's folder is what counts.
    files.write("study/p.toml", "include = \"rig/a.toml\"\n" + std::string(minimal_protocol));
    files.write("study/rig/a.toml", "include = \"../lab.toml\"\n");
    files.write("study/lab.toml", "[tracker]\nrate_hz = 500\n");
    const auto protocol = files.read("study/p.toml");
    CHECK(files.print() == "");
    REQUIRE(protocol);
    CHECK(protocol->tracker.rate_hz == 500.0);
}

TEST_CASE("a protocol is read again from the texts that a record keeps", "[unit]") {
    Files files;
    files.write("p.toml", std::string(experiment_text) + std::string(minimal_protocol));
    files.write("rig/lab.toml", "include = \"../screen.toml\"\n[tracker]\nrate_hz = 250\n");
    files.write("screen.toml", "[display]\nrefresh_hz = 60\n");
    const auto protocol = files.read();
    REQUIRE(protocol);
    IncludedTexts texts;
    for (const IncludedText& included : protocol->included)
        texts[included.name] = included.text;
    Diagnostics diagnostics;
    const auto again = read_protocol_text(protocol->text, "protocol.toml", shipped_names, diagnostics, texts);
    CHECK(diagnostics.print() == "");
    REQUIRE(again);
    CHECK(again->tracker.rate_hz == 250.0);
    CHECK(again->display.refresh_hz == 60.0);
    CHECK_FALSE(read_protocol_text(protocol->text, "protocol.toml", shipped_names, diagnostics));
}
