/// The protocols to begin from: all that lie in protocols/, and each sound under a name of one's own.
#include "app/check/shipped_protocols.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <catch2/catch.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr std::string_view shipped_objects[] = {"muse",     "runner",   "scholar",  "shape-01",
                                                "shape-02", "shape-03", "shape-04", "shape-05",
                                                "shape-06", "shape-07", "shape-08"};

} // namespace

TEST_CASE("all protocols that are shipped can be begun from, each short enough to be read", "[unit]") {
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(source_path("protocols")))
        if (entry.is_regular_file())
            files.insert(entry.path().stem().string());
    for (const ShippedProtocol& one : shipped_protocols()) {
        CAPTURE(one.name);
        CHECK(files.erase(std::string(one.name)) == 1);
        CHECK(one.text == text_of_file(source_path(fmt::format("protocols/{}.toml", one.name))));
        // The paper's has every key explained, and the first that is read all answers.
        if (one.name != "overt_2019" && one.name != "which_is_glossier")
            CHECK(std::ranges::count(one.text, '\n') <= 80);
    }
    CHECK(files.empty());
}

TEST_CASE("what is begun from a shipped protocol is sound, and has its own name in all that it says",
          "[unit]") {
    for (const ShippedProtocol& one : shipped_protocols()) {
        CAPTURE(one.name);
        const std::string text = begun_from(one, "my_study", "studies/my_study.toml");
        // Of pictures it goes on speaking.
        if (one.pictures.empty())
            CHECK(text.find(one.name) == std::string::npos);
        else
            CHECK(text.find("protocols/") == std::string::npos);
        Diagnostics diagnostics;
        const auto protocol = read_protocol_text(text, "my_study.toml", shipped_objects, diagnostics);
        INFO(diagnostics.print());
        REQUIRE(protocol);
        CHECK(protocol->name == "my_study");
        CHECK_FALSE(diagnostics.has_errors());
    }
}

TEST_CASE("the pictures of a shipped protocol are those that lie beside it, and those that it shows",
          "[unit]") {
    for (const ShippedProtocol& one : shipped_protocols()) {
        CAPTURE(one.name);
        Diagnostics diagnostics;
        const auto protocol = read_protocol_text(one.text, source_path("protocols/p.toml").string(),
                                                 shipped_objects, diagnostics);
        REQUIRE(protocol);
        std::set<std::string> shown;
        for (const FrameSequenceSettings& frames : protocol->frames)
            for (int frame = 0; frame < protocol->motions[0].frame_count; ++frame)
                shown.insert(frame_file(frames, {frame}).string());
        std::set<std::string> shipped;
        for (const ShippedProtocol::Picture& picture : one.pictures) {
            const std::filesystem::path file = source_path("protocols") / picture.file;
            CHECK(picture.bytes == text_of_file(file));
            shipped.insert(file.string());
        }
        CHECK(shipped == shown);
    }
}
