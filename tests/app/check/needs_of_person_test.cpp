/// What `overt check` says first: what has to be rendered before a person can sit down.
#include <catch2/catch.hpp>

#include "tests/app/stimuli/traced_experiment.h"

using namespace overt::test;
using Catch::Contains;
using Catch::StartsWith;

TEST_CASE("check says first what a session with a person lacks, and the cheapest way that is honest",
          "[session]") {
    const std::string first_words = "Before a session with a person\n\n";
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const auto checked = [&](const std::string& quality) {
        std::string protocol = traced_protocol();
        if (!quality.empty())
            protocol += "\n[bake]\nquality = \"" + quality + "\"\n";
        experiment.folder().file("small.toml", protocol);
        const ProgramRun run = experiment.overt({"check", experiment.protocol().string()});
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        return run.out;
    };
    CHECK_THAT(checked("live"), StartsWith(first_words + "  Nothing: the protocol asks for live frames"));
    const std::string bare = checked("");
    CHECK_THAT(bare,
               StartsWith(first_words + "  It needs standard quality, and is refused until then: 0 of "));
    CHECK_THAT(bare,
               Contains("drafts, for pilots; 0 of ") && Contains("--quality draft\n") &&
                   Contains("1.8 (smooth-conductor), not measured (diffuse); of standard quality: 0.75"));
    CHECK_THAT(checked("draft"), StartsWith(first_words + "  It needs draft quality") &&
                                     !Contains("cheapest way")); // that is the way already

    REQUIRE(bake(experiment, {"--quality", "draft"}).exit_code == 0);
    CHECK_THAT(checked("draft"), StartsWith(first_words + "  Nothing: all its frames are there, of draft"));
}
