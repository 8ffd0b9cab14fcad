/// `overt bake`: shards, resuming, the files it writes, and what it refuses.
#include <catch2/catch.hpp>

#include <map>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/bake_plan.h"
#include "app/protocol_inputs.h"
#include "app/small_experiment.h"
#include "experiment/random.h"
#include "render/display_light.h"
#include "render/linear_image.h"
#include "support/gl_contexts.h"
#include "support/running_program.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Path traced, of few and small frames.
std::string traced_protocol() {
    std::string text = with(small_protocol, "[bake]\nquality = \"live\"\n", "");
    text = with(text, "width_px = 128\nheight_px = 128\n", "width_px = 40\nheight_px = 48\n");
    return with(text, "frame_count = 31\nframe_rate_hz = 30\n", "frame_count = 7\nframe_rate_hz = 6\n");
}
constexpr int poses = 3; ///< of a period of seven frames: in front, and one to each side

std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    if (!std::filesystem::exists(folder))
        return files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file())
            files.push_back(entry.path().lexically_relative(folder));
    }
    std::sort(files.begin(), files.end());
    return files;
}

int whole_files_below(const std::filesystem::path& folder) {
    const auto files = files_below(folder);
    return static_cast<int>(std::count_if(files.begin(), files.end(), [](const std::filesystem::path& file) {
        return file.filename().string().front() != '.';
    }));
}

/// All channels of a picture as floats.
std::vector<float> values_in(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input)
        throw std::runtime_error("no picture: " + file.string());
    std::vector<float> values(static_cast<std::size_t>(input->spec().image_pixels()) *
                              static_cast<std::size_t>(input->spec().nchannels));
    if (!input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, values.data()))
        throw std::runtime_error("an unreadable picture: " + file.string());
    return values;
}

OIIO::ImageSpec spec_of(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input)
        throw std::runtime_error("no picture: " + file.string());
    return input->spec();
}

/// Whether two folders have the same files with the same pictures.
bool same_pictures(const std::filesystem::path& a, const std::filesystem::path& b) {
    const auto files = files_below(a);
    if (files != files_below(b))
        return false;
    return std::all_of(files.begin(), files.end(), [&](const std::filesystem::path& file) {
        return values_in(a / file) == values_in(b / file);
    });
}

ProgramRun bake(const SmallExperiment& experiment, std::vector<std::string> more,
                const std::filesystem::path& cache = {}) {
    std::vector<std::string> arguments{"bake", experiment.protocol().string(), "--context", "osmesa"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_overt(arguments, {"OVERT_CACHE=" + (cache.empty() ? experiment.cache() : cache).string()});
}

} // namespace

TEST_CASE("the shards of a bake, joined, are the whole, bit for bit", "[session]") {
    const SmallExperiment experiment(traced_protocol());
    const std::filesystem::path whole = experiment.folder().path() / "whole",
                                joined = experiment.folder().path() / "joined";
    CHECK(bake(experiment, {"--quality", "draft"}, whole).exit_code == 0);
    std::size_t before = 0;
    for (const char* const shard : {"3/3", "1/3", "2/3"}) {
        const ProgramRun run = bake(experiment, {"--quality", "draft", "--shard", shard}, joined);
        INFO(run.err);
        CHECK(run.exit_code == 0);
        const std::size_t now = files_below(joined / "frames").size();
        // Four stimuli of three poses, dealt to three.
        CHECK(now - before == 4);
        before = now;
    }
    CHECK(files_below(whole / "frames").size() == 4 * poses);
    CHECK(same_pictures(whole / "frames", joined / "frames"));
}

