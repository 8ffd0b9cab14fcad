#include "app/rig/rig.h"

#include "devices/host/clocks.h"
#include "experiment/base/error.h"
#include "render/gl/headless_context.h"
#include "render/vblank/timing_check.h"
#include "render/window/window_system.h"

namespace overt {

bool wants_window(ContextChoice context) {
    return context ? *context == ContextKind::window : display_is_available();
}

namespace {

std::unique_ptr<GlContext> make_context(const Protocol& protocol, const RigRequest& request) {
    const bool window = wants_window(request.context);
    if (!window && !request.simulate_observer) {
        throw InputError("without a window nobody can answer: give --simulate-observer SEED, or a display");
    }
    if (!window)
        return make_headless_context(request.context);
    const DisplaySettings& display = protocol.display;
    // In virtual time nothing is lit for as long as it should be: a rehearsal, for which no screen is taken
    // over.
    const bool fullscreen = !request.windowed && !request.virtual_time;
    return std::make_unique<WindowContext>(WindowRequest{{display.width_px, display.height_px},
                                                         "overt: " + protocol.name,
                                                         fullscreen,
                                                         true,
                                                         display.output == OutputMode::native_10bit ? 10 : 8,
                                                         request.monitor});
}

std::vector<ScreenFinding> examine_screen(const WindowContext& window, const Protocol& protocol) {
    std::vector<ScreenFinding> findings = judge_screen(facts_of(window), protocol.display);
    refuse_spoilt_screen(findings);
    return findings;
}

} // namespace

Rig::Rig(const Protocol& protocol, std::span<const Sculpture> sculptures, const RigRequest& request,
         const std::filesystem::path& cache)
    : protocol_(&protocol), sculptures_(sculptures), request_(request),
      context_(make_context(protocol, request)), window_(dynamic_cast<WindowContext*>(context_.get())),
      screen_findings_(is_on_a_real_screen() ? examine_screen(*window_, protocol)
                                             : std::vector<ScreenFinding>()),
      library_(*context_, protocol, sculptures, cache) {}

bool Rig::maps_are_live() const {
    // Software takes a tenth of a second for a map: far longer than a refresh.
    return request_.maps == MapTime::live ||
           (request_.maps == MapTime::automatic && !context_->description().is_software);
}

std::vector<PresentationListener*> Rig::listeners() {
    std::vector<PresentationListener*> all{observer_.get()};
    if (live_maps_)
        all.push_back(live_maps_.get());
    if (virtual_refresh_)
        all.push_back(virtual_refresh_);
    return all;
}

void Rig::open(DisplayFaults faults, SessionTime start) {
    if (window_ && !request_.virtual_time && !faults.is_clean())
        throw InputError("faults are simulated where time is: give --virtual-time, or --context osmesa");
    if (request_.virtual_time) {
        clock_ = std::make_unique<VirtualClock>(start);
    } else {
        clock_ = std::make_unique<SteadyClock>(start);
    }
    const ScreenGeometry geometry = screen_geometry_of(*protocol_);
    const double refresh_hz = protocol_->display.refresh_hz;
    if (window_) {
        VblankChoice vblanks;
        if (is_on_a_real_screen())
            vblanks = choose_vblank_clock(vblank_candidates(*window_, *clock_), *clock_);
        auto display = std::make_unique<WindowDisplay>(*window_, *clock_, refresh_hz, request_.virtual_time,
                                                       std::move(faults), std::move(vblanks));
        window_display_ = display.get();
        virtual_refresh_ = request_.virtual_time ? &display->refresh() : nullptr;
        surface_ = std::move(display);
    } else {
        auto display = std::make_unique<VirtualDisplay>(
            *context_, *clock_, refresh_hz, protocol_->display.output == OutputMode::native_10bit ? 10 : 8,
            std::move(faults));
        virtual_refresh_ = &display->refresh();
        surface_ = std::move(display);
    }
    presenter_ = std::make_unique<PagePresenter>(*context_, *surface_, library_, geometry, protocol_->display,
                                                 protocol_->screens);
    if (maps_are_live())
        live_maps_ = std::make_unique<LiveMaps>(*context_, sculptures_, library_.poses(), geometry.image_px);
    observer_ = std::make_unique<SimulatedObserver>(make_observed_scene(*protocol_, sculptures_, geometry),
                                                    request_.seed);
    tracker_ = std::make_unique<SimulatedEyeTracker>(*clock_, *observer_, request_.seed,
                                                     simulated_tracker_settings(protocol_->tracker));
    if (request_.simulate_observer)
        simulated_panel_ =
            std::make_unique<SimulatedResponsePanel>(*clock_, *observer_, request_.operator_keys);
    panel_ = simulated_panel_.get();
    if (window_) {
        window_panel_ = std::make_unique<WindowResponsePanel>(*window_, *clock_, protocol_->operators,
                                                              protocol_->consent, panel_);
        panel_ = window_panel_.get();
    }
    if (is_on_a_real_screen())
        window_->hold_still();
}

std::vector<ScreenFinding> Rig::check_timing(double seconds,
                                             const std::function<void(int done, int total)>& progress) {
    OVERT_EXPECTS(is_on_a_real_screen() && window_display_);
    const TimingFacts facts = measure_timing(*window_, *window_display_, *clock_, seconds, progress);
    std::vector<ScreenFinding> findings = judge_timing(facts, protocol_->display.refresh_hz, "the protocol");
    refuse_spoilt_screen(findings);
    screen_findings_.insert(screen_findings_.end(), findings.begin(), findings.end());
    return findings;
}

} // namespace overt
