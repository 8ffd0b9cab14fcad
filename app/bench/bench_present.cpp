#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "app/bench/bench_clock.h"
#include "app/bench/bench_command.h"
#include "app/bench/bench_timing.h"
#include "app/bench/random_pages.h"
#include "app/cli/resident_memory.h"
#include "app/rig/open_display.h"
#include "render/presenter/page_presenter.h"
#include "render/window/window_system.h"

namespace overt {

namespace {

constexpr int cycles = 5;

DisplaySettings color_plus_plus(double gamma = 1.0) {
    DisplaySettings display;
    display.output = OutputMode::color_plus_plus;
    display.gamma = gamma;
    return display;
}

/// Three unlike channels, as measured ones are: two tables with a shoulder and a power with an offset.
DisplayCharacterisation unlike_channels() {
    const auto shouldered = [](int points, double exponent, double shoulder) {
        std::vector<double> signals, lights;
        for (int i = 0; i < points; ++i) {
            const double signal = static_cast<double>(i) / (points - 1);
            signals.push_back(signal);
            lights.push_back(std::pow(signal, exponent) * (1.0 + shoulder * signal * (1.0 - signal)));
        }
        return ChannelCurve::table(signals, lights, exponent);
    };
    DisplayCharacterisation display;
    display.primaries_xyz = {glm::dvec3(46.0, 24.0, 2.1), glm::dvec3(34.0, 76.0, 11.5),
                             glm::dvec3(20.0, 8.5, 105.0)};
    display.curves = {shouldered(17, 2.35, 0.2), shouldered(12, 2.1, -0.15), ChannelCurve::power(1.9, -0.04)};
    return display;
}

void measure_packing(const RandomPages& pages, const ScreenGeometry& geometry, BenchFigures& figures) {
    const LinearImage picture = pages.page({0, 0}, 0);
    struct Packing {
        const char* name;
        DisplaySettings display;
        std::optional<DisplayEncoder> encoder = std::nullopt;
        std::vector<double> times_s = {};
    };
    std::vector<Packing> packings;
    for (const OutputMode mode :
         {OutputMode::color_plus_plus, OutputMode::mono_plus_plus, OutputMode::native_8bit}) {
        DisplaySettings display = color_plus_plus();
        display.output = mode;
        packings.push_back({"gamma 1", display});
        display.gamma = 2.2;
        packings.push_back({"gamma 2.2", display});
        display.characterisation = unlike_channels();
        packings.push_back({"three measured curves", display});
    }
    std::vector<std::byte> bytes;
    // One after the other, time and again, so that what else the machine does falls on all alike.
    for (int i = 0; i < 9; ++i) {
        for (Packing& packing : packings) {
            if (!packing.encoder)
                packing.encoder.emplace(packing.display);
            const ScreenPatch patch = packing.encoder->patch_of(geometry.image_origin_px, geometry.image_px);
            bytes.resize(bytes_in(patch.size_px, packing.encoder->format()));
            const double begin = thread_seconds();
            packing.encoder->encode(picture, geometry.image_origin_px, bytes);
            packing.times_s.push_back(thread_seconds() - begin);
        }
    }
    for (Packing& packing : packings) {
        std::sort(packing.times_s.begin(), packing.times_s.end());
        figures.push_back({fmt::format("packing a page, {}, {}, one processor",
                                       name_of(packing.display.output), packing.name),
                           1e3 * packing.times_s[packing.times_s.size() / 2], "ms"});
    }
}

void measure_flips(const OpenDisplay& display, const RandomPages& pages, const ScreenGeometry& geometry,
                   BenchFigures& figures) {
    const GlContext& context = display.context();
    PagePresenter presenter(context, display.surface(), pages, geometry, color_plus_plus(), {});
    presenter.show({});
    const double before_mb = resident_memory_mb();
    const auto begin = std::chrono::steady_clock::now();
    presenter.load_frames({0, 0});
    const double loading_s = seconds_since(begin);
    const double loaded_mb = resident_memory_mb() - before_mb;
    for (int frame = 0; frame < RandomPages::count; ++frame) // once round to set things up
        presenter.flip({frame});
    std::vector<double> times_s;
    const double processor_before_s = processor_seconds();
    for (int flip = 0; flip < cycles * RandomPages::count; ++flip) {
        const auto flip_begin = std::chrono::steady_clock::now();
        presenter.flip({flip % RandomPages::count});
        times_s.push_back(seconds_since(flip_begin));
    }
    const double processor_ms =
        1e3 * (processor_seconds() - processor_before_s) / static_cast<double>(times_s.size());
    std::sort(times_s.begin(), times_s.end());
    const std::string where{name_of(context.description().kind)};
    const double median_ms = 1e3 * times_s[times_s.size() / 2];
    // A quarter of what Psychtoolbox 3.0.18 takes with the same software renderer (docs/output.md).
    const bool software = context.description().is_software;
    const std::string time = where + ", a flip, median", processor = where + ", a flip, processor time";
    figures.push_back(software ? at_most(time, median_ms, "ms", 9.0) : BenchFigure{time, median_ms, "ms"});
    figures.push_back({where + ", a flip, 95th percentile", 1e3 * times_s[times_s.size() * 95 / 100], "ms"});
    figures.push_back(software ? at_most(processor, processor_ms, "ms", 17.0)
                               : BenchFigure{processor, processor_ms, "ms"});
    // A quarter of its 2.1 s, and 0.3 of its 924 MB.
    const std::string loading = where + ", loading 61 pages", memory = where + ", memory for 61 pages";
    figures.push_back(software ? at_most(loading, loading_s, "s", 0.53)
                               : BenchFigure{loading, loading_s, "s"});
    figures.push_back(software ? at_most(memory, loaded_mb, "MB", 277.0)
                               : BenchFigure{memory, loaded_mb, "MB"});
}

} // namespace

BenchFigures bench_present(const BenchOptions& options) {
    ScreenGeometry geometry;
    geometry.image_px = glm::ivec2(std::min(options.size_px, 1024));
    geometry.image_origin_px = centred_origin_px(geometry.screen_px, geometry.image_px);
    const RandomPages pages(geometry.image_px.x);
    BenchFigures figures;
    measure_packing(pages, geometry, figures);
    for (const ContextKind kind : {ContextKind::osmesa, ContextKind::egl, ContextKind::window}) {
        if (options.context ? *options.context != kind
                            : kind == ContextKind::window && !display_is_available())
            continue;
        OpenDisplay display({.context = kind,
                             .size_px = geometry.screen_px,
                             .title = "overt bench",
                             .refresh_hz = 120.0,
                             .virtual_time = true});
        display.start();
        measure_flips(display, pages, geometry, figures);
    }
    measure_timing(figures);
    return figures;
}

} // namespace overt
