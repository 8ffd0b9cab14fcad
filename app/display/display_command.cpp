#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/figures.h"
#include "app/cli/own_folders.h"
#include "app/cli/progress_bar.h"
#include "app/display/display_commands.h"
#include "app/inputs/protocol_file.h"
#include "app/inputs/protocol_inputs.h"
#include "app/rig/open_display.h"
#include "app/rig/output_verification.h"
#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "render/stimulus/stimulus_library.h"
#include "render/window/window_system.h"

namespace overt {

namespace {

/// One way of sending: a mode with its dithering.
struct Output {
    OutputMode mode;
    Dithering dither = Dithering::none;
    std::string name() const {
        return dither == Dithering::none ? std::string(name_of(mode))
                                         : fmt::format("{} ({})", name_of(mode), name_of(dither));
    }
};

/// All modes, and those of 8 bits that can be dithered with each dithering.
std::vector<Output> all_outputs() {
    std::vector<Output> outputs;
    for (const OutputModeRow& row : output_modes) {
        outputs.push_back({row.mode});
        if (!row.is_packed && row.framebuffer_bits == 8) {
            outputs.push_back({row.mode, Dithering::ordered});
            outputs.push_back({row.mode, Dithering::blue_noise});
        }
    }
    return outputs;
}

/// What is drawn to prove a mode.
struct TestPicture {
    std::string name;
    glm::ivec2 size_px, origin_px;
    enum class Light { levels, random, plain } light;
};

std::vector<TestPicture> test_pictures(glm::ivec2 screen) {
    using Light = TestPicture::Light;
    return {{"all 65,536 levels of each channel",
             {512, 256},
             centred_origin_px(screen, {512, 256}),
             Light::levels},
            {"random pairs", {1024, 512}, centred_origin_px(screen, {1024, 512}), Light::random},
            {"edges at odd places", {333, 77}, {101, 5}, Light::random},
            {"the right border", {1, 5}, {screen.x - 1, 3}, Light::random},
            {"the lower left corner", {37, 9}, {0, screen.y - 9}, Light::random},
            {"a plain surface", {512, 256}, {64, 64}, Light::plain}};
}

class TestPages final : public FrameSource {
  public:
    TestPages(const TestPicture& picture, bool is_grey) : picture_(&picture), is_grey_(is_grey) {}
    std::vector<int> page_of_frame(const Stimulus&) const override { return {0}; }
    LinearImage page(const Stimulus&, int) const override {
        LinearImage image(picture_->size_px);
        RandomStream random(1, picture_->name);
        const auto light = [](int code) { return static_cast<float>(code / 65535.0); };
        const auto any = [&](double low, double high) {
            return static_cast<float>(random.uniform(low, high));
        };
        const glm::vec4 plain(any(0, 1), any(0, 1), any(0, 1), 1.0f);
        int i = 0;
        for (glm::vec4& pixel : image.pixels) {
            // Each level is a pair's; the channels run through theirs in different orders.
            const int level = i++ / 2 % 65536;
            switch (picture_->light) {
            case TestPicture::Light::levels:
                pixel = is_grey_ ? glm::vec4(glm::vec3(light(level)), 1.0f)
                                 : glm::vec4(light(level), light(65535 - level), light(level * 20501 & 65535),
                                             1.0f);
                break;
            case TestPicture::Light::random:
                pixel = {any(-0.1, 1.1), any(0, 1), any(0, 0.01), any(0, 1)};
                break;
            case TestPicture::Light::plain:
                pixel = plain;
                break;
            }
        }
        return image;
    }

