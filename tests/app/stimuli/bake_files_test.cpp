/// The files that `overt bake` writes for other programs and for a look.
#include <catch2/catch.hpp>

#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/inputs/protocol_inputs.h"
#include "experiment/spectra/spectra.h"
#include "render/gl/headless_context.h"
#include "render/image/linear_image.h"
#include "render/stimulus/stimulus_library.h"
#include "tests/app/stimuli/traced_experiment.h"
#include "tests/support/gl_contexts.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("exported frames, given back as ready-made ones, are the same light", "[session]") {
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const std::filesystem::path folder = experiment.folder().path();
    REQUIRE(bake(experiment,
                 {"--quality", "draft", "--stimulus", "bust/smooth", "--out", (folder / "display").string()})
                .exit_code == 0);
    REQUIRE(bake(experiment, {"--quality", "draft", "--stimulus", "bust/smooth", "--out",
                              (folder / "xyz").string(), "--as", "xyz"})
                .exit_code == 0);
    const std::string frames = "[[frames]]\nobject = \"bust\"\nmaterial = \"smooth\"\n";
    const auto light_of = [&](const std::string& name, const std::string& more) {
        experiment.folder().file(name, traced_protocol() + more);
        Diagnostics diagnostics;
        const auto read =
            read_experiment(folder / name, experiment.cache(), InputDepth::everything, diagnostics);
        INFO(diagnostics.print());
        REQUIRE(read);
        const auto context = make_headless_context(ContextKind::osmesa);
        StimulusLibrary library(*context, read->protocol, read->objects, experiment.cache());
        library.prepare_frames({0, 0}, {});
        return library.page({0, 0}, library.page_of_frame({0, 0})[2]);
    };
    const LinearImage rendered = light_of("a.toml", "");
    const LinearImage display =
        light_of("b.toml", frames + "files = \"display/bust_smooth/frame_####.exr\"\n");
    const LinearImage xyz =
        light_of("c.toml", frames + "files = \"xyz/bust_smooth/frame_####.exr\"\ncolour_space = \"xyz\"\n");
    const LinearImage doubled =
        light_of("d.toml", frames + "files = \"display/bust_smooth/frame_####.exr\"\nexposure = 2\n");
    float brightest = 0.0f;
    for (std::size_t i = 0; i < rendered.pixels.size(); ++i) {
        const glm::vec4& pixel = rendered.pixels[i];
        brightest = std::max(brightest, pixel.y);
        for (const glm::vec4& other : {display.pixels[i], xyz.pixels[i]}) {
            // Half floats have 11 bits; XYZ mixes three of them.
            const float largest = std::max({std::abs(pixel.x), std::abs(pixel.y), std::abs(pixel.z), 1e-3f});
            CHECK(glm::distance(glm::vec3(other), glm::vec3(pixel)) < 0.004f * largest);
            CHECK(std::abs(other.w - pixel.w) < 0.0006f);
        }
        const glm::vec4 &once = display.pixels[i], &twice = doubled.pixels[i];
        CHECK(twice == glm::vec4(2.0f * glm::vec3(once), once.w));
    }
    CHECK(brightest > 0.1f);
}

