/// Frames of lights that are sums of others.
#include <catch2/catch.hpp>

#include "app/inputs/protocol_inputs.h"
#include "render/gl/headless_context.h"
#include "render/stimulus/stimulus_library.h"
#include "tests/app/stimuli/traced_experiment.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Two lights, and their sum with shares of each.
std::string protocol_with_sum() {
    return with(traced_protocol(), "[view]",
                "[[light]]\nid = \"key\"\nprobe = \"dark\"\nsun_lux = 3\nsun_radius_deg = 3\n"
                "[[light]]\nid = \"fill\"\nprobe = \"overcast\"\n"
                "[[light]]\nid = \"soft\"\nsum = { key = 0.25, fill = 2 }\nexposure = 0.5\n[view]");
}

} // namespace

TEST_CASE("a sum of lights is baked with its parts, and is their sum to the last bit of a frame's file",
          "[session]") {
    const SmallExperiment experiment(protocol_with_sum(), Cache::own);
    // Of the sum alone: what is rendered for it are its parts.
    const ProgramRun run = bake(experiment, {"--quality", "draft", "--stimulus", "bust/matt/soft"});
    INFO(run.out + run.err);
    REQUIRE(run.exit_code == 0);
    Diagnostics diagnostics;
    const auto read =
        read_experiment(experiment.protocol(), experiment.cache(), InputDepth::everything, diagnostics);
    INFO(diagnostics.print());
    REQUIRE(read);
    const StimulusCache cache(read->protocol, read->objects, experiment.cache());
    const FrameQuality draft = quality_of(BakeQuality::draft, read->protocol.bake);
    Stimulus soft{};
    soft.material = 1;
    soft.light = 2;
    const std::vector<Stimulus> parts = cache.parts_of(soft);
    REQUIRE(parts.size() == 2);
    CHECK(cache.missing_frames(soft, draft).empty());
    for (const Pose& pose : cache.pictures_of(soft)) {
        LinearImage sum, key, fill;
        cache.read_frame(soft, draft, pose, sum);
        // In the order of their names.
        for (const Stimulus& part : parts)
            cache.read_frame(part, draft, pose, part.light == 0 ? key : fill);
        double light = 0.0;
        for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
            const glm::vec4 expected(0.25f * glm::vec3(key.pixels[i]) + 2.0f * glm::vec3(fill.pixels[i]),
                                     key.pixels[i].a);
            // Files keep 24 bits of a number.
            CHECK(glm::length(sum.pixels[i] - expected) <= 1e-4f * glm::length(expected));
            light += static_cast<double>(sum.pixels[i].g);
        }
        CHECK(light > 10.0);
    }
    // The exposure is the sum's own.
    CHECK(cache.display_from_frame(soft, draft)[0][0] ==
          Approx(0.5 * cache.display_from_frame(parts[0], draft)[0][0]));

    // What is there already is not rendered again; a sum that is lost is added up when it is needed.
    std::filesystem::remove(cache.frame_file_of(soft, draft, cache.pictures_of(soft)[0]));
    const auto context = make_headless_context(ContextKind::osmesa);
    StimulusLibrary library(*context, read->protocol, read->objects, experiment.cache());
    library.prepare_frames(soft, {});
    CHECK(library.cache().missing_frames(soft, draft).empty());
}