TEST_CASE("a bake that is killed goes on with what it had, to the same frames", "[session]") {
    const SmallExperiment experiment(traced_protocol());
    const std::filesystem::path whole = experiment.folder().path() / "whole",
                                killed = experiment.folder().path() / "killed";
    const std::vector<std::string> wish{"--quality", "draft", "--samples", "200"};
    {
        std::vector<std::string> arguments{"bake", experiment.protocol().string(), "--context", "osmesa"};
        arguments.insert(arguments.end(), wish.begin(), wish.end());
        RunningProgram program(arguments, {"OVERT_CACHE=" + killed.string()},
                               experiment.folder().path() / "said");
        while (program.is_running() && whole_files_below(killed / "frames") < 2)
            usleep(2000);
        REQUIRE(program.is_running());
        program.signal(SIGKILL);
        program.wait();
    }
    std::map<std::string, std::filesystem::file_time_type> kept;
    for (const auto& file : files_below(killed / "frames")) {
        if (file.filename().string().front() != '.')
            kept[file.string()] = std::filesystem::last_write_time(killed / "frames" / file);
    }
    CHECK(kept.size() >= 2);
    const ProgramRun on = bake(experiment, wish, killed);
    CHECK(on.exit_code == 0);
    CHECK(on.out.find(fmt::format("{} of {} frames are there, {} rendered now", 4 * poses, 4 * poses,
                                  4 * poses - kept.size())) != std::string::npos);
    for (const auto& [file, time] : kept)
        CHECK(std::filesystem::last_write_time(killed / "frames" / file) == time);
    CHECK(bake(experiment, wish, whole).exit_code == 0);
    for (const auto& file : files_below(whole / "frames"))
        CHECK(values_in(whole / "frames" / file) == values_in(killed / "frames" / file));
}

TEST_CASE("Ctrl-C ends a bake between two frames and says how to go on", "[session]") {
    const SmallExperiment experiment(traced_protocol());
    const std::filesystem::path said = experiment.folder().path() / "said";
    RunningProgram program(
        {"bake", experiment.protocol().string(), "--context", "osmesa", "--samples", "2000"},
        {"OVERT_CACHE=" + experiment.cache().string()}, said);
    while (program.is_running() && files_below(experiment.cache() / "frames").empty())
        usleep(2000);
    REQUIRE(program.is_running());
    program.signal(SIGINT);
    CHECK(program.wait() == 1);
    CHECK(text_of(said).find("the same command goes on where it ended") != std::string::npos);
    for (const auto& file : files_below(experiment.cache() / "frames"))
        CHECK(file.filename().string().front() != '.');
}

TEST_CASE("a disk that takes no more ends a bake with what it had, whole", "[session]") {
    const SmallExperiment experiment(traced_protocol());
    // The maps are there; frames of noise are larger than the limit on files.
    REQUIRE(bake(experiment, {"--quality", "preview"}).exit_code == 0);
    const auto before = files_below(experiment.cache() / "frames");
    const std::string command = fmt::format(
        "trap '' XFSZ; ulimit -f 1; OVERT_CACHE={} exec {} bake {} --quality draft --context osmesa 2>{}",
        experiment.cache().string(), OVERT_PROGRAM, experiment.protocol().string(),
        (experiment.folder().path() / "said").string());
    const int status = std::system(("bash -c " + quoted_for_shell(command) + " >/dev/null").c_str());
    CHECK(WEXITSTATUS(status) == 1);
    const std::string said = text_of(experiment.folder().path() / "said");
    INFO(said);
    CHECK(said.find("What was finished before is kept") != std::string::npos);
    CHECK(files_below(experiment.cache() / "frames") == before);
    CHECK(bake(experiment, {"--quality", "draft"}).exit_code == 0);
}

TEST_CASE("exported frames, given back as ready-made ones, are the same light", "[session]") {
    const SmallExperiment experiment(traced_protocol());
    const std::filesystem::path folder = experiment.folder().path();
    REQUIRE(bake(experiment,
                 {"--quality", "draft", "--only", "bust/smooth", "--out", (folder / "display").string()})
                .exit_code == 0);
    REQUIRE(bake(experiment, {"--quality", "draft", "--only", "bust/smooth", "--out",
                              (folder / "xyz").string(), "--as", "xyz"})
                .exit_code == 0);
    const std::string frames = "[[frames]]\nsculpture = \"bust\"\nmaterial = \"smooth\"\n";
    const auto light_of = [&](const std::string& name, const std::string& more) {
        experiment.folder().file(name, traced_protocol() + more);
        Diagnostics diagnostics;
        const auto read =
            read_experiment(folder / name, experiment.cache(), InputDepth::everything, diagnostics);
        INFO(diagnostics.print());
        REQUIRE(read);
        const auto context = make_headless_context(ContextKind::osmesa);
        StimulusLibrary library(*context, read->protocol, read->sculptures, experiment.cache());
        library.prepare_frames({0, 0}, {});
        return library.page({0, 0}, library.page_of_frame({0, 0})[2]);
    };
    const LinearImage rendered = light_of("a.toml", "");
    const LinearImage display =
        light_of("b.toml", frames + "files = \"display/bust_smooth/frame_####.exr\"\n");
    const LinearImage xyz =
        light_of("c.toml", frames + "files = \"xyz/bust_smooth/frame_####.exr\"\ncolour_space = \"xyz\"\n");
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
    }
    CHECK(brightest > 0.1f);
}