TEST_CASE("an exported frame names its channels and everything that made it", "[session]") {
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const std::filesystem::path out = experiment.folder().path() / "out";
    const std::vector<std::string> wish{"--quality", "draft", "--stimulus", "tall/matt", "--frames", "2-3"};
    const auto with_more = [&](std::vector<std::string> more) {
        more.insert(more.begin(), wish.begin(), wish.end());
        return bake(experiment, more);
    };
    REQUIRE(with_more({"--out", (out / "s").string(), "--as", "spectra"}).exit_code == 0);
    REQUIRE(files_below(out / "s") ==
            std::vector<std::filesystem::path>{"tall_matt/frame_0002.exr", "tall_matt/frame_0003.exr"});
    const PictureHeader header = header_of(out / "s/tall_matt/frame_0003.exr");
    REQUIRE(header.channels.size() == 32);
    CHECK(header.type == PixelType::float32);
    CHECK(header.text("compression") == "pxr24");
    for (int bin = 0; bin < 31; ++bin)
        CHECK(header.channel(fmt::format("{}nm", 400 + 10 * bin)) >= 0);
    CHECK(header.channel("A") >= 0);
    for (const auto& [name, value] : std::map<std::string, std::string>{{"object", "tall"},
                                                                        {"material", "matt"},
                                                                        {"samples", "16"},
                                                                        {"seed", "0"},
                                                                        {"exposure", "1"},
                                                                        {"light", "overcast"},
                                                                        {"quality", "draft"},
                                                                        {"observer", "cie1931"},
                                                                        {"angle_deg", "0"}})
        CHECK(header.text("overt:" + name) == value);
    for (const char* const name : {"mesh_sha256", "camera_position", "camera_vertical_fov_deg", "unit",
                                   "program", "renderer", "material_settings", "key"})
        CHECK_FALSE(header.text(std::string("overt:") + name).empty());

    // Spectra and XYZ are the same light.
    REQUIRE(with_more({"--out", (out / "x").string(), "--as", "xyz"}).exit_code == 0);
    const PictureHeader xyz_header = header_of(out / "x/tall_matt/frame_0003.exr");
    CHECK(xyz_header.channel("Y") >= 0);
    const auto spectra = values_in(out / "s/tall_matt/frame_0003.exr"),
               xyz = values_in(out / "x/tall_matt/frame_0003.exr");
    int compared = 0;
    for (std::size_t pixel = 0; pixel < xyz.size() / 4; ++pixel) {
        double y = 0.0;
        for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
            const auto channel =
                static_cast<std::size_t>(header.channel(fmt::format("{}nm", 400 + 10 * bin)));
            y += cie1931_xyz()[1][bin] * double{spectra[32 * pixel + channel]};
        }
        const auto other = double{xyz[4 * pixel + static_cast<std::size_t>(xyz_header.channel("Y"))]};
        CHECK(y == Approx(other).epsilon(0.004).margin(1e-4));
        compared += y > 0.01;
    }
    CHECK(compared > 100);
}

TEST_CASE("a PNG has the light over the background in 16 bits, and says what it clipped", "[session]") {
    const SmallExperiment experiment(
        with(traced_protocol(), "[animation]\n", "[light]\nexposure = 4\n[animation]\n"), Cache::own);
    const std::filesystem::path out = experiment.folder().path() / "out";
    const std::vector<std::string> wish{"--quality", "draft", "--stimulus",         "bust/smooth", "--frames",
                                        "0",         "--out", (out / "p").string(), "--png16"};
    const ProgramRun run = bake(experiment, wish);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(run.out.find("clipped to what 16 bits hold: up to") != std::string::npos);
    REQUIRE(bake(experiment, {"--quality", "draft", "--stimulus", "bust/smooth", "--frames", "0", "--out",
                              (out / "e").string()})
                .exit_code == 0);
    const auto json = nlohmann::json::parse(text_of(out / "p/bust_smooth/frame_0000.json"));
    CHECK(json.at("overt:background") == 0.1);
    CHECK(json.at("overt:exposure") == "4");
    CHECK(json.at("overt:share_clipped_above").at(0) > 0.0);
    const auto png = values_in(out / "p/bust_smooth/frame_0000.png");
    const LinearImage exr = read_linear_image(out / "e/bust_smooth/frame_0000.exr");
    REQUIRE(png.size() == 3 * exr.pixels.size());
    for (std::size_t i = 0; i < png.size(); ++i) {
        const glm::vec4& pixel = exr.pixels[i / 3];
        const float light = pixel[static_cast<int>(i % 3)] + (1.0f - pixel.w) * 0.1f;
        CHECK(std::abs(png[i] - std::clamp(light, 0.0f, 1.0f)) < 0.0008f);
    }
    // What is there already is what is wanted.
    const auto time = std::filesystem::last_write_time(out / "p/bust_smooth/frame_0000.png");
    CHECK(bake(experiment, wish).exit_code == 0);
    CHECK(std::filesystem::last_write_time(out / "p/bust_smooth/frame_0000.png") == time);
}

