#include "app/rig/rig.h"

#include "app/rig/response_devices.h"
#include "app/rig/tracker_devices.h"
#include "devices/host/clocks.h"
#include "devices/simulated/operator_script.h"
#include "devices/simulated/simulated_observer.h"
#include "experiment/base/error.h"
#include "render/gl/headless_context.h"
#include "render/vblank/timing_check.h"
#include "render/window/window_system.h"

namespace overt {

bool wants_window(ContextChoice context) {
    return context ? *context == ContextKind::window : display_is_available();
}

namespace {

std::vector<ScriptedOperatorKey> read_operator_keys(const RigRequest& request,
                                                    const OperatorSettings& settings) {
    if (!request.operator_keys.empty() && !request.simulate_observer)
        throw InputError("--simulate-operator is for sessions with --simulate-observer");
    std::vector<ScriptedOperatorKey> keys;
    for (const std::string& key : request.operator_keys)
        keys.push_back(read_operator_key(key, static_cast<int>(settings.skip_reasons.size())));
    return keys;
}

std::unique_ptr<GlContext> make_context(const Protocol& protocol, const RigRequest& request) {
    const bool window = wants_window(request.context);
    if (!window && !request.simulate_observer) {
        throw InputError("without a window nobody can answer: give --simulate-observer SEED, or a display");
    }
    if (!window)
        return make_headless_context(request.context);
    const DisplaySettings& display = protocol.display;
    // In virtual time pictures do not stand for their true durations: no screen is taken over for that.
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
      operator_keys_(read_operator_keys(request, protocol.operators)),
      context_(make_context(protocol, request)), window_(dynamic_cast<WindowContext*>(context_.get())),
      screen_findings_(is_on_a_real_screen() ? examine_screen(*window_, protocol)
                                             : std::vector<ScreenFinding>()),
      library_(*context_, protocol, sculptures, cache) {}

Rig::~Rig() = default;

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
    tracker_ = tracker_device(protocol_->tracker.kind, request_.virtual_time)
                   .make({protocol_->tracker, *clock_, *observer_, request_.seed});
    panels_ = make_response_devices(
        {*protocol_, *clock_, *observer_, window_, request_.simulate_observer, operator_keys_});
    if (is_on_a_real_screen())
        window_->hold_still();
}

AnswerEquipment Rig::answer_equipment() const {
    return {protocol_->answers, *clock_, request_.simulate_observer ? observer_.get() : nullptr,
            request_.seed};
}

std::vector<std::string> Rig::closing_warnings() const {
    std::vector<std::string> warnings;
    for (const std::unique_ptr<ResponsePanel>& panel : panels_)
        for (std::string& warning : panel->closing_warnings())
            warnings.push_back(std::move(warning));
    return warnings;
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