TEST_CASE("an exported frame names its channels and everything that made it", "[session]") {
    const SmallExperiment experiment(traced_protocol());
    const std::filesystem::path out = experiment.folder().path() / "out";
    const std::vector<std::string> wish{"--quality", "draft", "--only", "tall/matt", "--frames", "2-3"};
    const auto with_more = [&](std::vector<std::string> more) {
        more.insert(more.begin(), wish.begin(), wish.end());
        return bake(experiment, more);
    };
    REQUIRE(with_more({"--out", (out / "s").string(), "--as", "spectra"}).exit_code == 0);
    REQUIRE(files_below(out / "s") ==
            std::vector<std::filesystem::path>{"tall_matt/frame_0002.exr", "tall_matt/frame_0003.exr"});
    const OIIO::ImageSpec spec = spec_of(out / "s/tall_matt/frame_0003.exr");
    REQUIRE(spec.nchannels == 32);
    CHECK(spec.format == OIIO::TypeDesc::HALF);
    CHECK(spec.get_string_attribute("compression") == "zip");
    for (int bin = 0; bin < 31; ++bin)
        CHECK(spec.channelindex(fmt::format("{}nm", 400 + 10 * bin)) >= 0);
    CHECK(spec.channelindex("A") >= 0);
    for (const auto& [name, value] : std::map<std::string, std::string>{{"sculpture", "tall"},
                                                                        {"material", "matt"},
                                                                        {"samples", "16"},
                                                                        {"seed", "0"},
                                                                        {"exposure", "1"},
                                                                        {"light", "overcast"},
                                                                        {"quality", "draft"},
                                                                        {"observer", "cie1931"},
                                                                        {"angle_deg", "0"}})
        CHECK(spec.get_string_attribute("overt:" + name) == value);
    for (const char* const name : {"mesh_sha256", "camera_position", "camera_vertical_fov_deg", "unit",
                                   "program", "renderer", "material_settings", "key"})
        CHECK_FALSE(spec.get_string_attribute(std::string("overt:") + name).empty());

    // Spectra and XYZ are the same light.
    REQUIRE(with_more({"--out", (out / "x").string(), "--as", "xyz"}).exit_code == 0);
    const OIIO::ImageSpec xyz_spec = spec_of(out / "x/tall_matt/frame_0003.exr");
    CHECK(xyz_spec.channelindex("Y") >= 0);
    const auto spectra = values_in(out / "s/tall_matt/frame_0003.exr"),
               xyz = values_in(out / "x/tall_matt/frame_0003.exr");
    int compared = 0;
    for (std::size_t pixel = 0; pixel < xyz.size() / 4; ++pixel) {
        double y = 0.0;
        for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
            const auto channel =
                static_cast<std::size_t>(spec.channelindex(fmt::format("{}nm", 400 + 10 * bin)));
            y += cie1931_xyz()[1][bin] * double{spectra[32 * pixel + channel]};
        }
        const double other = double{xyz[4 * pixel + static_cast<std::size_t>(xyz_spec.channelindex("Y"))]};
        CHECK(y == Approx(other).epsilon(0.004).margin(1e-4));
        compared += y > 0.01;
    }
    CHECK(compared > 100);
}

