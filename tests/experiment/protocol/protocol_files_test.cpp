#include "experiment/checks/checked_protocol.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "tests/experiment/protocol/protocol_fixtures.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("a file that cannot be read is named, without a place", "[unit]") {
    Diagnostics diagnostics;
    CHECK_FALSE(read_protocol("no/such/file.toml", shipped_names, diagnostics));
    CHECK_FALSE(read_protocol(OVERT_SOURCE_DIR, shipped_names, diagnostics));
    REQUIRE(diagnostics.error_count() == 2);
    CHECK_THAT(diagnostics.print(),
               Catch::Contains("no/such/file.toml: error: cannot be read: No such file") &&
                   Catch::Contains(": error: this is a folder"));
}

TEST_CASE("files that are there are found, and those of a sequence that are not are counted", "[unit]") {
    const TemporaryFolder temporary;
    const std::filesystem::path& folder = temporary.path();
    std::filesystem::create_directories(folder / "frames");
    for (const char* name : {"m.ply", "p.toml", "frames/g_09.exr", "frames/g_11.exr", "frames/g_12.exr"})
        std::ofstream(folder / name) << "\n";
    const std::string text = std::string(minimal_protocol) +
                             "[[object]]\nid = \"m\"\nmesh = \"m.ply\"\n[[frames]]\nobject = \"m\"\n"
                             "material = \"gold\"\nfiles = \"frames/g_##.exr\"\nfirst_number = 9\n"
                             "[animation]\nframe_count = 5\n";
    std::ofstream(folder / "p.toml") << text;
    Diagnostics diagnostics;
    CHECK_FALSE(read_protocol(folder / "p.toml", shipped_names, diagnostics));
    REQUIRE(diagnostics.findings().size() == 1);
    CHECK(diagnostics.findings()[0].place == Place{18, 9});
    CHECK(diagnostics.findings()[0].message == "2 of 5 frames are missing");
    CHECK(diagnostics.findings()[0].hint == "the first is " + (folder / "frames/g_10.exr").string());
    for (const char* name : {"frames/g_10.exr", "frames/g_13.exr"})
        std::ofstream(folder / name) << "\n";
    Diagnostics complete;
    CHECK(read_protocol(folder / "p.toml", shipped_names, complete));
    CHECK(complete.print() == "");
}

TEST_CASE("the protocols shown in docs/laser_scans.md are sound", "[unit]") {
    const std::string page = text_of_file(source_path("docs/laser_scans.md"));
    const auto block_after = [&](std::size_t from) {
        const std::size_t begin = page.find("```toml\n", from) + 8;
        return page.substr(begin, page.find("```", begin) - begin);
    };
    const std::string whole = block_after(0);
    const ReadText read(whole);
    CHECK(read.diagnostics.print() == "");
    REQUIRE(read.protocol);
    CHECK(read.protocol->objects.size() == 3);
    CHECK(read.protocol->objects.at(1).areas.at(0).planes.size() == 1);
    const ReadText with_frames(whole, block_after(page.find("## Frames rendered elsewhere")));
    CHECK(with_frames.diagnostics.print() == "");
    REQUIRE(with_frames.protocol);
    CHECK(frame_file(with_frames.protocol->frames.at(0), {1}) == "frames/hermes_smooth_0002.exr");
}

TEST_CASE("the protocols that overt brings are sound", "[unit]") {
    for (const char* file : {"protocols/overt_2019.toml", "protocols/quick_look.toml"}) {
        Diagnostics diagnostics;
        CHECK(read_protocol(source_path(file), shipped_names, diagnostics));
        CHECK(diagnostics.print() == "");
    }
    const Protocol paper = paper_protocol();
    CHECK(paper.tasks.size() == 6);
    CHECK(paper.objects.size() == 3);
    CHECK(paper.materials.size() == 3);
    CHECK(paper.schedule.observers == 12);
}

TEST_CASE("no change of its bytes makes reading a protocol fail in any way but by findings", "[unit]") {
    const std::string sound = text_of_file(source_path("protocols/overt_2019.toml"));
    RandomStream random(20190728, "changed bytes");
    int refused = 0;
    for (int round = 0; round < 500; ++round) {
        std::string text = sound;
        for (int changes = 1 + static_cast<int>(random.below(8)); changes > 0; --changes) {
            const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
            switch (random.below(5)) {
            case 0:
                text[at] = static_cast<char>(random.below(256));
                break;
            case 1:
                text.erase(at, random.below(30));
                break;
            case 2:
                text.insert(
                    at, text.substr(random.below(static_cast<std::uint32_t>(text.size())), random.below(60)));
                break;
            case 3:
                text.insert(at, std::array{"é", "\u2003", "😀", "\\\n ", "\"\"\""}[random.below(5)]);
                break;
            default:
                text[at] = "[]{}=\"'#.,\n0-"[random.below(13)];
            }
        }
        const ReadText read(text);
        CHECK(read.protocol.has_value() == !read.diagnostics.has_errors());
        CHECK_NOTHROW(read.diagnostics.print());
        const int lines = 1 + static_cast<int>(std::count(text.begin(), text.end(), '\n'));
        for (const Finding& finding : read.diagnostics.findings()) {
            CHECK(finding.place.line >= 1);
            CHECK(finding.place.line <= lines);
        }
        refused += read.protocol ? 0 : 1;
    }
    CHECK(refused > 250); // the changes do reach what is checked
    CHECK(refused < 500);
}