  private:
    const TestPicture* picture_;
    bool is_grey_;
};

/// A display in virtual time.
OpenDisplay open_display(ContextKind kind, glm::ivec2 screen_px, OutputMode mode) {
    OpenDisplay display({.context = kind,
                         .size_px = screen_px,
                         .title = "overt display verify",
                         .refresh_hz = 120.0,
                         .bits_per_channel = row_of(mode).framebuffer_bits,
                         .virtual_time = true});
    display.start();
    return display;
}

void add_findings(const std::string& what, const SignalFindings& found, bool dithered,
                  BenchFigures& figures) {
    figures.push_back(at_most(fmt::format("{}: differences among {} values", what, found.compared),
                              static_cast<double>(found.different), "values", 0.0));
    if (dithered && found.largest_mean_error > 0.0)
        figures.push_back(at_most(what + ": largest error of the mean of 64 x 64 pixels",
                                  found.largest_mean_error, "codes", 0.5));
}

/// A trigger and a clock reset with one flip, nothing with the next.
int wrong_messages(PagePresenter& presenter, glm::ivec2 screen_px) {
    const auto received = [&] {
        const std::vector<std::byte> bytes = presenter.read_canvas();
        return receive_messages({screen_px, bytes});
    };
    presenter.send_with_next_flip(t_lock::clock_reset_row, t_lock::clock_reset());
    presenter.send_with_next_flip(t_lock::outputs_row, t_lock::pulse(0b101, 2.0, 4.0));
    presenter.flip({0});
    const ReceivedMessages with = received();
    presenter.flip({0});
    const ReceivedMessages without = received();
    int wrong = static_cast<int>(with.faults.size() + without.faults.size() + without.packets.size());
    if (with.packets.size() != 2)
        return wrong + 1;
    wrong += with.packets[0].row != 1 || with.packets[0].command != 12;
    const std::vector<ReceivedPulse> pulses = pulses_of(with.packets[1]);
    wrong += with.packets[1].row != 2 || pulses.size() != 2;
    for (const ReceivedPulse& pulse : pulses)
        wrong += pulse.begin_ms != 2.0 || pulse.end_ms != 6.0;
    return wrong;
}

/// Every second of a VPixx device's outputs.
constexpr int pixel_mode_trigger = 0x555555;

int wrong_psync(PagePresenter& presenter, glm::ivec2 screen_px) {
    int wrong = 0;
    std::optional<int> before;
    presenter.show({});
    for (int i = 0; i < 3; ++i) {
        presenter.flip({0});
        const std::vector<std::byte> bytes = presenter.read_canvas();
        const ReceivedMessages received = receive_messages({screen_px, bytes});
        const std::optional<int> count = received.psync_count;
        wrong += !count || (before && *count != (*before + 1) % 256);
        wrong += received.pixel_mode_outputs != (i == 0 ? pixel_mode_trigger : 0);
        before = count;
    }
    return wrong;
}

void verify_output(ContextKind kind, const Output& output, DisplaySettings display, BenchFigures& figures) {
    const glm::ivec2 screen{display.width_px, display.height_px};
    display.output = output.mode;
    display.dither = output.dither;
    if (has_psync(output.mode))
        display.onset_trigger = pixel_mode_trigger;
    const OpenDisplay opened = open_display(kind, screen, output.mode);
    const std::string where = fmt::format("{}, {}", name_of(kind), output.name());
    SignalFindings all;
    std::optional<int> wrong_in_rows;
    for (const TestPicture& picture : test_pictures(screen)) {
        ScreenGeometry geometry;
        geometry.screen_px = screen;
        geometry.image_px = picture.size_px;
        geometry.image_origin_px = picture.origin_px;
        const TestPages pages(picture, is_grey(output.mode));
        PagePresenter presenter(opened.context(), opened.surface(), pages, geometry, display, {});
        presenter.load_frames({0, 0});
        presenter.flip({0});
        const std::vector<std::byte> bytes = presenter.read_canvas();
        const LinearImage light = pages.page({0, 0}, 0);
        const SignalFindings found = check_signal({screen, bytes}, display, {&light, picture.origin_px});
        if (found.different > 0)
            fmt::print(stderr, "{}, {}: {}\n", where, picture.name, found.first);
        all += found;
        if (picture.light == TestPicture::Light::levels && reserved_rows(output.mode) > 0)
            wrong_in_rows =
                has_t_lock(output.mode) ? wrong_messages(presenter, screen) : wrong_psync(presenter, screen);
    }
    add_findings(where, all, output.dither != Dithering::none, figures);
    if (wrong_in_rows) {
        figures.push_back(at_most(
            where + (has_t_lock(output.mode) ? ": faults of triggers and clock reset" : ": faults of PSYNC"),
            *wrong_in_rows, "faults", 0.0));
    }
}

void verify_stimuli(ContextKind kind, const Experiment& experiment, const DisplayVerifyOptions& options,
                    BenchFigures& figures) {
    const Protocol& protocol = experiment.protocol;
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    const OpenDisplay opened = open_display(kind, geometry.screen_px, protocol.display.output);
    StimulusLibrary library(opened.context(), protocol, experiment.objects, cache_folder());
    ProgressBar bar;
    std::vector<Stimulus> stimuli;
    if (!options.stimulus.empty()) {
        stimuli.push_back(stimulus_called(protocol, options.stimulus));
    } else {
        stimuli = all_stimuli(protocol);
    }
    PagePresenter presenter(opened.context(), opened.surface(), library, geometry, protocol.display,
                            protocol.screens);
    int done = 0;
    for (const Stimulus& stimulus : stimuli) {
        library.prepare_frames(stimulus, std::ref(bar));
        bar.update("verifying", done++, static_cast<int>(stimuli.size()));
        SignalFindings all;
        for (const PageVerification& page :
             verify_pages(presenter, library, stimulus, geometry, protocol.display))
            all += page.findings;
        if (all.different > 0)
            fmt::print(stderr, "{}\n", all.first);
        add_findings(fmt::format("{}, {}, {}, {} pages", name_of(kind), name_of(protocol.display.output),
                                 stimulus_name(protocol, stimulus), presenter.pages()),
                     all, protocol.display.dither != Dithering::none, figures);
    }
    bar.update("verifying", done, static_cast<int>(stimuli.size()));
}

bool is_wanted(const Output& output, const std::vector<std::string>& modes) {
    return modes.empty() ||
           std::find(modes.begin(), modes.end(), std::string(name_of(output.mode))) != modes.end();
}

} // namespace

BenchFigures verify_drawn_output(const DisplayVerifyOptions& options, std::vector<std::string>& refused) {
    BenchFigures figures;
    ProgressBar bar;
    std::optional<Experiment> experiment;
    if (!options.protocol.empty())
        experiment = read_experiment_or_report(options.protocol, cache_folder(), InputDepth::objects);
    const DisplaySettings display = experiment ? experiment->protocol.display : DisplaySettings{};
    const std::vector<Output> outputs = all_outputs();
    constexpr ContextKind kinds[] = {ContextKind::osmesa, ContextKind::egl, ContextKind::window};
    for (const ContextKind kind : kinds) {
        if (options.context && *options.context != kind)
            continue;
        int done = 0;
        for (const Output& output : outputs) {
            bar.update(fmt::format("verifying {}", name_of(kind)), done++, static_cast<int>(outputs.size()));
            if (!is_wanted(output, options.modes))
                continue;
            try {
                verify_output(kind, output, display, figures);
            } catch (const GraphicsError& error) {
                // What was asked for by name has to work; of the rest it is said why it does not.
                if (options.context && !options.modes.empty())
                    throw;
                refused.push_back(fmt::format("{}, {}: {}", name_of(kind), output.name(), error.what()));
            }
        }
        bar.update(fmt::format("verifying {}", name_of(kind)), done, done);
        if (experiment && (kind != ContextKind::window || display_is_available()))
            verify_stimuli(kind, *experiment, options, figures);
    }
    bar.finish();
    return figures;
}

int run_display_verify(const DisplayVerifyOptions& options) {
    std::vector<std::string> refused;
    const BenchFigures figures = verify_drawn_output(options, refused);
    if (options.json) {
        fmt::print("{}\n", to_json(figures).dump(2));
    } else {
        print_table(figures);
    }
    for (const std::string& line : refused)
        fmt::print(stderr, "not verified: {}\n", line);
    if (figures.empty())
        throw GraphicsError("nothing could be verified");
    return all_hold(figures) ? 0 : 1;
}

} // namespace overt