TEST_CASE("a PNG has the light over the background in 16 bits, and says what it clipped", "[session]") {
    const SmallExperiment experiment(
        with(traced_protocol(), "[animation]\n", "[light]\nexposure = 4\n[animation]\n"));
    const std::filesystem::path out = experiment.folder().path() / "out";
    const std::vector<std::string> wish{"--quality", "draft", "--only", "bust/smooth",
                                        "--frames",  "0",     "--out",  (out / "p").string(),
                                        "--png16"};
    const ProgramRun run = bake(experiment, wish);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(run.out.find("clipped to what 16 bits hold: up to") != std::string::npos);
    REQUIRE(bake(experiment, {"--quality", "draft", "--only", "bust/smooth", "--frames", "0", "--out",
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

TEST_CASE("nothing that was made otherwise is replaced unless it is said", "[session]") {
    const SmallExperiment experiment(traced_protocol());
    const std::string out = (experiment.folder().path() / "out").string();
    const std::vector<std::string> wish{"--only", "bust/matt", "--frames",  "1",
                                        "--out",  out,         "--quality", "draft"};
    const auto file = experiment.folder().file("out/bust_matt/frame_0001.exr", "mine");
    const auto other = experiment.folder().file("out/notes.txt", "mine, too");
    const ProgramRun refused = bake(experiment, wish);
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("frame_0001.exr: is there already and was made otherwise") != std::string::npos);
    CHECK(text_of(file) == "mine");
    std::vector<std::string> forced = wish;
    forced.emplace_back("--force");
    CHECK(bake(experiment, forced).exit_code == 0);
    CHECK(values_in(file).size() == 40 * 48 * 4);
    CHECK(text_of(other) == "mine, too");
    // Another quality makes other frames.
    std::vector<std::string> better = wish;
    better.back() = "preview";
    CHECK(bake(experiment, better).exit_code == 2);
}

TEST_CASE("a bake that makes no sense is refused before anything is rendered", "[session]") {
    const SmallExperiment experiment(traced_protocol());
    const auto refusal = [&](const std::vector<std::string>& more, const std::string& reason) {
        const ProgramRun run = bake(experiment, more);
        INFO(run.err);
        CHECK(run.exit_code == 2);
        CHECK(run.err.find(reason) != std::string::npos);
    };
    refusal({"--shard", "3/2"}, "1/4 to 4/4");
    refusal({"--shard", "0/2"}, "1/4 to 4/4");
    refusal({"--shard", "one"}, "1/4 to 4/4");
    refusal({"--only", "bust/smoth"}, "did you mean \"bust/smooth\"");
    refusal({"--only", "bust"}, "bust/smooth");
    refusal({"--frames", "5-7"}, "frames 0 to 6");
    refusal({"--frames", "4-2"}, "0-30");
    refusal({"--quality", "perfect"}, "--quality");
    refusal({"--samples", "0"}, "--samples");
    refusal({"--samples", "1000000"}, "--samples");
    refusal({"--as", "spectra"}, "--out");
    refusal({"--as", "xyz", "--png16", "--out", "x"}, "EXR");
    refusal({"--strip", "strip.png"}, "--only");
    refusal({"--sheet", "sheet.png", "--shard", "1/2"}, "when all are there");
    refusal({"--sheet", "sheet.png", "--only", "bust/matt"}, "leave out --only");
    const auto file = experiment.folder().file("out", "no folder");
    refusal({"--out", file.string()}, "is no folder");
    CHECK(files_below(experiment.cache() / "frames").empty());
    const SmallExperiment dark(
        with(traced_protocol(), "[animation]\n", "[light]\nprobe = \"no.exr\"\n[animation]\n"));
    const ProgramRun run = bake(dark, {});
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("there is no file") != std::string::npos);
}

TEST_CASE("sheet and strip are pictures of all that was asked for", "[session]") {
    const SmallExperiment experiment(traced_protocol());
    const std::filesystem::path folder = experiment.folder().path();
    const ProgramRun run =
        bake(experiment, {"--quality", "preview", "--sheet", (folder / "sheet.png").string()});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    REQUIRE(bake(experiment,
                 {"--quality", "preview", "--only", "tall/matt", "--strip", (folder / "strip.png").string()})
                .exit_code == 0);
    const OIIO::ImageSpec sheet = spec_of(folder / "sheet.png"), strip = spec_of(folder / "strip.png");
    CHECK(sheet.width > 2 * 40);
    CHECK(sheet.height > 2 * 48);
    CHECK(strip.width > 7 * 40);
    CHECK(strip.height > 48);
    // Nowhere are they all black: there is a figure in each part.
    const auto values = values_in(folder / "sheet.png");
    for (int part = 0; part < 4; ++part) {
        float brightest = 0.0f;
        for (int y = part / 2 * sheet.height / 2; y < (part / 2 + 1) * sheet.height / 2; ++y) {
            for (int x = part % 2 * sheet.width / 2; x < (part % 2 + 1) * sheet.width / 2; ++x)
                brightest = std::max(brightest, values[static_cast<std::size_t>(3 * (y * sheet.width + x))]);
        }
        CHECK(brightest > 0.2f);
    }
}

TEST_CASE("a session takes the best quality that is there of all stimuli, and records it", "[session]") {
    const SmallExperiment experiment(traced_protocol());
    const ProgramRun first = experiment.run({"--trials", "1"});
    INFO(first.err);
    CHECK(first.exit_code == 0);
    CHECK(first.out.find("frames: path traced, preview") != std::string::npos);
    REQUIRE(bake(experiment, {"--quality", "draft", "--only", "bust/smooth"}).exit_code == 0);
    CHECK(experiment.run({"--trials", "1"}).out.find("frames: path traced, preview") != std::string::npos);
    REQUIRE(bake(experiment, {"--quality", "draft"}).exit_code == 0);
    const ProgramRun better = experiment.run({"--trials", "1"});
    CHECK(better.out.find("frames: path traced, draft: 16 samples, CIE 1931") != std::string::npos);
    const ProgramRun check = experiment.overt({"check", experiment.protocol().string()});
    CHECK(check.out.find("A session takes draft.") != std::string::npos);
    CHECK(check.out.find(fmt::format("draft                       {0} of {0} frames", 4 * poses)) !=
          std::string::npos);
}

TEST_CASE("a session that asks for more than is there is refused, with what to do", "[session]") {
    const SmallExperiment experiment(
        with(traced_protocol(), "[tracker]\n", "[bake]\nquality = \"standard\"\n[tracker]\n"));
    const ProgramRun refused = experiment.run({"--trials", "1"});
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("run `overt bake") != std::string::npos);
    CHECK(files_below(experiment.sessions()).empty());
    const ProgramRun content = experiment.run({"--trials", "1", "--quality", "preview"});
    INFO(content.err);
    CHECK(content.exit_code == 0);
    // A look takes what there is.
    CHECK(experiment
              .overt({"play", experiment.protocol().string(), "--stimulus", "bust/matt", "--picture",
                      (experiment.folder().path() / "p.png").string()})
              .exit_code == 0);
}

TEST_CASE("shards share out all units once, and evenly by cost", "[unit]") {
    std::vector<BakeUnit> units;
    RandomStream random(3, "units");
    double all = 0.0, dearest = 0.0;
    for (int i = 0; i < 97; ++i) {
        units.push_back({{i / 30, i % 30 / 10}, {i % 10}, random.uniform(1.0, 20.0)});
        all += units.back().cost;
        dearest = std::max(dearest, units.back().cost);
    }
    for (const int count : {1, 2, 7, 97, 200}) {
        std::map<std::tuple<int, int, int>, int> seen;
        for (int number = 1; number <= count; ++number) {
            double load = 0.0;
            for (const BakeUnit& unit : dealt_to({number, count}, units)) {
                ++seen[{unit.condition.sculpture, unit.condition.material, unit.pose.value}];
                load += unit.cost;
            }
            CHECK(load <= all / count + dearest);
        }
        std::map<std::tuple<int, int, int>, int> wanted;
        for (const BakeUnit& unit : units)
            ++wanted[{unit.condition.sculpture, unit.condition.material, unit.pose.value}];
        CHECK(seen == wanted);
    }
}
