/// Sessions that nobody sees, without their pictures.
#include <filesystem>

#include <catch2/catch.hpp>

#include "tests/app/small_experiment.h"

namespace fs = std::filesystem;
using namespace overt::test;

TEST_CASE("a session without pictures records the same, and says so", "[session]") {
    const SmallExperiment drawn_one(Cache::own), undrawn_one(Cache::own);
    const auto exported = [&](const SmallExperiment& experiment, const std::vector<std::string>& more) {
        REQUIRE(experiment.run(more).exit_code == 0);
        fs::path out = experiment.folder().path() / "tables";
        REQUIRE(
            experiment.overt({"export", experiment.session().string(), "--out", out.string()}).exit_code ==
            0);
        return out;
    };
    // Nothing has rendered a frame for the second.
    const fs::path drawn = exported(drawn_one, {}), undrawn = exported(undrawn_one, {"--no-pictures"});
    int compared = 0;
    for (const fs::directory_entry& file : fs::directory_iterator(drawn)) {
        const std::string name = file.path().filename().string();
        if (name.find("samples") == std::string::npos && name.find("flips") == std::string::npos &&
            name.find("gaze_events") == std::string::npos)
            continue;
        const std::string text = text_of(file.path()), other = text_of(undrawn / name);
        INFO(name);
        CHECK((text == other)); // too long to be printed
        CHECK(text.size() > 500);
        ++compared;
    }
    CHECK(compared >= 2);
    CHECK_FALSE(fs::exists(undrawn_one.cache() / "frames"));
    CHECK(undrawn_one.overt({"verify", undrawn_one.session().string()}).exit_code == 0);
    CHECK(undrawn_one
              .overt({"export", undrawn_one.session().string(), "--format", "bids", "--out",
                      (undrawn_one.folder().path() / "bids").string()})
              .exit_code == 0);
    CHECK(text_of(undrawn / "events.tsv").find("stimuli: not drawn") != std::string::npos);
    CHECK(text_of(drawn / "events.tsv").find("stimuli: not drawn") == std::string::npos);
    CHECK(undrawn_one.run({"--observer", "P03", "--no-pictures", "--verify-output"}).exit_code == 2);
}