TEST_CASE("frames for other programs keep 16 bits; half floats are made on request only", "[session]") {
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const std::filesystem::path out = experiment.folder().path() / "out";
    const auto wish = [&](const char* folder, std::vector<std::string> more) {
        more.insert(more.end(), {"--quality", "draft", "--stimulus", "bust/matt", "--frames", "0", "--out",
                                 (out / folder).string()});
        return bake(experiment, more);
    };
    REQUIRE(wish("full", {}).exit_code == 0);
    REQUIRE(wish("half", {"--half"}).exit_code == 0);
    CHECK(header_of(out / "full/bust_matt/frame_0000.exr").type == PixelType::float32);
    CHECK(header_of(out / "half/bust_matt/frame_0000.exr").type == PixelType::float16);
    const auto full = values_in(out / "full/bust_matt/frame_0000.exr"),
               half = values_in(out / "half/bust_matt/frame_0000.exr");
    REQUIRE(full.size() == half.size());
    int finer = 0;
    for (std::size_t i = 0; i < full.size(); ++i) {
        CHECK(half[i] == Approx(full[i]).epsilon(0x1p-11).margin(1e-7));
        finer += full[i] != half[i];
    }
    CHECK(finer > 100);

    // Files of one kind are not taken for those of the other, and there is no half of a PNG.
    CHECK(wish("full", {"--half"}).exit_code == 2);
    CHECK(wish("both", {"--half", "--png16"}).exit_code == 2);
    const ProgramRun aimless = bake(experiment, {"--half"});
    CHECK(aimless.exit_code == 2);
    CHECK(aimless.err.find("--out") != std::string::npos);
}

TEST_CASE("nothing that was made otherwise is replaced unless it is said", "[session]") {
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const std::string out = (experiment.folder().path() / "out").string();
    const std::vector<std::string> wish{"--stimulus", "bust/matt", "--frames",  "1",
                                        "--out",      out,         "--quality", "draft"};
    const auto file = experiment.folder().file("out/bust_matt/frame_0001.exr", "mine");
    const auto other = experiment.folder().file("out/notes.txt", "mine, too");
    const ProgramRun refused = bake(experiment, wish);
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("frame_0001.exr: is there already and was made otherwise") != std::string::npos);
    CHECK(text_of(file) == "mine");
    std::vector<std::string> forced = wish;
    forced.emplace_back("--overwrite");
    CHECK(bake(experiment, forced).exit_code == 0);
    CHECK(values_in(file).size() == 40 * 48 * 4);
    CHECK(text_of(other) == "mine, too");
    // Another quality makes other frames.
    std::vector<std::string> better = wish;
    better.back() = "preview";
    CHECK(bake(experiment, better).exit_code == 2);
}

TEST_CASE("sheet and strip are pictures of all that was asked for", "[session]") {
    const SmallExperiment experiment(traced_protocol(), Cache::own);
    const std::filesystem::path folder = experiment.folder().path();
    const ProgramRun run =
        bake(experiment, {"--quality", "preview", "--sheet", (folder / "sheet.png").string()});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    REQUIRE(bake(experiment, {"--quality", "preview", "--stimulus", "tall/matt", "--strip",
                              (folder / "strip.png").string()})
                .exit_code == 0);
    const glm::ivec2 sheet = header_of(folder / "sheet.png").size_px,
                     strip = header_of(folder / "strip.png").size_px;
    CHECK(sheet.x > 2 * 40);
    CHECK(sheet.y > 2 * 48);
    CHECK(strip.x > 7 * 40);
    CHECK(strip.y > 48);
    // Nowhere are they all black: there is a figure in each part.
    const auto values = values_in(folder / "sheet.png");
    for (int part = 0; part < 4; ++part) {
        float brightest = 0.0f;
        for (int y = part / 2 * sheet.y / 2; y < (part / 2 + 1) * sheet.y / 2; ++y) {
            for (int x = part % 2 * sheet.x / 2; x < (part % 2 + 1) * sheet.x / 2; ++x)
                brightest = std::max(brightest, values[static_cast<std::size_t>(3 * (y * sheet.x + x))]);
        }
        CHECK(brightest > 0.2f);
    }
}
